// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulated person's photographs from three sides, pasted onto the surface they show: pictures of the same
// person in any pose, a hundred times as fast as the photographs. The light is that of the first pose, and
// turns with the head. Thread: one caller. Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/sim/head/head_scene.h"
#include "hal/sim/optics/exposure.h"

namespace relievo::test {

class PastedHead {
 public:
  PastedHead(const std::shared_ptr<const hal::sim::HeadModel>& head, ThreadPool& pool);
  // Over what is in the picture.
  void draw(const hal::sim::HeadPose& pose, const hal::sim::SimView& view,
            hal::sim::LightPicture& picture) const;

 private:
  struct Corner {
    hal::sim::Vec3 at, light;  // frame of the head
  };
  void photograph(const hal::sim::Scene& scene, const hal::sim::HeadPose& pose, double side_deg,
                  ThreadPool& pool);
  std::vector<Corner> corners_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace relievo::test
