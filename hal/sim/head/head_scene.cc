// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/head_scene.h"

#include <array>
#include <vector>

#include "hal/sim/base/noise.h"
#include "hal/sim/head/head_model.h"

namespace relievo::hal::sim {
namespace {

// The kiosk's light (scene.h) on a head. Shadows are soft because panels are large; how much of each
// panel a vertex sees is measured once. All in the head frame, mm.
class HeadLight {
 public:
  HeadLight(const HeadModel& model, const HeadPose& pose, ThreadPool& pool, const HeadLighting& lighting)
      : panels_(lamp_panels(lighting)) {
    const Mat3 head_from_world = pose.world_from_head().transposed();
    const Vec3 origin = pose.origin_mm();
    for (Panel& p : panels_)
      p = {head_from_world * (p.centre - origin), head_from_world * p.half_x, head_from_world * p.half_y,
           p.power};
    eye_ = head_from_world * (Vec3{70, 0, 0} - origin);
    up_ = head_from_world * Vec3{0, -1, 0};
    for (std::size_t shell = 0; shell < HeadModel::BodyCount; ++shell)
      for (std::size_t panel = 0; panel < kPanels; ++panel) measure(model, shell, panel, pool);
  }

  struct Point {
    Vec3 at, normal, to_eye;  // unit vectors
    double openness = 1;
    std::array<double, kPanels> seen{1, 1, 1, 1};
  };

  Vec3 on(const Point& p, const Surface& s) const {
    Vec3 out = ambient(p.normal, p.openness, s);
    // Light enters skin and leaves it further on, red furthest: edges of shade are soft and warm.
    const Vec3 wrap = Vec3{0.22, 0.09, 0.06} * s.translucent;
    for (std::size_t k = 0; k < kPanels; ++k) {
      if (panels_[k].power == 0) continue;
      const Vec3 to = panels_[k].centre - p.at;
      const double d = length(to), ndl = dot(p.normal, to) / d;
      const double power = panels_[k].power * (kPanelReferenceMm / d) * (kPanelReferenceMm / d);
      const auto lit = [&](double w) { return std::max(0.0, (ndl + w) / ((1 + w) * (1 + w))); };
      const double v = p.seen[k];
      const Vec3 shade =
          s.translucent > 0 ? Vec3{mix(v, std::sqrt(v), 0.4), v, mix(v, v * v, 0.1)} : Vec3{v, v, v};
      out += s.colour * Vec3{lit(wrap.x), lit(wrap.y), lit(wrap.z)} * shade * power;
      const double shine = s.gloss * highlight(panels_[k], p, s.roughness) * power * v * 2.9;
      out += Vec3{shine, shine, shine};
    }
    return out;
  }

  // A hair: light scattered by a thin cylinder (Kajiya and Kay, 1989).
  Vec3 on_hair(const Point& p, Vec3 tangent, Vec3 colour) const {
    Vec3 out = colour * (0.14 * p.openness);
    for (std::size_t k = 0; k < kPanels; ++k) {
      const Vec3 to = panels_[k].centre - p.at, l = normalised(to);
      const double power = panels_[k].power * p.seen[k];
      const double tl = dot(tangent, l), tv = dot(tangent, p.to_eye);
      const double sl = std::sqrt(std::max(0.0, 1 - tl * tl)), sv = std::sqrt(std::max(0.0, 1 - tv * tv));
      const double facing = clamp01(0.35 + 0.65 * dot(p.normal, l));
      const double shine = std::pow(std::max(0.0, sl * sv - tl * tv), 40);
      out += colour * (sl * facing * power * 0.85) +
             (Vec3{0.035, 0.035, 0.035} + colour * 0.35) * (shine * facing * power);
    }
    return out;
  }

  std::array<double, kPanels> seen(std::size_t shell, const std::array<std::uint32_t, 3>& corner, double u,
                                   double v) const {
    std::array<double, kPanels> out{};
    for (std::size_t k = 0; k < kPanels; ++k) out[k] = double(blend_corners(seen_[shell][k], corner, u, v));
    return out;
  }

  double seen_from(const HeadModel& model, Vec3 p, std::size_t panel) const {
    const Vec3 to = panels_[panel].centre - p;
    const double far = length(to);
    return model.caster.blocked(p + to * (0.4 / far), to * (1 / far), far) ? 0.0 : 1.0;
  }

