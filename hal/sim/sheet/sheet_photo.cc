// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/sheet/sheet_photo.h"

#include <cmath>

namespace relievo::hal::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStepMm = 1.5;  // on a radius of 30 mm an arc leaves its chord by 0.0094 mm
constexpr double kLeastRadiusMm = 30;

struct Arc {
  double across = 0, away = 0;
};

// The profile of constant curvature, s along it.
Arc arc(double s, double radius) {
  return {radius * std::sin(s / radius), radius * (1 - std::cos(s / radius))};
}

// Curvature cos(2 pi s / wave) / radius: its direction is known, its place is summed up (Simpson's rule).
Arc wave(double s, double radius, double length) {
  const auto slope = [&](double at) { return length / (2 * kPi * radius) * std::sin(2 * kPi * at / length); };
  const int steps = 2 * (1 + int(std::abs(s) / 2));
  const double h = s / steps;
  Arc sum;
  for (int k = 0; k <= steps; ++k) {
    const double weight = h / 3 * (k == 0 || k == steps ? 1 : (k % 2 == 1 ? 4 : 2));
    sum.across += weight * std::cos(slope(k * h));
    sum.away += weight * std::sin(slope(k * h));
  }
  return sum;
}

// Unrolled, a cone is a sector round its apex; the line through the middle stays where it is.
Vec3 cone(double s, double t, double radius, double apex) {
  const double half_angle = std::atan(std::abs(radius / apex)), sine = std::sin(half_angle),
               cosine = std::cos(half_angle);
  const double along = apex > 0 ? 1 : -1;
  const double slant = std::hypot(s, along * t + std::abs(apex));
  const double turn = std::atan2(s, along * t + std::abs(apex)) / sine;
  const double away = slant * sine * cosine * (1 - std::cos(turn));
  return {slant * sine * std::sin(turn),
          along * (slant * (sine * sine * std::cos(turn) + cosine * cosine) - std::abs(apex)),
          radius > 0 ? away : -away};
}

constexpr double kScreenBlack = 0.004;  // light that a screen lets through where it shows black

