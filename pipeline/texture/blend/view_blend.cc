// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/blend/view_blend.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/parts.h"
#include "pipeline/model/photo_sampler.h"
#include "pipeline/texture/chart/raster.h"

namespace relievo::pipeline {
namespace {

constexpr int kBlock = 4;          // texels a block and side
constexpr float kSigmas = 2.5F;    // a block's mean difference beyond this many sigmas of a texel's ...
constexpr float kLeastLevels = 3;  // ... and beyond this many grey levels is no noise
constexpr std::size_t kFewestBlocks = 12;
constexpr float kOneSided = 0.8F;  // of the difference, on one side: a reflection, not a movement

using Choices = Plane<ViewChoice>;  // one a block

// Every patch of blocks that differ by `limit` and more, joined through sides and corners, gets its camera.
// `excess`: of the left view.
void choose(const Chart& chart, const ShotPlanes& planes, const Plane<float>& excess,
            const Plane<float>& difference, float limit, std::pmr::memory_resource* memory, Choices& blocks) {
  std::pmr::vector<std::uint8_t> taken(blocks.values.size(), 0, memory);
  std::pmr::vector<std::uint32_t> patch(memory);
  patch.reserve(taken.size());
  for (std::uint32_t seed = 0; seed < taken.size(); ++seed) {
    if (taken[seed] != 0 || difference.values[seed] < limit) continue;
    patch.assign(1, seed);
    taken[seed] = 1;
    float one_way = 0;
    float all = 0;
    float left = 0;
    float right = 0;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      const int u = int(patch[next]) % blocks.width;
      const int v = int(patch[next]) / blocks.width;
      one_way += excess.values[patch[next]];
      all += difference.values[patch[next]];
      const std::size_t k = chart.index(std::min(kBlock * u + 1, chart.width_px - 1),
                                        std::min(kBlock * v + 1, chart.height_px - 1));
      const float share = float(planes.share[k]) / 255;
      left += float(planes.say_left[k]) * (1 - share);
      right += float(planes.say_right[k]) * share;
      for_each_around(u, v, blocks.width, blocks.height, [&](std::uint32_t other) {
        if (taken[other] != 0 || difference.values[other] < limit) return;
        taken[other] = 1;
        patch.push_back(other);
      });
    }
    if (patch.size() < kFewestBlocks || std::abs(one_way) > kOneSided * all) continue;
    for (const std::uint32_t k : patch) blocks.values[k] = {right > left ? 1.0F : 0.0F, 1};
  }
}

// Ring by ring; where two parts meet the stronger evidence is that of the first.
void widen(int reach, Choices& blocks, std::pmr::memory_resource* memory) {
  Choices before(memory, blocks.width, blocks.height);
  for (int ring = 0; ring < reach; ++ring) {
    before.values = blocks.values;
    for (int v = 0; v < blocks.height; ++v)
      for (int u = 0; u < blocks.width; ++u) {
        if (before.row(v)[u].strength > 0) continue;
        for_each_around(u, v, blocks.width, blocks.height, [&](std::uint32_t k) {
          if (before.values[k].strength > 0) blocks.row(v)[u] = before.values[k];
        });
      }
  }
}

// Falls to nothing over so many blocks, and never before the widened part ends.
void fade(int reach, Choices& blocks, std::pmr::memory_resource* memory) {
  Choices before(memory, blocks.width, blocks.height);
  for (int ring = reach; ring > 0; --ring) {
    before.values = blocks.values;
    const float strength = float(ring) / float(reach + 1);
    for (int v = 0; v < blocks.height; ++v)
      for (int u = 0; u < blocks.width; ++u) {
        if (before.row(v)[u].strength > 0) continue;
        ViewChoice sum;
        for_each_around(u, v, blocks.width, blocks.height, [&](std::uint32_t k) {
          sum.right += before.values[k].right, sum.strength += before.values[k].strength;
        });
        if (sum.strength > 0) blocks.row(v)[u] = {strength * sum.right / sum.strength, strength};
      }
  }
}

// One camera for the whole of a part in which the photographs disagree. What moved between two
// exposures (lips, an eyelid) would be shown twice by their mean. Such a part is a connected patch of blocks
// whose colours differ by more than noise; it is widened to where they agree again, so that the seam lies
// there, and taken from the camera that sees more of it, more straightly. A patch that one camera shows
// brighter throughout is a lamp's reflection: ViewBlend decides.
// `margin_px`: by how many texels a part is widened, and over how many the choice fades beyond that.
Choices choose_views(const Chart& chart, const ShotPlanes& planes, const ExposureMatch& exposure,
                     const Plane<Level>& field, float margin_px, std::pmr::memory_resource* memory) {
  const PlaneShape shape{memory, (chart.width_px + kBlock - 1) / kBlock,
                         (chart.height_px + kBlock - 1) / kBlock};
  Choices blocks(shape);
  Plane<float> excess(shape), difference(shape);  // of the left view, mean over the block; and its size
  for (int v = 0; v < blocks.height; ++v)
    for (int u = 0; u < blocks.width; ++u) {
      const Level level = level_at(field, float(kBlock * u) + 1.5F, float(kBlock * v) + 1.5F);
      float signed_sum = 0;
      float sum = 0;
      float count = 0;
      for (int y = kBlock * v; y < std::min(kBlock * v + kBlock, chart.height_px); ++y)
        for (int x = kBlock * u; x < std::min(kBlock * u + kBlock, chart.width_px); ++x) {
          const std::size_t k = chart.index(x, y);
          if (planes.say_left[k] == 0 || planes.say_right[k] == 0) continue;
          for (std::size_t c = 0; c < 3; ++c) {
            const float d =
                float(planes.left[3 * k + c]) + level[c] - exposure.matched(c, planes.right[3 * k + c]);
            signed_sum += d / 3;
            sum += std::abs(d) / 3;
          }
          count += 1;
        }
      if (count == 0) continue;
      excess.row(v)[u] = signed_sum / count;
      difference.row(v)[u] = sum / count;
    }
  const float sigma = (exposure.sigma[0] + exposure.sigma[1] + exposure.sigma[2]) / 3;
  choose(chart, planes, excess, difference, std::max(kSigmas * sigma, kLeastLevels), memory, blocks);
  const int reach = std::max(1, int(std::lround(margin_px / kBlock)));
  widen(reach, blocks, memory);
  fade(reach, blocks, memory);
  return blocks;
}

ViewChoice choice_at(const Choices& blocks, float texel_x, float texel_y) {
  const float x = std::clamp((texel_x + 0.5F) / kBlock - 0.5F, 0.0F, float(blocks.width - 1));
  const float y = std::clamp((texel_y + 0.5F) / kBlock - 0.5F, 0.0F, float(blocks.height - 1));
  const int u = int(x);
  const int v = int(y);
  const float fx = x - float(u);
  const float fy = y - float(v);
  ViewChoice mean;
  for (int k = 0; k < 4; ++k) {
    const float w = (k % 2 == 0 ? 1 - fx : fx) * (k < 2 ? 1 - fy : fy);
    const ViewChoice& block =
        blocks.row(std::min(v + k / 2, blocks.height - 1))[std::min(u + k % 2, blocks.width - 1)];
    mean.right += w * block.right;
    mean.strength += w * block.strength;
  }
  return mean;
}

}  // namespace

