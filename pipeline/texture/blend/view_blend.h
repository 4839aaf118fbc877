// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ViewBlend: one colour from two photographs. Where one is brighter than the other in every channel,
// after the exposures are matched, it shows light mirrored towards that camera (Shafer: Using color to
// separate reflection components, 1985: mirrored light adds the lamp's colour), and the darker one is the
// skin. Where they disagree otherwise, something moved: one camera shows the whole of it (ViewChoice).
// Thread: prepared by one, then mix() by any number.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/match/image/plane.h"
#include "pipeline/texture/blend/shot_planes.h"

namespace relievo::pipeline {

// Brings the right photograph to the left one's exposure and white balance: a gain and an offset per channel,
// found on skin that both see. Reduced major axis (both pictures are noisy), repeated with Tukey's weights,
// against highlights, hair and edges (Huber, Ronchetti: Robust Statistics, 2009, ch. 7). Grey levels.
struct ExposureMatch {
  std::array<float, 3> gain{1, 1, 1};
  std::array<float, 3> offset{0, 0, 0};
  std::array<float, 3> sigma{0, 0, 0};  // of left minus matched right, robust
  float matched(std::size_t channel, std::uint8_t right) const {
    return gain[channel] * float(right) + offset[channel];
  }
};

ExposureMatch match_exposure(const Chart& chart, const ShotPlanes& planes);

// The level field: by how much the (exposure-matched) right photograph is brighter than the left one, channel
// by channel, slowly varying over the face; continued smoothly to where one alone sees it. Half added here
// and half taken off there leaves no seam where one gives way to the other: the low band of Burt and Adelson
// (A multiresolution spline with application to image mosaics, ACM TOG 1983), continued as Lempitsky and
// Ivanov level seams (Seamless mosaicing of image-based texture maps, CVPR 2007).
using Level = std::array<float, 3>;
struct LevelSum {
  Level sum{};
  float weight = 0;
  void add(const LevelSum& other, float share) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += share * other.sum[c];
    weight += share * other.weight;
  }
};
// One a cell. `shines`: one a texel, 1 where a highlight makes the views incomparable.
Plane<Level> measure_levels(const Chart& chart, const ShotPlanes& planes, const ExposureMatch& exposure,
                            std::span<const std::uint8_t> shines, std::pmr::memory_resource* memory);
Level level_at(const Plane<Level>& field, float texel_x, float texel_y);

// Which camera shows a part in which the photographs disagree. strength: 1 where one is chosen, 0 where none
// is; right: the right one's part of that strength.
struct ViewChoice {
  float right = 0, strength = 0;
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
  std::optional<Plane<Level>> field_;
  std::optional<Plane<ViewChoice>> choice_;  // one a block; none where one view alone counts
};

}  // namespace relievo::pipeline
