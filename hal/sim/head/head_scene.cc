// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/head_scene.h"

#include "hal/sim/base/noise.h"
#include "hal/sim/head/head_light.h"
#include "hal/sim/head/head_model.h"

namespace relievo::hal::sim {
namespace {

// Of the head frame; what HeadPose places.
constexpr Vec3 kMiddleOfFace{0, -28, 95};

class HeadScene final : public Scene {
 public:
  HeadScene(std::shared_ptr<const HeadModel> head, const HeadPose& pose, ThreadPool& pool,
            const HeadLighting& lighting)
      : head_(std::move(head)),
        world_from_head_(pose.world_from_head()),
        head_from_world_(world_from_head_.transposed()),
        origin_(pose.origin_mm()),
        light_(*head_, pose, pool, lighting),
        skin_(head_->field) {
    // Looks between the cameras, as far as eyes turn without the head.
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 to = to_head({70, 0, 0}) - head_->eye_centres[k];
      gaze_[k] = normalised({std::clamp(to.x / to.z, -0.35, 0.35), std::clamp(to.y / to.z, -0.25, 0.25), 1});
    }
  }

  RayHit look(Vec3 origin, Vec3 direction) const override {
    const Vec3 o = to_head(origin), d = head_from_world_ * direction;
    Hit hit;
    if (!head_->caster.cast(o, d, hit)) return {room_light(direction), RayCaster::kFar, -1, false};
    const Vec3 at = o + d * hit.distance_mm;
    if (hit.body >= HeadModel::kHairBody) return {hair(hit, at, d), hit.distance_mm, hit.body, true};
    return {body(hit, at, d), hit.distance_mm, hit.body, false};
  }

  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override {
    const Vec3 o = to_head(origin), d = head_from_world_ * direction;
    Hit hit;
    if (!head_->caster.cast(o, d, hit, RayCaster::Against::SolidOnly)) return false;
    const Vec3 at = o + d * hit.distance_mm;
    const Mesh& mesh = head_->shells[static_cast<std::size_t>(hit.body)].mesh;
    const auto& c = mesh.triangles[hit.primitive];
    const Vec3 a = point_of(mesh, c[0]);
    out.point = origin + direction * hit.distance_mm;
    out.normal = world_from_head_ * normalised(cross(point_of(mesh, c[1]) - a, point_of(mesh, c[2]) - a));
    Hit first;
    const bool under_hair = head_->caster.cast(o, d, first) && first.body >= HeadModel::kHairBody;
    out.skin = hit.body == HeadModel::Skin && !under_hair && scalp_hair(head_->traits, at) < 0.05 &&
               at.y > gnathion_y(head_->traits) - 6 && at.z > -10;
    return true;
  }
  bool blocked(Vec3 from, Vec3 direction, double far_mm) const override {
    return head_->caster.blocked(to_head(from), head_from_world_ * direction, far_mm);
  }
  Mesh solid_mesh() const override;

 private:
  Vec3 to_head(Vec3 p) const { return head_from_world_ * (p - origin_); }
  Vec3 body(const Hit& hit, Vec3 at, Vec3 d) const;
  Vec3 hair(const Hit& hit, Vec3 at, Vec3 d) const;

  std::shared_ptr<const HeadModel> head_;
  Mat3 world_from_head_, head_from_world_;
  Vec3 origin_;
  HeadLight light_;
  SkinLook skin_;
  std::array<Vec3, 2> gaze_;
};

Vec3 HeadScene::body(const Hit& hit, Vec3 at, Vec3 d) const {
  const auto index = static_cast<std::size_t>(hit.body);
  const Shell& shell = head_->shells[index];
  const auto& corner = shell.mesh.triangles[hit.primitive];
  HeadLight::Point p;
  p.at = at;
  p.to_eye = -d;
  p.normal = normalised(blend_corners(shell.normals, corner, hit.u, hit.v));
  p.openness = static_cast<double>(blend_corners(shell.openness, corner, hit.u, hit.v));
  p.seen = light_.seen(index, corner, hit.u, hit.v);
  Surface s;
  switch (static_cast<HeadModel::Body>(hit.body)) {
    case HeadModel::Skin: {
      s = skin_.surface(at);
      const Vec3 slope = skin_.relief_slope(at);
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
    case HeadModel::Teeth:
      s = teeth_look(at);
      break;
    case HeadModel::Tongue:
      s = tongue_look(head_->traits, at);
      break;
    case HeadModel::Shirt:
    case HeadModel::BodyCount:
      s = shirt_look(head_->traits, at);
      break;
  }
  return light_.on(p, s);
}

Vec3 HeadScene::hair(const Hit& hit, Vec3 at, Vec3 d) const {
  const HairStyle& hair = head_->hair;
  const std::uint32_t first = hair.strands.pieces[hit.primitive];
  const auto node = [&](std::size_t i) {
    const auto& n = hair.strands.nodes[i];
    return Vec3{static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)};
  };
  const Vec3 a = node(first), b = node(first + 1);
  HeadLight::Point p;
  p.at = at;
  p.to_eye = -d;
  const bool scalp = at.y > 32 || std::abs(at.x) > 56;
  p.normal = scalp ? normalised(at - Vec3{0, 30, 5}) : Vec3{0, 0.1, 1};
  const double along =
      mix(static_cast<double>(hair.along[first]), static_cast<double>(hair.along[first + 1]), hit.u);
  p.openness = scalp ? mix(0.25, 1, along) : 0.8;
  // Only the two main panels cast shadows on hair: rays are dear where every pixel takes many.
  for (std::size_t k = 0; k < HeadLight::kPanels; ++k)
    p.seen[k] = (k < 2 ? light_.seen_from(*head_, at, k) : 0.5) * (scalp ? mix(0.45, 1, along) : 0.9);
  const Vec3 colour = head_->traits.hair * static_cast<double>(hair.tint[first]) * (scalp ? 1.0 : 0.8);
  return light_.on_hair(p, normalised(b - a), colour);
}

// The reference for measuring: what the cameras can reach; the back of the head only costs time.
Mesh HeadScene::solid_mesh() const {
  Mesh out;
  for (const auto body : {HeadModel::Skin, HeadModel::Eyes}) {
    const Mesh& mesh = head_->shells[static_cast<std::size_t>(body)].mesh;
    std::vector<std::uint32_t> moved(mesh.points.size(), ~0U);
    for (const auto& t : mesh.triangles) {
      if (point_of(mesh, t[0]).z < (body == HeadModel::Skin ? -30 : 70)) continue;
      std::array<std::uint32_t, 3> corner{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (moved[t[k]] == ~0U) {
          moved[t[k]] = static_cast<std::uint32_t>(out.points.size());
          out.points.push_back(to_floats(world_from_head_ * point_of(mesh, t[k]) + origin_));
        }
        corner[k] = moved[t[k]];
      }
      out.triangles.push_back(corner);
    }
  }
  return out;
}

}  // namespace

// Head axes (x to the person's left, y up, z out) onto camera axes (x right, y down, z forward).
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
