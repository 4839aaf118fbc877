// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ViewChoice: one camera for the whole of a part in which the photographs disagree. What moved between two
// exposures (lips, an eyelid) would be shown twice by their mean. Such a part is a connected patch of blocks
// whose colours differ by more than noise; it is widened to where they agree again, so that the seam lies
// there, and taken from the camera that sees more of it, more straightly. A patch that one camera shows
// brighter throughout is a lamp's reflection: view_blend.h decides. Memory: the one given. Thread: one, then
// any. Throws std::bad_alloc.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/texture/blend/exposure_match.h"
#include "pipeline/texture/blend/level_field.h"

namespace relievo::pipeline {

class ViewChoice {
 public:
  // `margin_px`: by how many texels a part is widened, and over how many the choice fades beyond that.
  ViewChoice(const Chart& chart, const ShotPlanes& planes, const ExposureMatch& exposure,
             const LevelField& field, float margin_px, std::pmr::memory_resource* memory);

  // strength: 1 where a camera is chosen, 0 where none is; right: the right one's part of that strength.
  struct Choice {
    float right = 0, strength = 0;
  };
  Choice at(float texel_x, float texel_y) const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }
  void choose(const Chart& chart, const ShotPlanes& planes, std::span<const float> excess,
              std::span<const float> difference, float limit, std::pmr::memory_resource* memory);
  void widen(int reach, std::pmr::memory_resource* memory);
  void fade(int reach, std::pmr::memory_resource* memory);
  int columns_, rows_;
  std::pmr::vector<Choice> blocks_;
};

}  // namespace relievo::pipeline
