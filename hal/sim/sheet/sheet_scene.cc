// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/sheet/sheet_scene.h"

#include <cmath>
#include <vector>

namespace relievo::hal::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;
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
    const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        light_.push_back(static_cast<float>(linear(picture.bytes[channels * i + (channels == 1 ? 0 : c)])));
  }
  double aspect() const { return static_cast<double>(height_) / width_; }
  Vec3 at(double across, double down) const {  // 0 .. 1 over the picture
    const double x = std::clamp(across * width_ - 0.5, 0.0, width_ - 1.0),
                 y = std::clamp(down * height_ - 0.5, 0.0, height_ - 1.0);
    const int i = std::min(static_cast<int>(x), width_ - 2), j = std::min(static_cast<int>(y), height_ - 2);
    return mix(mix(pixel(i, j), pixel(i + 1, j), x - i), mix(pixel(i, j + 1), pixel(i + 1, j + 1), x - i),
               y - j);
  }

 private:
  Vec3 pixel(int x, int y) const {
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
    return {static_cast<double>(light_[i]), static_cast<double>(light_[i + 1]),
            static_cast<double>(light_[i + 2])};
  }
  int width_, height_;
  std::vector<float> light_;
};

class SheetScene final : public Scene {
 public:
  SheetScene(const Picture& picture, const SheetOptions& o)
      : print_(picture),
        o_(o),
        size_{o.width_mm, o.width_mm * print_.aspect()},
        sheet_(make_sheet(size_, o.bend)),
        panels_(lamp_panels(o.lamps)) {
    const Mat3 turn = rotation(radians(o.pose.pitch_deg), radians(-o.pose.yaw_deg), radians(o.pose.roll_deg));
    const Vec3 middle{o.pose.right_mm, o.pose.down_mm, o.pose.distance_mm};
    for (auto& p : sheet_.mesh.points) {
      const Vec3 q =
          turn * Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])} +
          middle;
      p = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
    }
    smooth_normals();
    caster_.add(sheet_.mesh);
    caster_.commit();
  }

  RayHit look(Vec3 origin, Vec3 direction) const override {
    Hit hit;
    if (!caster_.cast(origin, direction, hit)) return {room_light(direction), RayCaster::kFar, -1, false};
    const Vec3 at = origin + direction * hit.distance_mm;
    Vec3 normal = normalised(at_hit(hit, normals_));
    const bool back = dot(normal, direction) > 0;
    if (back) normal = -normal;
    return {light(hit, at, normal, direction, back), hit.distance_mm, 0, false};
  }
  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override {
    Hit hit;
    if (!caster_.cast(origin, direction, hit)) return false;
    out.point = origin + direction * hit.distance_mm;
    out.normal = normalised(at_hit(hit, normals_));
    if (dot(out.normal, direction) > 0) out.normal = -out.normal;
    out.skin = true;
    return true;
  }
  bool blocked(Vec3 from, Vec3 direction, double far_mm) const override {
    return caster_.blocked(from, direction, far_mm);
  }
  Mesh solid_mesh() const override { return sheet_.mesh; }

 private:
  Vec3 point(std::uint32_t i) const {
    const auto& p = sheet_.mesh.points[i];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  // Facets would each mirror a lamp of their own.
  void smooth_normals() {
    normals_.resize(sheet_.mesh.points.size());
    for (const auto& t : sheet_.mesh.triangles) {
      const Vec3 n = -cross(point(t[1]) - point(t[0]), point(t[2]) - point(t[0]));
      for (const std::uint32_t i : t) normals_[i] += n;
    }
  }
  Vec3 at_hit(const Hit& hit, const std::vector<Vec3>& values) const {
    const auto& t = sheet_.mesh.triangles[hit.primitive];
    return values[t[0]] * (1 - hit.u - hit.v) + values[t[1]] * hit.u + values[t[2]] * hit.v;
  }
  Vec3 colour(const Hit& hit) const {
    const auto& t = sheet_.mesh.triangles[hit.primitive];
    const auto along = [&](std::size_t k) {
      const auto of = [&](std::size_t corner) { return static_cast<double>(sheet_.paper_mm[t[corner]][k]); };
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
  SheetSize size_;
  SheetMesh sheet_;
  std::array<Panel, kPanels> panels_;
  std::vector<Vec3> normals_;
  RayCaster caster_;
};

}  // namespace

Result<void> SheetLook::check() const {
  if (!(brightness > 0) || !(brightness <= 2))
    return Error{Errc::InvalidInput, "a sheet's white is 0 to 2 times a white surface's light"};
  if (!(gloss >= 0) || !(gloss <= 1)) return Error{Errc::InvalidInput, "gloss is a share from 0 to 1"};
  if (!(roughness >= 0) || !(roughness <= 1)) return Error{Errc::InvalidInput, "roughness is 0 to 1 radians"};
  return {};
}

Result<void> SheetOptions::check() const {
  if (!(width_mm >= 20) || !(width_mm <= 2000))
    return Error{Errc::InvalidInput, "a picture is held 20 to 2000 mm wide"};
  RELIEVO_TRY(bend.check());
  RELIEVO_TRY(look.check());
  return lamps.check();
}

Result<std::unique_ptr<Scene>> make_sheet_scene(const Picture& picture, const SheetOptions& options) {
  RELIEVO_TRY(options.check());
  if (picture.format == PixelFormat::Grey16)
    return Error{Errc::InvalidInput, "a picture to be held up has 8 bits: grey or colour"};
  if (picture.width_px < 2 || picture.height_px < 2)
    return Error{Errc::InvalidInput, "a picture to be held up has at least 2 by 2 pixels"};
  return std::unique_ptr<Scene>(std::make_unique<SheetScene>(picture, options));
}

}  // namespace relievo::hal::sim
