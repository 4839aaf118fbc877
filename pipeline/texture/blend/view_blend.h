// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ViewBlend: one colour from two photographs. Where one is brighter than the other in every channel,
// after the exposures are matched, it shows light mirrored towards that camera (Shafer: Using color to
// separate reflection components, 1985: mirrored light adds the lamp's colour), and the darker one is the
// skin. Where they disagree otherwise, something moved: one camera shows the whole of it (ViewChoice).
// Thread: prepared by one, then mix() by any number.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/texture/blend/level_field.h"
#include "pipeline/texture/blend/shot_planes.h"

namespace relievo::pipeline {

// ViewChoice: one camera for the whole of a part in which the photographs disagree. What moved between two
// exposures (lips, an eyelid) would be shown twice by their mean. Such a part is a connected patch of blocks
// whose colours differ by more than noise; it is widened to where they agree again, so that the seam lies
// there, and taken from the camera that sees more of it, more straightly. A patch that one camera shows
// brighter throughout is a lamp's reflection: ViewBlend decides. Thread: one, then any. Throws
// std::bad_alloc.
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
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(columns_) + std::size_t(x); }
  template <typename See>
  void around(int u, int v, See&& see) const;
  void choose(const Chart& chart, const ShotPlanes& planes, std::span<const float> excess,
              std::span<const float> difference, float limit, std::pmr::memory_resource* memory);
  void widen(int reach, std::pmr::memory_resource* memory);
  void fade(int reach, std::pmr::memory_resource* memory);
  int columns_, rows_;
  std::pmr::vector<Choice> blocks_;
};

class ViewBlend {
 public:
  // `highlight_level`: grey levels by which a view must be brighter to lose its say; 0 keeps both.
  ViewBlend(const Chart& chart, const ShotPlanes& planes, const RowBands& bands, float highlight_level,
            float margin_px, StageContext& context);

  struct Colour {
    float rgb[3];
    float share;
  };  // share of the right photograph in it
  // Where a photograph shows the surface: say_* 0 to 255, `excess` how much brighter the left one is.
  struct Views {
    const std::uint8_t* left;
    const std::uint8_t* right;
    float share;
    std::uint8_t say_left, say_right, seen;
    float excess;
  };
  Colour mix(const Views& views, float texel_x, float texel_y) const;
  Colour mix(std::size_t k, int x, int y) const;  // of a texel of the chart

  // How much the left colour exceeds the matched right one in the channel where it does least; signed.
  float excess_of(const std::uint8_t* left, const std::uint8_t* right) const;

 private:
  void find_highlights(const RowBands& bands, StageContext& context);
  const Chart& chart_;
  const ShotPlanes& planes_;
  ExposureMatch exposure_;
  float level_ = 0;                        // 0: highlights are kept
  std::pmr::vector<std::int16_t> excess_;  // sixteenths of a grey level, smoothed
  std::pmr::vector<std::uint8_t> shines_;
  std::optional<LevelField> field_;
  std::optional<ViewChoice> choice_;  // none where one view alone counts
};

}  // namespace relievo::pipeline