ViewBlend::ViewBlend(const Chart& chart, const ShotPlanes& planes, const RowBands& bands,
                     float highlight_level, float margin_px, StageContext& context)
    : chart_(chart),
      planes_(planes),
      exposure_(match_exposure(chart, planes)),
      excess_(chart.pixels(), std::int16_t{0}, &context.scratch),
      shines_(chart.pixels(), std::uint8_t{0}, &context.scratch) {
  // Noise and what is left between the exposures are no highlight, whatever was asked for.
  constexpr float kNoiseSigmas = 3;
  if (highlight_level > 0)
    level_ =
        std::max(highlight_level,
                 kNoiseSigmas * std::max({exposure_.sigma[0], exposure_.sigma[1], exposure_.sigma[2]}) / 2);
  if (level_ > 0) find_highlights(bands, context);
  if (context.stop()) return;
  field_ = measure_levels(chart, planes, exposure_, shines_, &context.scratch);
  if (margin_px > 0) choice_ = choose_views(chart, planes, exposure_, *field_, margin_px, &context.scratch);
}

float ViewBlend::excess_of(const std::uint8_t* left, const std::uint8_t* right) const {
  float least = 1e9F;
  float most = -1e9F;
  for (std::size_t c = 0; c < 3; ++c) {
    const float d = float(left[c]) - exposure_.matched(c, right[c]);
    least = std::min(least, d);
    most = std::max(most, d);
  }
  return least > 0 ? least : std::min(most, 0.0F);
}