 private:
  void measure(const HeadModel& model, std::size_t shell_index, std::size_t panel_index, ThreadPool& pool) {
    const int rays_a_side = panel_index == 2 ? 2 : 3;
    const Shell& shell = model.shells[shell_index];
    const Panel& panel = panels_[panel_index];
    std::vector<float>& seen = seen_[shell_index][panel_index];
    seen.assign(shell.mesh.points.size(), 0.0F);
    if (seen.empty() || panel.power == 0) return;
    pool.for_each(int(seen.size()), 64, [&](int i) {
      const auto k = std::size_t(i);
      const Vec3 p = point_of(shell.mesh, k), n = shell.normals[k];
      if (p.z < -35 || dot(n, panel.centre - p) < -0.3 * length(panel.centre - p)) return;
      if (dot(n, normalised(eye_ - p)) < -0.45) return;  // turned away from both cameras
      const std::uint32_t h = hash_cell(i, int(panel_index), 1, 9);
      int open = 0;
      for (int r = 0; r < rays_a_side * rays_a_side; ++r) {
        const double u = (r % rays_a_side + unit_from_hash(h)) / rays_a_side * 2 - 1,
                     v = (r / rays_a_side + unit_from_hash(h * 31 + 7)) / rays_a_side * 2 - 1;
        const Vec3 to = panel.centre + panel.half_x * u + panel.half_y * v - p;
        const double far = length(to);
        open += model.caster.blocked(p + n * 0.15, to * (1 / far), far) ? 0 : 1;
      }
      seen[k] = float(open) / float(rays_a_side * rays_a_side);
    });
    smooth_over(shell.mesh, seen, 4);
  }

  Vec3 ambient(Vec3 normal, double openness, const Surface& s) const {
    const double sky = 0.5 + 0.5 * dot(normal, up_);
    const Vec3 light = mix(Vec3{0.065, 0.06, 0.058}, Vec3{0.13, 0.132, 0.14}, sky);
    // In hollows light has bounced off skin before it arrives, and comes red.
    const double o = std::max(openness, 0.02);
    const Vec3 hollow = s.translucent > 0
                            ? Vec3{mix(o, std::sqrt(o), 0.3), mix(o, o * o, 0.15), mix(o, o * o, 0.25)}
                            : Vec3{o, o, o};
    return s.colour * light * hollow;
  }

  // The panel seen in the surface: the point of it nearest to the mirrored ray stands for all of it.
  double highlight(const Panel& panel, const Point& p, double roughness) const {
    const Vec3 mirrored = p.normal * (2 * dot(p.normal, p.to_eye)) - p.to_eye;
    const Vec3 n = cross(panel.half_x, panel.half_y);
    const double along = dot(panel.centre - p.at, n) / std::min(dot(mirrored, n), -1e-6 * length(n));
    Vec3 aim = panel.centre;
    if (along > 0) {
      const Vec3 from = p.at + mirrored * along - panel.centre;
      const double u = std::clamp(dot(from, panel.half_x) / dot(panel.half_x, panel.half_x), -1.0, 1.0);
      const double v = std::clamp(dot(from, panel.half_y) / dot(panel.half_y, panel.half_y), -1.0, 1.0);
      aim = panel.centre + panel.half_x * u + panel.half_y * v;
    }
    const Vec3 l = normalised(aim - p.at), half = normalised(l + p.to_eye);
    const double ndl = dot(p.normal, l), ndh = std::max(dot(p.normal, half), 0.0);
    if (ndl <= 0) return 0;
    const double a2 = roughness * roughness * roughness * roughness, q = ndh * ndh * (a2 - 1) + 1;
    const double widened = std::min(1.0, a2 * 6);  // an area light spreads and dims a sharp lobe
    const double v = 1 - std::max(dot(half, p.to_eye), 0.0), fresnel = 0.028 + 0.972 * (v * v * v * v * v);
    return fresnel * widened * a2 / (3.14159 * q * q) / std::max(a2, 0.02) * 0.35 * std::min(1.0, ndl * 4) *
           0.25;
  }

