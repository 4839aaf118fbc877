// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/blend/view_blend.h"

#include <algorithm>
#include <cmath>

#include "pipeline/model/photo_sampler.h"
#include "pipeline/texture/chart/box_window.h"

namespace relievo::pipeline {

ViewBlend::ViewBlend(const Chart& chart, const ShotPlanes& planes, const RowBands& bands,
                     float highlight_level, float margin_px, StageContext& context)
    : chart_(chart),
      planes_(planes),
      exposure_(match_exposure(chart, planes)),
      excess_(chart.size(), std::int16_t{0}, &context.scratch),
      shines_(chart.size(), std::uint8_t{0}, &context.scratch) {
  // Noise and what is left between the exposures are no highlight, whatever was asked for.
  constexpr float kSigmas = 3;
  if (highlight_level > 0)
    level_ = std::max(highlight_level,
                      kSigmas * std::max({exposure_.sigma[0], exposure_.sigma[1], exposure_.sigma[2]}) / 2);
  if (level_ > 0) find_highlights(bands, context);
  if (context.stop()) return;
  field_.emplace(chart, planes, exposure_, shines_, &context.scratch);
  if (margin_px > 0) choice_.emplace(chart, planes, exposure_, *field_, margin_px, &context.scratch);
}

float ViewBlend::excess_of(const std::uint8_t* left, const std::uint8_t* right) const {
  float least = 1e9F;
  float most = -1e9F;
  for (std::size_t c = 0; c < 3; ++c) {
    const float d = static_cast<float>(left[c]) - exposure_.matched(c, right[c]);
    least = std::min(least, d);
    most = std::max(most, d);
  }
  return least > 0 ? least : std::min(most, 0.0F);
}

void ViewBlend::find_highlights(const RowBands& bands, StageContext& context) {
  struct Work {
    ViewBlend& self;
    const RowBands& bands;
    std::span<std::int16_t> raw;
    std::span<BoxSum> columns;
  };
  constexpr std::int16_t kUnknown = -32768;
  std::pmr::vector<std::int16_t> raw(chart_.size(), kUnknown, &context.scratch);
  std::pmr::vector<BoxSum> columns(
      static_cast<std::size_t>(bands.count()) * static_cast<std::size_t>(chart_.width_px), BoxSum{},
      &context.scratch);
  Work work{*this, bands, raw, columns};
  context.pool.for_each_band(bands.count(), bands.count(), [&work](int begin, int end, int) {
    const ShotPlanes& planes = work.self.planes_;
    const auto width = static_cast<std::size_t>(work.self.chart_.width_px);
    for (std::size_t k = static_cast<std::size_t>(work.bands.rows(begin).begin) * width;
         k < static_cast<std::size_t>(work.bands.rows(end - 1).end) * width; ++k)
      if (planes.say_left[k] != 0 && planes.say_right[k] != 0)
        work.raw[k] =
            static_cast<std::int16_t>(16 * work.self.excess_of(&planes.left[3 * k], &planes.right[3 * k]));
  });
  context.pool.for_each_band(bands.count(), bands.count(), [&work](int begin, int end, int) {
    constexpr int kRadius = 2;  // texels: noise and a tenth of a pixel of misplacement are smoothed away
    ViewBlend& self = work.self;
    const auto width = static_cast<std::size_t>(self.chart_.width_px);
    for (int band = begin; band < end; ++band)
      slide_box(
          self.chart_.width_px, self.chart_.height_px, kRadius, work.bands.rows(band),
          work.columns.subspan(static_cast<std::size_t>(band) * width, width),
          [&](int x, int y) {
            const std::int16_t d = work.raw[self.chart_.index(x, y)];
            return d == kUnknown ? BoxSum{} : BoxSum{d, 1};
          },
          [&](int x, int y, const BoxSum& sum) {
            const std::size_t k = self.chart_.index(x, y);
            if (work.raw[k] == kUnknown || sum.second == 0) return;
            self.excess_[k] = static_cast<std::int16_t>(sum.first / sum.second);
            self.shines_[k] = static_cast<float>(std::abs(self.excess_[k])) > 16 * self.level_ ? 1 : 0;
          });
  });
}

ViewBlend::Colour ViewBlend::mix(const Views& v, float texel_x, float texel_y) const {
  constexpr float kLeast = 0.004F;  // of a view not chosen: it shows what the chosen one cannot see
  const ViewChoice::Choice choice = choice_ ? choice_->at(texel_x, texel_y) : ViewChoice::Choice{};
  float share = std::clamp(v.share * (1 - choice.strength) + choice.right, kLeast * choice.strength,
                           1 - kLeast * choice.strength);
  const float by_left = (1 - share) * static_cast<float>(v.say_left);
  const float by_right = share * static_cast<float>(v.say_right);
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
  const LevelField::Level level = field_->at(texel_x, texel_y);
  Colour out{};
  out.share = share;
  for (std::size_t c = 0; c < 3; ++c) {
    const float left = static_cast<float>(v.left[c]);
    out.rgb[c] = left + share * (exposure_.matched(c, v.right[c]) - left) + (v.share - share) * level[c];
  }
  return out;
}

ViewBlend::Colour ViewBlend::mix(std::size_t k, int x, int y) const {
  return mix(
      Views{&planes_.left[3 * k], &planes_.right[3 * k], static_cast<float>(planes_.share[k]) / 255,
            planes_.say_left[k], planes_.say_right[k], planes_.seen[k], static_cast<float>(excess_[k]) / 16},
      static_cast<float>(x), static_cast<float>(y));
}

}  // namespace relievo::pipeline