double linear(std::byte level) {
  const double v = std::to_integer<int>(level) / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// The picture as light, asked for between its pixels.
class Print {
 public:
  explicit Print(const Picture& picture) : width_(picture.width_px), height_(picture.height_px) {
    const std::size_t channels = picture.format == PixelFormat::Grey8 ? 1 : 3;
    const std::size_t count = std::size_t(width_) * std::size_t(height_);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        light_.push_back(float(linear(picture.bytes[channels * i + (channels == 1 ? 0 : c)])));
  }
  double aspect() const { return double(height_) / width_; }
  Vec3 at(double across, double down) const {  // 0 .. 1 over the picture
    const double x = std::clamp(across * width_ - 0.5, 0.0, width_ - 1.0),
                 y = std::clamp(down * height_ - 0.5, 0.0, height_ - 1.0);
    const int i = std::min(int(x), width_ - 2), j = std::min(int(y), height_ - 2);
    return mix(mix(pixel(i, j), pixel(i + 1, j), x - i), mix(pixel(i, j + 1), pixel(i + 1, j + 1), x - i),
               y - j);
  }

 private:
  Vec3 pixel(int x, int y) const {
    const std::size_t i = 3 * (std::size_t(y) * std::size_t(width_) + std::size_t(x));
    return {double(light_[i]), double(light_[i + 1]), double(light_[i + 2])};
  }
  int width_, height_;
  std::vector<float> light_;
};

class SheetScene final : public Scene {
 public:
  SheetScene(const Picture& picture, const SheetOptions& o) : print_(picture), o_(o) {
    const Mat3 turn = rotation(radians(o.pose.pitch_deg), radians(-o.pose.yaw_deg), radians(o.pose.roll_deg));
    const Vec3 middle{o.pose.right_mm, o.pose.down_mm, o.pose.distance_mm};
    for (std::size_t i = 0; i < sheet_.mesh.points.size(); ++i)
      sheet_.mesh.points[i] = to_floats(turn * point_of(sheet_.mesh, i) + middle);
    smooth_normals();
    caster_.add(sheet_.mesh);
    caster_.commit();
  }

  RayHit look(Vec3 origin, Vec3 direction) const override {
    Hit hit;
    if (!caster_.cast(origin, direction, hit)) return {room_light(direction), RayCaster::kFar, -1, false};
    const Vec3 at = origin + direction * hit.distance_mm;
    Vec3 normal = normal_at(hit);
    const bool back = dot(normal, direction) > 0;
    if (back) normal = -normal;
    return {light(hit, at, normal, direction, back), hit.distance_mm, 0, false};
  }

 private:
  // Facets would each mirror a lamp of their own.
  void smooth_normals() {
    normals_.resize(sheet_.mesh.points.size());
    for (const auto& t : sheet_.mesh.triangles) {
      const Vec3 a = point_of(sheet_.mesh, t[0]);
      const Vec3 n = -cross(point_of(sheet_.mesh, t[1]) - a, point_of(sheet_.mesh, t[2]) - a);
      for (const std::uint32_t i : t) normals_[i] += n;
    }
  }
  Vec3 normal_at(const Hit& hit) const {
    return normalised(blend_corners(normals_, sheet_.mesh.triangles[hit.primitive], hit.u, hit.v));
  }
  Vec3 colour(const Hit& hit) const {
    const auto& t = sheet_.mesh.triangles[hit.primitive];
    const auto along = [&](std::size_t k) {
      const auto of = [&](std::size_t corner) { return double(sheet_.paper_mm[t[corner]][k]); };
      return of(0) * (1 - hit.u - hit.v) + of(1) * hit.u + of(2) * hit.v;
    };
    return print_.at(along(0) / size_.width_mm + 0.5, along(1) / size_.height_mm + 0.5);
  }

  Vec3 light(const Hit& hit, Vec3 at, Vec3 normal, Vec3 direction, bool back) const {
    const SheetLook& look = o_.look;
    double lit = 0.09 + 0.03 * dot(normal, Vec3{0, -1, 0});  // the room
    double mirrored = 0;
    const Vec3 reflected = direction - normal * (2 * dot(direction, normal));
    // Schlick's formula: any film mirrors more of what grazes it.
    const double bounce =
        look.gloss > 0
            ? look.gloss + (1 - look.gloss) * std::pow(1 - std::min(1.0, -dot(direction, normal)), 5)
            : 0;
    for (const Panel& panel : panels_) {
      const Vec3 to = panel.centre - at;
      const double d = length(to), facing = dot(normal, to) / d, nearer = kPanelReferenceMm / d;
      if (facing <= 0 || (o_.bend.radius_mm != 0 && caster_.blocked(at + normal * 0.2, to * (1 / d), d)))
        continue;
      lit += panel.power * facing * nearer * nearer;
      if (bounce > 0) mirrored += bounce * mirror(panel, at, reflected);
    }
    const Vec3 ink = back ? Vec3{0.8, 0.8, 0.8} : colour(hit);
    const Vec3 own = look.screen && !back
                         ? ink * look.brightness + Vec3{kScreenBlack, kScreenBlack, kScreenBlack}
                         : ink * (look.brightness * lit);
    return own + Vec3{mirrored, mirrored, mirrored};
  }

  // Radiance of the panel in this direction: its power spread over the solid angle it is seen under from
  // where the power is stated, its rim as soft as the mirror is rough.
  double mirror(const Panel& panel, Vec3 at, Vec3 reflected) const {
    const Vec3 n = cross(panel.half_x, panel.half_y);
    const double towards = dot(reflected, n);
    if (std::abs(towards) < 1e-9 * length(n)) return 0;
    const double along = dot(panel.centre - at, n) / towards;
    if (along <= 0) return 0;
    const Vec3 from = at + reflected * along - panel.centre;
    const auto inside = [&](Vec3 half) {
      const double reach = length(half), place = std::abs(dot(from, half)) / reach,
                   rim = std::max(1.0, 2 * o_.look.roughness * along);
      return 1 - smoothstep(reach - rim, reach + rim, place);
    };
    const double solid_angle = 4 * length(n) / (kPanelReferenceMm * kPanelReferenceMm);
    return inside(panel.half_x) * inside(panel.half_y) * kPi * panel.power / solid_angle;
  }

  Print print_;
  SheetOptions o_;
  SheetSize size_{o_.width_mm, print_.aspect() * o_.width_mm};
  SheetMesh sheet_{make_sheet(size_, o_.bend)};
  std::array<Panel, kPanels> panels_{lamp_panels(o_.lamps)};
  std::vector<Vec3> normals_;
  RayCaster caster_;
};

}  // namespace

