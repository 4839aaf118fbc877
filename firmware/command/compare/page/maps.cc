// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/command/compare/page/maps.h"

#include <algorithm>
#include <cmath>

#include "hal/picture_file.h"

namespace relievo::firmware::compare {
namespace {

// From far to near: lightness rises all the way, so that the map reads in grey as well.
constexpr std::array<Rgb, 6> kDepth{Rgb{24, 26, 84}, Rgb{28, 78, 150}, Rgb{26, 134, 160}, Rgb{78, 178, 132}, Rgb{186, 208, 88}, Rgb{252, 232, 120}};
constexpr std::array<Rgb, 8> kRules{Rgb{31, 99, 173},  Rgb{214, 96, 6},  Rgb{134, 60, 156}, Rgb{0, 140, 120},
                                    Rgb{196, 30, 58},  Rgb{120, 110, 0}, Rgb{20, 20, 20},   Rgb{90, 160, 220}};

Rgb mixed(Rgb a, Rgb b, double t) {
  Rgb out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = static_cast<std::uint8_t>(std::lround(a[i] + t * (b[i] - a[i])));
  return out;
}

// Calls colour(x, y) for the map's pixel that each of the small picture's stands for.
template <typename Colour>
Result<Png> small(int width, int height, int most_px, Colour&& colour) {
  const int w = std::min(width, most_px);
  const int h = std::max(1, static_cast<int>(std::lround(static_cast<double>(height) * w / std::max(1, width))));
  std::vector<std::byte> rgb;
  rgb.reserve(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const Rgb c = colour(std::min(width - 1, (2 * x + 1) * width / (2 * w)), std::min(height - 1, (2 * y + 1) * height / (2 * h)));
      for (const std::uint8_t value : c) rgb.push_back(static_cast<std::byte>(value));
    }
  return hal::encode_png({rgb.data(), w, h, 3 * w, PixelFormat::Rgb8});
}

std::size_t index(const PairFacts& pair, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(pair.width_px) + static_cast<std::size_t>(x);
}

// The picture, pale, as ground for what is drawn on it.
Rgb pale(std::uint8_t grey) {
  const auto value = static_cast<std::uint8_t>(130 + grey * 120 / 255);
  return {value, value, value};
}

}  // namespace

Rgb depth_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kDepth.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), kDepth.size() - 2);
  return mixed(kDepth[first], kDepth[first + 1], at - static_cast<double>(first));
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
  const auto at = [&known](double share) {
    const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), known.begin() + k, known.end());
    return static_cast<double>(known[static_cast<std::size_t>(k)]);
  };
  const Reach reach{std::floor(at(0.005)), std::ceil(at(0.995))};
  return reach.most_px > reach.least_px ? reach : Reach{reach.least_px, reach.least_px + 1};
}

Result<Png> grey_picture(const PairFacts& pair, int width_px) {
  return small(pair.width_px, pair.height_px, width_px, [&](int x, int y) {
    const std::uint8_t grey = pair.grey[index(pair, x, y)];
    return Rgb{grey, grey, grey};
  });
}

Result<Png> disparity_picture(const DisparityMap& map, const Reach& reach, int width_px) {
  return small(map.width_px, map.height_px, width_px, [&](int x, int y) {
    if (!map.known(x, y)) return kHoleColour;
    return depth_colour((static_cast<double>(map.at(x, y)) - reach.least_px) / (reach.most_px - reach.least_px));
  });
}

Result<Png> error_picture(const DisparityMap& map, const DisparityTruth& truth, double limit_px, int width_px) {
  return small(map.width_px, map.height_px, width_px, [&](int x, int y) {
    if (!truth.map.known(x, y)) return kUnknownColour;
    if (!map.known(x, y)) return kMissedColour;
    return error_colour(static_cast<double>(map.at(x, y) - truth.map.at(x, y)), limit_px);
  });
}

Result<Png> rejected_picture(const PairFacts& pair, const Run& run, int width_px) {
  return small(pair.width_px, pair.height_px, width_px, [&](int x, int y) {
    const std::size_t k = index(pair, x, y);
    return run.rejected_by[k] == 0 ? pale(pair.grey[k]) : rule_colour(run.rejected_by[k] - 1U);
  });
}

Result<Png> places_picture(const PairFacts& pair, const SelectorFigures& selector, int width_px) {
  const double scale = static_cast<double>(std::min(width_px, pair.width_px)) / pair.width_px;
  const int w = std::min(width_px, pair.width_px);
  const int h = std::max(1, static_cast<int>(std::lround(pair.height_px * scale)));
  std::vector<std::uint8_t> held(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0);
  for (const pipeline::Vec2f& place : selector.places_px) {
    const int x = std::clamp(static_cast<int>(static_cast<double>(place.x) * scale), 0, w - 1);
    const int y = std::clamp(static_cast<int>(static_cast<double>(place.y) * scale), 0, h - 1);
    held[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)] = 1;
  }
  return small(pair.width_px, pair.height_px, width_px, [&](int x, int y) {
    const auto i = static_cast<std::size_t>(std::min(w - 1, static_cast<int>(x * scale)));
    const auto j = static_cast<std::size_t>(std::min(h - 1, static_cast<int>(y * scale)));
    return held[j * static_cast<std::size_t>(w) + i] != 0 ? kRules[1] : pale(pair.grey[index(pair, x, y)]);
  });
}

}  // namespace relievo::firmware::compare
