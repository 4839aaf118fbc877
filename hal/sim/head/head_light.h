// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kiosk's light (lamps.h) on a head. Shadows are soft because panels are large; how much of each
// panel a vertex sees is measured once. All in the head frame, mm.
#pragma once

#include <array>
#include <vector>

#include "hal/sim/head/head_look.h"
#include "hal/sim/head/head_model.h"
#include "hal/sim/head/head_scene.h"
#include "hal/sim/optics/lamps.h"

namespace relievo::hal::sim {

class HeadLight {
 public:
  static constexpr std::size_t kPanels = sim::kPanels;
  HeadLight(const HeadModel& model, const HeadPose& pose, ThreadPool& pool, const HeadLighting& lighting);

  struct Point {
    Vec3 at, normal, to_eye;  // unit vectors
    double openness = 1;
    std::array<double, kPanels> seen{1, 1, 1};
  };
  Vec3 on(const Point& point, const Surface& surface) const;
  // A hair: light scattered by a thin cylinder (Kajiya and Kay, 1989).
  Vec3 on_hair(const Point& point, Vec3 tangent, Vec3 colour) const;
  std::array<double, kPanels> seen(std::size_t shell, const std::array<std::uint32_t, 3>& corner, double u,
                                   double v) const;
  double seen_from(const HeadModel& model, Vec3 p, std::size_t panel) const;

 private:
  void measure(const HeadModel& model, std::size_t shell, std::size_t panel, ThreadPool& pool);
  Vec3 ambient(Vec3 normal, double openness, const Surface& surface) const;
  double highlight(const Panel& panel, const Point& point, double roughness) const;
  std::array<Panel, kPanels> panels_;
  Vec3 up_, eye_;  // the sky, and the place between the cameras
  std::array<std::array<std::vector<float>, kPanels>, HeadModel::BodyCount> seen_;
};

}  // namespace relievo::hal::sim