void ViewBlend::find_highlights(const RowBands& bands, StageContext& context) {
  constexpr std::int16_t kUnknown = -32768;
  constexpr int kRadius = 2;  // texels: noise and a tenth of a pixel of misplacement are smoothed away
  const auto width = std::size_t(chart_.width_px);
  std::pmr::vector<std::int16_t> raw(chart_.pixels(), kUnknown, &context.scratch);
  std::pmr::vector<BoxSum> columns(std::size_t(bands.count()) * width, BoxSum{}, &context.scratch);
  context.pool.for_each(bands.count(), bands.count(), [&](int band) {
    for (std::size_t k = std::size_t(bands.rows(band).begin) * width;
         k < std::size_t(bands.rows(band).end) * width; ++k)
      if (planes_.say_left[k] != 0 && planes_.say_right[k] != 0)
        raw[k] = std::int16_t(16 * excess_of(&planes_.left[3 * k], &planes_.right[3 * k]));
  });
  context.pool.for_each(bands.count(), bands.count(), [&](int band) {
    slide_box(
        chart_.width_px, chart_.height_px, kRadius, bands.rows(band),
        std::span(columns).subspan(std::size_t(band) * width, width),
        [&](int x, int y) {
          const std::int16_t d = raw[chart_.index(x, y)];
          return d == kUnknown ? BoxSum{} : BoxSum{d, 1};
        },
        [&](int x, int y, const BoxSum& sum) {
          const std::size_t k = chart_.index(x, y);
          if (raw[k] == kUnknown || sum.second == 0) return;
          excess_[k] = std::int16_t(sum.first / sum.second);
          shines_[k] = float(std::abs(excess_[k])) > 16 * level_ ? 1 : 0;
        });
  });
}

ViewBlend::Colour ViewBlend::mix(const Views& v, float texel_x, float texel_y) const {
  constexpr float kLeast = 0.004F;  // of a view not chosen: it shows what the chosen one cannot see
  const ViewChoice choice = choice_ ? choice_at(*choice_, texel_x, texel_y) : ViewChoice{};
  float share = std::clamp(v.share * (1 - choice.strength) + choice.right, kLeast * choice.strength,
                           1 - kLeast * choice.strength);
  const float by_left = (1 - share) * float(v.say_left);
  const float by_right = share * float(v.say_right);
  if (by_left + by_right > 0) {
    share = by_right / (by_left + by_right);
  } else if ((v.seen & (kSeenLeft | kSeenRight)) != (kSeenLeft | kSeenRight)) {
    share = (v.seen & kSeenRight) != 0 ? 1 : 0;
  }
  // The darker view takes over where both have something to say; from one level of excess to two.
  if (level_ > 0 && v.say_left != 0 && v.say_right != 0) {
    const float trust = (1 - choice.strength) * std::clamp(std::abs(v.excess) / level_ - 1, 0.0F, 1.0F);
    share += trust * ((v.excess > 0 ? 1.0F : 0.0F) - share);
  }
  const Level level = level_at(*field_, texel_x, texel_y);
  Colour out{};
  out.share = share;
  for (std::size_t c = 0; c < 3; ++c) {
    const float left = float(v.left[c]);
    out.rgb[c] = left + share * (exposure_.matched(c, v.right[c]) - left) + (v.share - share) * level[c];
  }
  return out;
}

ViewBlend::Colour ViewBlend::mix(std::size_t k, int x, int y) const {
  return mix(Views{&planes_.left[3 * k], &planes_.right[3 * k], float(planes_.share[k]) / 255,
                   planes_.say_left[k], planes_.say_right[k], planes_.seen[k], float(excess_[k]) / 16},
             float(x), float(y));
}

}  // namespace relievo::pipeline
