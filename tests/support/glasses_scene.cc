// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/glasses_scene.h"

#include "hal/sim/head/head_model.h"

namespace relievo::hal::sim {
namespace {

constexpr double kBeforeEyeMm = 13;  // vertex distance: lens to cornea
constexpr double kWrapDeg = 4;       // each lens looks a little outwards
constexpr double kPi = 3.141592653589793;

struct Lens {
  Vec3 middle, out, right, up;  // head frame
};

struct Met {
  double distance_mm = RayCaster::kFar;
  Vec3 normal;
  bool lens = false;
};

double schlick(double cosine) {
  const double q = 1 - cosine;
  return 0.04 + 0.96 * q * q * q * q * q;
}

class Frame {
 public:
  Frame(const Wearer& wearer, const HeadPose& pose, const Glasses& glasses, const HeadLighting& lighting)
      : glasses_(glasses),
        head_from_world_(pose.world_from_head().transposed()),
        origin_(pose.origin_mm()),
        panels_(lamp_panels(lighting)) {
    const double tilt = radians(glasses.tilt_deg);
    for (std::size_t k = 0; k < 2; ++k) {
      const double wrap = radians(k == 0 ? kWrapDeg : -kWrapDeg);
      Lens& lens = lenses_[k];
      lens.out = normalised({std::sin(wrap), -std::sin(tilt), std::cos(tilt)});
      lens.right = normalised(cross({0, 1, 0}, lens.out));
      lens.up = cross(lens.out, lens.right);
      lens.middle = wearer.eyes[k] + Vec3{0, -1.5, wearer.eye_radius + kBeforeEyeMm};
      const double edge = k == 0 ? 1 : -1;
      const Vec3 outer =
          lens.middle + lens.right * (edge * glasses.half_width_mm) + lens.up * 6.0 - lens.out * 3.0;
      temples_[k] = {Bead{outer, 1.8}, Bead{{edge * (wearer.head_breadth / 2 + 3), outer.y - 4, 0}, 1.5}};
    }
    bridge_ = {Bead{lenses_[0].middle - lenses_[0].right * glasses.half_width_mm + lenses_[0].up * 4.0, 1.4},
               Bead{lenses_[1].middle + lenses_[1].right * glasses.half_width_mm + lenses_[1].up * 4.0, 1.4}};
  }

  Vec3 to_head(Vec3 p) const { return head_from_world_ * (p - origin_); }
  Vec3 turned(Vec3 d) const { return head_from_world_ * d; }

  // What a ray of the head frame meets first.
  Met meet(Vec3 o, Vec3 d) const {
    Met met;
    for (const Lens& lens : lenses_) meet_lens(lens, o, d, met);
    meet_bars(o, d, met);
    return met;
  }

  // Light that the glass or the rim sends to the camera, of lamps and of the room.
  Vec3 mirrored(Vec3 at, Vec3 d, Vec3 normal, double share) const {
    const double cosine = std::abs(dot(normal, d));
    const Vec3 away = d - normal * (2 * dot(normal, d));
    const double light = lamp_light(at, away);
    return (room_light(head_from_world_.transposed() * away) + Vec3{light, light, light}) *
           (share * schlick(cosine));
  }
  double lamp_light(Vec3 at, Vec3 direction) const {
    const Vec3 from = head_from_world_.transposed() * at + origin_,
               d = head_from_world_.transposed() * direction;
    double sum = 0;
    for (const Panel& p : panels_) {
      const Vec3 n = cross(p.half_x, p.half_y);
      const double down = dot(d, n);
      if (std::abs(down) < 1e-9) continue;
      const double t = dot(p.centre - from, n) / down;
      if (t <= 0) continue;
      const Vec3 off = from + d * t - p.centre;
      if (std::abs(dot(off, p.half_x)) > dot(p.half_x, p.half_x) ||
          std::abs(dot(off, p.half_y)) > dot(p.half_y, p.half_y))
        continue;
      // Radiance of a panel that lights a white surface so (Lambert's law).
      sum +=
          p.power * kPi * kPanelReferenceMm * kPanelReferenceMm / (4 * length(p.half_x) * length(p.half_y));
    }
    return sum;
  }