  std::array<Panel, kPanels> panels_;
  Vec3 up_, eye_;  // the sky, and the place between the cameras
  std::array<std::array<std::vector<float>, kPanels>, HeadModel::BodyCount> seen_;
};

// Of the head frame; what HeadPose places.
constexpr Vec3 kMiddleOfFace{0, -28, 95};

class HeadScene final : public Scene {
 public:
  HeadScene(std::shared_ptr<const HeadModel> head, const HeadPose& pose, ThreadPool& pool,
            const HeadLighting& lighting)
      : head_(std::move(head)),
        world_from_head_(pose.world_from_head()),
        origin_(pose.origin_mm()),
        light_(*head_, pose, pool, lighting) {
    // Looks between the cameras, as far as eyes turn without the head.
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 to = pose.eyes_follow ? to_head({70, 0, 0}) - head_->eye_centres[k] : Vec3{0, 0, 1};
      gaze_[k] = normalised({std::clamp(to.x / to.z, -0.35, 0.35), std::clamp(to.y / to.z, -0.25, 0.25), 1});
    }
  }

  RayHit look(Vec3 origin, Vec3 direction) const override {
    const Vec3 o = to_head(origin), d = head_from_world_ * direction;
    Hit hit;
    if (!head_->caster.cast(o, d, hit)) return {room_light(direction), RayCaster::kFar, -1, false};
    const Vec3 at = o + d * hit.distance_mm;
    if (hit.body >= RayCaster::kFirstStrands) return {hair(hit, at, d), hit.distance_mm, hit.body, true};
    return {body(hit, at, d), hit.distance_mm, hit.body, false};
  }

  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override {
    const Vec3 o = to_head(origin), d = head_from_world_ * direction;
    Hit hit;
    if (!head_->caster.cast(o, d, hit, RayCaster::Against::SolidOnly)) return false;
    const Vec3 at = o + d * hit.distance_mm;
    const Mesh& mesh = head_->shells[std::size_t(hit.body)].mesh;
    const auto& c = mesh.triangles[hit.primitive];
    const Vec3 a = point_of(mesh, c[0]);
    out.point = origin + direction * hit.distance_mm;
    out.normal = world_from_head_ * normalised(cross(point_of(mesh, c[1]) - a, point_of(mesh, c[2]) - a));
    Hit first;
    const bool under_hair = head_->caster.cast(o, d, first) && first.body >= RayCaster::kFirstStrands;
    out.skin = hit.body == HeadModel::Skin && !under_hair && scalp_hair(head_->traits, at) < 0.05 &&
               at.y > gnathion_y(head_->traits) - 6 && at.z > -10;
    return true;
  }
  bool blocked(Vec3 from, Vec3 direction, double far_mm) const override {
    return head_->caster.blocked(to_head(from), head_from_world_ * direction, far_mm);
  }

  // The reference for measuring: what the cameras can reach; the back of the head only costs time.
  Mesh solid_mesh() const override {
    Mesh out;
    for (const auto body : {HeadModel::Skin, HeadModel::Eyes}) {
      const Mesh& mesh = head_->shells[std::size_t(body)].mesh;
      std::vector<std::uint32_t> moved(mesh.points.size(), ~0U);
      for (const auto& t : mesh.triangles) {
        if (point_of(mesh, t[0]).z < (body == HeadModel::Skin ? -30 : 70)) continue;
        std::array<std::uint32_t, 3> corner{};
        for (std::size_t k = 0; k < 3; ++k) {
          if (moved[t[k]] == ~0U) {
            moved[t[k]] = std::uint32_t(out.points.size());
            out.points.push_back(to_floats(world_from_head_ * point_of(mesh, t[k]) + origin_));
          }
          corner[k] = moved[t[k]];
        }
        out.triangles.push_back(corner);
      }
    }
    return out;
  }

 private:
  Vec3 to_head(Vec3 p) const { return head_from_world_ * (p - origin_); }

