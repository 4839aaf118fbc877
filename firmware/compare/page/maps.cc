// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/page/maps.h"

#include <algorithm>
#include <cmath>

#include "hal/base/statistics.h"
#include "hal/picture_file.h"

namespace relievo::firmware::compare {
namespace {

// From far to near: lightness rises all the way, so that the map reads in grey as well.
constexpr std::array<Rgb, 6> kDepth{Rgb{24, 26, 84},   Rgb{28, 78, 150},  Rgb{26, 134, 160},
                                    Rgb{78, 178, 132}, Rgb{186, 208, 88}, Rgb{252, 232, 120}};
constexpr std::array<Rgb, 8> kRules{Rgb{31, 99, 173}, Rgb{214, 96, 6},  Rgb{134, 60, 156}, Rgb{0, 140, 120},
                                    Rgb{196, 30, 58}, Rgb{120, 110, 0}, Rgb{20, 20, 20},   Rgb{90, 160, 220}};

Rgb mixed(Rgb a, Rgb b, double t) {
  Rgb out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = std::uint8_t(std::lround(a[i] + t * (b[i] - a[i])));
  return out;
}

// Calls colour(x, y) for the map's pixel that each of the small picture's stands for.
template <typename Colour>
Result<Png> small(const Window& window, int most_px, Colour&& colour) {
  const int w = std::min(window.width_px, most_px);
  const int h = std::max(1, int(std::lround(double(window.height_px) * w / std::max(1, window.width_px))));
  std::vector<std::byte> rgb;
  rgb.reserve(3 * std::size_t(w) * std::size_t(h));
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const Rgb c =
          colour(window.left + std::min(window.width_px - 1, (2 * x + 1) * window.width_px / (2 * w)),
                 window.top + std::min(window.height_px - 1, (2 * y + 1) * window.height_px / (2 * h)));
      for (const std::uint8_t value : c) rgb.push_back(static_cast<std::byte>(value));
    }
  return hal::encode_png({rgb.data(), w, h, 3 * w, PixelFormat::Rgb8});
}

// Grows by what the map knows.
void include(const DisparityMap& map, Window& box) {
  for (int y = 0; y < map.height_px; ++y)
    for (int x = 0; x < map.width_px; ++x) {
      if (!map.known(x, y)) continue;
      if (box.width_px == 0) box = {x, y, 1, 1};
      const int right = std::max(box.left + box.width_px, x + 1);
      const int bottom = std::max(box.top + box.height_px, y + 1);
      box.left = std::min(box.left, x);
      box.top = std::min(box.top, y);
      box.width_px = right - box.left;
      box.height_px = bottom - box.top;
    }
}

std::size_t index(const PairFacts& pair, int x, int y) {
  return std::size_t(y) * std::size_t(pair.width_px) + std::size_t(x);
}

// The picture, pale, as ground for what is drawn on it.
Rgb pale(std::uint8_t grey) {
  const auto value = std::uint8_t(130 + grey * 120 / 255);
  return {value, value, value};
}

}  // namespace

Rgb depth_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kDepth.size() - 1);
  const auto first = std::min(std::size_t(at), kDepth.size() - 2);
  return mixed(kDepth[first], kDepth[first + 1], at - double(first));
}

Rgb error_colour(double error_px, double limit_px) {
  constexpr Rgb kFarTint{120, 170, 224};
  constexpr Rgb kNearTint{246, 178, 118};
  constexpr Rgb kExact{248, 248, 246};
  if (std::abs(error_px) > limit_px) return error_px < 0 ? kTooFarColour : kTooNearColour;
  return mixed(kExact, error_px < 0 ? kFarTint : kNearTint, std::abs(error_px) / limit_px);
}

Rgb rule_colour(std::size_t rule) { return kRules[rule % kRules.size()]; }

std::string hex(Rgb colour) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out = "#";
  for (const std::uint8_t value : colour) (out += kDigits[value >> 4U]) += kDigits[value & 15U];
  return out;
}

Reach reach_of(const DisparityMap& map) {
  std::vector<float> known;
  for (const float d : map.values)
    if (!std::isnan(d)) known.push_back(d);
  if (known.empty()) return {};
  const Reach reach{std::floor(percentile(known, 0.005)), std::ceil(percentile(known, 0.995))};
  return reach.most_px > reach.least_px ? reach : Reach{reach.least_px, reach.least_px + 1};
}

Window window_of(const PairFacts& pair, const std::vector<const Run*>& runs) {
  Window box;
  if (pair.truth) include(pair.truth->map, box);
  else
    for (const Run* run : runs)
      if (!run->map.values.empty()) include(run->map, box);
  const Window whole{0, 0, pair.width_px, pair.height_px};
  if (box.width_px == 0 || 2L * box.width_px * box.height_px > 1L * whole.width_px * whole.height_px)
    return whole;
  const int margin = std::max(box.width_px, box.height_px) / 8;
  const int left = std::max(0, box.left - margin);
  const int top = std::max(0, box.top - margin);
  return {left, top, std::min(whole.width_px, box.left + box.width_px + margin) - left,
          std::min(whole.height_px, box.top + box.height_px + margin) - top};
}

Result<Png> grey_picture(const PairFacts& pair, const Window& window, int width_px) {
  return small(window, width_px, [&](int x, int y) {
    const std::uint8_t grey = pair.grey[index(pair, x, y)];
    return Rgb{grey, grey, grey};
  });
}

Result<Png> disparity_picture(const DisparityMap& map, const Reach& reach, const Window& window,
                              int width_px) {
  return small(window, width_px, [&](int x, int y) {
    if (!map.known(x, y)) return kHoleColour;
    return depth_colour((double(map.at(x, y)) - reach.least_px) / (reach.most_px - reach.least_px));
  });
}

Result<Png> error_picture(const DisparityMap& map, const DisparityTruth& truth, double limit_px,
                          const Window& window, int width_px) {
  return small(window, width_px, [&](int x, int y) {
    if (!truth.map.known(x, y)) return kUnknownColour;
    if (!map.known(x, y)) return kMissedColour;
    return error_colour(double(map.at(x, y) - truth.map.at(x, y)), limit_px);
  });
}

Result<Png> rejected_picture(const PairFacts& pair, const Run& run, const Window& window, int width_px) {
  return small(window, width_px, [&](int x, int y) {
    const std::size_t k = index(pair, x, y);
    return run.rejected_by[k] == 0 ? pale(pair.grey[k]) : rule_colour(run.rejected_by[k] - 1U);
  });
}

Result<Png> places_picture(const PairFacts& pair, const SelectorFigures& selector, const Window& window,
                           int width_px) {
  // A dot of at least one pixel of the picture, and of three of the view.
  const int reach = std::max(1, window.width_px / std::max(1, std::min(width_px, window.width_px)) / 2 + 1);
  std::vector<std::uint8_t> held(pair.grey.size(), 0);
  for (const pipeline::Vec2f& place : selector.places_px)
    for (int y = int(place.y) - reach; y <= int(place.y) + reach; ++y)
      for (int x = int(place.x) - reach; x <= int(place.x) + reach; ++x)
        if (x >= 0 && y >= 0 && x < pair.width_px && y < pair.height_px) held[index(pair, x, y)] = 1;
  return small(window, width_px, [&](int x, int y) {
    return held[index(pair, x, y)] != 0 ? kRules[1] : pale(pair.grey[index(pair, x, y)]);
  });
}

}  // namespace relievo::firmware::compare