 private:
  void meet_lens(const Lens& lens, Vec3 o, Vec3 d, Met& met) const {
    const Vec3 centre = lens.middle - lens.out * glasses_.curve_mm, from = o - centre;
    const double b = dot(from, d), c = dot(from, from) - glasses_.curve_mm * glasses_.curve_mm,
                 root = b * b - c;
    if (root < 0) return;
    const double t = -b - std::sqrt(root);
    if (t <= 0 || t >= met.distance_mm) return;
    const Vec3 off = o + d * t - lens.middle;
    const double u = std::abs(dot(off, lens.right)), v = std::abs(dot(off, lens.up));
    const auto outside = [&](double more) {
      return std::pow(u / (glasses_.half_width_mm + more), 3) +
                 std::pow(v / (glasses_.half_height_mm + more), 3) >
             1;
    };
    if (outside(glasses_.rim_mm)) return;
    met = {t, normalised(from + d * t), !outside(0)};
  }
  void meet_bars(Vec3 o, Vec3 d, Met& met) const {
    const auto distance = [&](Vec3 p) {
      return std::min({tapered(p, bridge_[0], bridge_[1]), tapered(p, temples_[0][0], temples_[0][1]),
                       tapered(p, temples_[1][0], temples_[1][1])});
    };
    double t = dot(lenses_[0].middle - o, d) - 40;  // no bar is nearer
    for (int i = 0; i < 60 && t < met.distance_mm; ++i) {
      const Vec3 p = o + d * t;
      const double left = distance(p);
      if (left > 250) return;
      if (left < 0.02) {
        constexpr double e = 0.05;
        met = {t,
               normalised({distance(p + Vec3{e, 0, 0}) - left, distance(p + Vec3{0, e, 0}) - left,
                           distance(p + Vec3{0, 0, e}) - left}),
               false};
        return;
      }
      t += left;
    }
  }

  Glasses glasses_;
  Mat3 head_from_world_;
  Vec3 origin_;
  std::array<Panel, kPanels> panels_;
  std::array<Lens, 2> lenses_;
  std::array<std::array<Bead, 2>, 2> temples_;
  std::array<Bead, 2> bridge_;
};

class GlassesScene final : public Scene {
 public:
  GlassesScene(std::unique_ptr<Scene> face, const Frame& frame, double passes)
      : face_(std::move(face)), frame_(frame), passes_(passes) {}

  RayHit look(Vec3 origin, Vec3 direction) const override {
    const RayHit behind = face_->look(origin, direction);
    const Vec3 o = frame_.to_head(origin), d = frame_.turned(direction);
    const Met met = frame_.meet(o, d);
    if (met.distance_mm >= behind.distance_mm) return behind;
    const Vec3 at = o + d * met.distance_mm;
    if (!met.lens) {
      const double facing = clamp01(0.3 + 0.7 * std::abs(dot(met.normal, d)));
      return {Vec3{0.030, 0.026, 0.024} * facing + frame_.mirrored(at, d, met.normal, 0.3), met.distance_mm,
              kRim, false};
    }
    RayHit out = behind;
    out.light =
        behind.light * passes_ + frame_.mirrored(at, d, met.normal, 2);  // front and back of the glass
    out.body = behind.body + kGlass;
    return out;
  }
  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override {
    return face_->solid(origin, direction, out);
  }
  bool blocked(Vec3 from, Vec3 direction, double far_mm) const override {
    return face_->blocked(from, direction, far_mm);
  }
  Mesh solid_mesh() const override { return face_->solid_mesh(); }

 private:
  static constexpr std::int32_t kRim = 300000, kGlass = 200000;
  std::unique_ptr<Scene> face_;
  Frame frame_;
  double passes_;
};

}  // namespace

Wearer wearer_of(const HeadModel& head) {
  return {head.eye_centres, head.field.eye.radius(), head.traits.head_breadth};
}

std::unique_ptr<Scene> make_glasses_scene(std::unique_ptr<Scene> face, const Wearer& wearer,
                                          const HeadPose& pose, const Glasses& glasses,
                                          const HeadLighting& lighting) {
  return std::make_unique<GlassesScene>(std::move(face), Frame(wearer, pose, glasses, lighting),
                                        glasses.passes);
}

double mirrored_mm2(const Wearer& wearer, const HeadPose& pose, const Glasses& glasses, Vec3 camera,
                    const HeadLighting& lighting) {
  const Frame frame(wearer, pose, glasses, lighting);
  const Vec3 o = frame.to_head(camera);
  double most = 0;
  for (const Vec3 eye : wearer.eyes) {
    int bright = 0;
    for (int y = -6; y <= 6; ++y)
      for (int x = -15; x <= 15; ++x) {
        const Vec3 d =
            normalised(eye + Vec3{static_cast<double>(x), static_cast<double>(y), wearer.eye_radius} - o);
        const Met met = frame.meet(o, d);
        if (!met.lens) continue;
        const Vec3 away = d - met.normal * (2 * dot(met.normal, d));
        bright +=
            2 * schlick(std::abs(dot(met.normal, d))) * frame.lamp_light(o + d * met.distance_mm, away) > 0.25
                ? 1
                : 0;
      }
    most = std::max(most, static_cast<double>(bright));
  }
  return most;
}

}  // namespace relievo::hal::sim