  Vec3 body(const Hit& hit, Vec3 at, Vec3 d) const {
    const auto index = std::size_t(hit.body);
    const Shell& shell = head_->shells[index];
    const auto& corner = shell.mesh.triangles[hit.primitive];
    HeadLight::Point p;
    p.at = at;
    p.to_eye = -d;
    p.normal = normalised(blend_corners(shell.normals, corner, hit.u, hit.v));
    p.openness = double(blend_corners(shell.openness, corner, hit.u, hit.v));
    p.seen = light_.seen(index, corner, hit.u, hit.v);
    Surface s;
    switch (static_cast<HeadModel::Body>(hit.body)) {
      case HeadModel::Skin: {
        s = skin_look(head_->field, at);
        const Vec3 slope = skin_slope(head_->field, at);
        p.normal = normalised(p.normal - (slope - p.normal * dot(slope, p.normal)));
        break;
      }
      case HeadModel::Eyes: {
        const std::size_t side = at.x > 0 ? 0 : 1;
        const EyeLook look = eye_look(head_->traits, at - head_->eye_centres[side], gaze_[side]);
        s = look.surface;
        p.normal = look.normal;
        p.openness *= p.openness;  // the lid's shade lies on the ball
        break;
      }
      case HeadModel::Inner:
        s = {Vec3{0.56, 0.34, 0.30} * (0.45 + head_->traits.skin.x), 1.4, 0.25, 0.6};
        break;
      case HeadModel::Teeth: s = teeth_look(at); break;
      case HeadModel::Tongue: s = tongue_look(head_->traits, at); break;
      case HeadModel::Shirt:
      case HeadModel::BodyCount: s = shirt_look(head_->traits, at); break;
    }
    return light_.on(p, s);
  }

  Vec3 hair(const Hit& hit, Vec3 at, Vec3 d) const {
    const HairStyle& hair = head_->hair;
    const std::uint32_t first = hair.strands.pieces[hit.primitive];
    const auto node = [&](std::size_t i) {
      const auto& n = hair.strands.nodes[i];
      return Vec3{double(n.x), double(n.y), double(n.z)};
    };
    const Vec3 a = node(first), b = node(first + 1);
    HeadLight::Point p;
    p.at = at;
    p.to_eye = -d;
    const bool scalp = at.y > 32 || std::abs(at.x) > 56;
    p.normal = scalp ? normalised(at - Vec3{0, 30, 5}) : Vec3{0, 0.1, 1};
    const double along = mix(double(hair.along[first]), double(hair.along[first + 1]), hit.u);
    p.openness = scalp ? mix(0.25, 1, along) : 0.8;
    // Only the two main panels cast shadows on hair: rays are dear where every pixel takes many.
    for (std::size_t k = 0; k < kPanels; ++k)
      p.seen[k] = (k < 2 ? light_.seen_from(*head_, at, k) : 0.5) * (scalp ? mix(0.45, 1, along) : 0.9);
    const Vec3 colour = head_->traits.hair * double(hair.tint[first]) * (scalp ? 1.0 : 0.8);
    return light_.on_hair(p, normalised(b - a), colour);
  }

  std::shared_ptr<const HeadModel> head_;
  Mat3 world_from_head_, head_from_world_{world_from_head_.transposed()};
  Vec3 origin_;
  HeadLight light_;
  std::array<Vec3, 2> gaze_;
};

}  // namespace

// Head axes (x to the person's left, y up, z out) onto camera axes (x right, y down, z forward).
HeadPose turned_about_neck(HeadPose pose, double yaw_deg) {
  constexpr double kNeckMm = 95;  // behind the middle of the face
  const double before = radians(pose.yaw_deg), now = before + radians(yaw_deg);
  pose.yaw_deg += yaw_deg;
  pose.right_mm += kNeckMm * (std::sin(now) - std::sin(before));
  pose.distance_mm += kNeckMm * (std::cos(before) - std::cos(now));
  return pose;
}

Mat3 HeadPose::world_from_head() const {
  const Mat3 facing{{Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}};
  // In camera axes a positive turn about y takes -z towards -x, hence the sign.
  return rotation(radians(pitch_deg), radians(-yaw_deg), radians(roll_deg)) * facing;
}
Vec3 HeadPose::origin_mm() const {
  return Vec3{right_mm, down_mm, distance_mm} - world_from_head() * kMiddleOfFace;
}

std::shared_ptr<const HeadModel> make_head(const HeadTraits& traits, ThreadPool& pool) {
  return std::make_shared<const HeadModel>(traits, pool);
}

std::unique_ptr<Scene> make_head_scene(std::shared_ptr<const HeadModel> head, const HeadPose& pose,
                                       ThreadPool& pool, const HeadLighting& lighting) {
  return std::make_unique<HeadScene>(std::move(head), pose, pool, lighting);
}

}  // namespace relievo::hal::sim