Result<void> SheetBend::check() const {
  if (radius_mm != 0 && !(std::abs(radius_mm) >= kLeastRadiusMm))
    return invalid("a sheet bends to a radius of 30 mm and no closer; 0 is flat");
  if (!std::isfinite(radius_mm) || !std::isfinite(axis_deg)) return invalid("a sheet's bend must be finite");
  if (apex_mm != 0 && !(std::abs(apex_mm) >= 250))
    return invalid("a cone's apex lies 250 mm from the sheet's middle or further");
  if (wave_mm != 0 && !(wave_mm >= 60)) return invalid("a sheet's wave is 60 mm long or longer");
  if (apex_mm != 0 && wave_mm != 0) return invalid("a sheet is bent to a cone or in waves, not both");
  return {};
}

Vec3 bent(const SheetBend& bend, double u, double v) {
  if (bend.radius_mm == 0) return {u, v, 0};
  const double c = std::cos(radians(bend.axis_deg)), d = std::sin(radians(bend.axis_deg));
  const double s = c * u + d * v, t = -d * u + c * v;
  Vec3 p;
  if (bend.apex_mm != 0) {
    p = cone(s, t, bend.radius_mm, bend.apex_mm);
  } else {
    const Arc a = bend.wave_mm > 0 ? wave(s, bend.radius_mm, bend.wave_mm) : arc(s, bend.radius_mm);
    p = {a.across, t, a.away};
  }
  return {c * p.x - d * p.y, d * p.x + c * p.y, p.z};
}

SheetMesh make_sheet(const SheetSize& size, const SheetBend& bend) {
  const int columns = 1 + int(std::ceil(size.width_mm / kStepMm)),
            rows = 1 + int(std::ceil(size.height_mm / kStepMm));
  SheetMesh out;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double u = size.width_mm * (double(i) / (columns - 1) - 0.5),
                   v = size.height_mm * (double(j) / (rows - 1) - 0.5);
      out.mesh.points.push_back(to_floats(bent(bend, u, v)));
      out.paper_mm.push_back({float(u), float(v)});
    }
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const auto a = std::uint32_t(j * columns + i), below = a + std::uint32_t(columns);
      out.mesh.triangles.push_back({a, a + 1, below});
      out.mesh.triangles.push_back({a + 1, below + 1, below});
    }
  return out;
}

Result<void> SheetLook::check() const {
  if (!(brightness > 0) || !(brightness <= 2))
    return invalid("a sheet's white is 0 to 2 times a white surface's light");
  if (!(gloss >= 0) || !(gloss <= 1)) return invalid("gloss is a share from 0 to 1");
  if (!(roughness >= 0) || !(roughness <= 1)) return invalid("roughness is 0 to 1 radians");
  return {};
}

Result<void> SheetOptions::check() const {
  if (!(width_mm >= 20) || !(width_mm <= 2000)) return invalid("a picture is held 20 to 2000 mm wide");
  RELIEVO_TRY(bend.check());
  RELIEVO_TRY(look.check());
  return lamps.check();
}

Result<std::unique_ptr<Scene>> make_sheet_scene(const Picture& picture, const SheetOptions& options) {
  RELIEVO_TRY(options.check());
  if (picture.format == PixelFormat::Grey16)
    return invalid("a picture to be held up has 8 bits: grey or colour");
  if (picture.width_px < 2 || picture.height_px < 2)
    return invalid("a picture to be held up has at least 2 by 2 pixels");
  return std::unique_ptr<Scene>(std::make_unique<SheetScene>(picture, options));
}

Result<void> photograph_sheet(const Picture& picture, const SheetPhotoOptions& options,
                              const std::filesystem::path& folder) {
  RELIEVO_TRY(options.rig.check());
  RELIEVO_TRY_ASSIGN(const auto scene, make_sheet_scene(picture, options.sheet));
  RELIEVO_TRY(make_folder(folder));
  ThreadPool pool(options.threads);
  const SimRig rig = make_rig(options.rig);
  RELIEVO_TRY(write_rig(folder / "rig.yml", rig));
  return write_pair(render_pair(*scene, rig, options.sensor, options.seed * 1000ULL, pool), folder);
}

}  // namespace relievo::hal::sim
