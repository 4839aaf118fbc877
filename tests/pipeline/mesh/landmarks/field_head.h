// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulated head as the left camera would measure it, without pictures: rays marched to its surface, kept
// where the right camera sees the same place, with noise along the ray. And its true pose and landmarks.
#pragma once

#include <random>

#include "hal/base/thread_pool.h"
#include "hal/sim/head/head_scene.h"
#include "pipeline/model/geometry.h"
#include "pipeline/model/point_cloud.h"
#include "tests/support/head_landmarks.h"

namespace relievo::pipeline {

class FieldHead {
 public:
  explicit FieldHead(std::uint32_t seed) : field_(hal::sim::traits_of(seed)) {}

  const hal::sim::HeadField& field() const { return field_; }
  static RigidTransform camera_from_head(const hal::sim::HeadPose& pose) {
    const hal::sim::Mat3 r = pose.world_from_head();
    RigidTransform t;
    for (std::size_t i = 0; i < 3; ++i)
      t.rotation.m[3 * i] = r.row[i].x, t.rotation.m[3 * i + 1] = r.row[i].y,
                       t.rotation.m[3 * i + 2] = r.row[i].z;
    const hal::sim::Vec3 o = pose.origin_mm();
    t.translation_mm = {o.x, o.y, o.z};
    return t;
  }

  // The same, with what is known of the two views: the right camera beside the left one, both straight ahead.
  PointCloud cloud_of_two(const hal::sim::HeadPose& pose, ThreadPool& pool, double noise_mm = 0.1) const {
    PointCloud made = cloud(pose, pool, noise_mm);
    made.right_camera_mm = {kRight.x, kRight.y, kRight.z};
    return made;
  }

  PointCloud cloud(const hal::sim::HeadPose& pose, ThreadPool& pool, double noise_mm = 0.1) const {
    const hal::sim::Mat3 to_head = pose.world_from_head().transposed();
    const auto in_head = [&](hal::sim::Vec3 p) { return to_head * (p - pose.origin_mm()); };
    std::vector<double> depth(kWidth * kHeight, 0);
    pool.for_each_band(kHeight, kHeight, [&](int begin, int end, int) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < kWidth; ++x)
          depth[static_cast<std::size_t>(y * kWidth + x)] =
              march(in_head, {(x - kWidth / 2) * kSlope, (y - kHeight / 2) * kSlope, 1});
    });
    PointCloud cloud(std::pmr::get_default_resource());
    cloud.lattice_step_px = 2;
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, noise_mm);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        double z = depth[static_cast<std::size_t>(y * kWidth + x)];
        if (z <= 0) continue;
        z += noise(random);
        cloud.points.push_back({{static_cast<float>((x - kWidth / 2) * kSlope * z),
                                 static_cast<float>((y - kHeight / 2) * kSlope * z), static_cast<float>(z)},
                                {static_cast<float>(2 * x), static_cast<float>(2 * y)},
                                static_cast<float>(std::max(noise_mm, 0.02))});
      }
    return cloud;
  }

 private:
  static constexpr int kWidth = 200, kHeight = 260;
  static constexpr double kSlope = 0.0018;             // about a millimetre on the face
  static constexpr hal::sim::Vec3 kRight{138, 0, 17};  // the right camera

  // Depth of the face on this ray; 0 where there is none or the right camera does not see it well.
  template <typename InHead>
  double march(InHead&& in_head, hal::sim::Vec3 ray) const {
    double z = 420;
    for (int k = 0; k < 120 && z < 640; ++k) {
      const double d = field_.distance(in_head(ray * z));
      if (d > 0.02) {
        z += std::min(0.6 * d, 4.0);  // further off the field knows no nose
        continue;
      }
      const hal::sim::Vec3 p = in_head(ray * z), n = field_.gradient(p);
      const hal::sim::Vec3 tip = field_.nose.tip();
      const hal::sim::Vec3 to_left = normalised(in_head({0, 0, 0}) - p),
                           to_right = normalised(in_head(kRight) - p);
      if (length(p - tip) > 105 || dot(n, to_left) < 0.3 || dot(n, to_right) < 0.3) return 0;
      for (int step = 0; step < 39; ++step)
        if (field_.distance(p + to_right * (2 + 1.5 * step)) < 0) return 0;
      return z;
    }
    return 0;
  }

  hal::sim::HeadField field_;
};

}  // namespace relievo::pipeline
