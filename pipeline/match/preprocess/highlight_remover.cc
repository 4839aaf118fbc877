// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/preprocess/preprocessors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hal/base/simd.h"
#include "hal/base/statistics.h"
#include "hal/base/thread_pool.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/preprocess/grey_histogram.h"

namespace relievo::pipeline {
namespace {

// Separable filters of a plane of numbers: Gaussian, erosion and dilation by a square. In place; the plane's
// edge goes on outwards. `room` is theirs to overwrite: as high as the plane, wider by twice Gaussian::reach,
// or as wide. Thread: one caller; uses the pool's. Bit for bit the same for any number of threads.

class Gaussian {
 public:
  explicit Gaussian(double sigma_cells);  // cut off at three sigma, at 16 cells at most
  int reach() const { return reach_; }
  void smooth(Plane<float>& plane, ThreadPool& pool, Plane<float>& room) const;

 private:
  std::array<float, 17> weight_{};  // the middle first, which counts half: each is added from both sides
  int reach_ = 0;
};

constexpr int kRowsOfABand = 16;

// to += weight * (a + b)
RELIEVO_SIMD void add_weighted(const float* a, const float* b, float weight, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] += weight * (a[x] + b[x]);
}

// to = min(to, from)
RELIEVO_SIMD void lower(const float* from, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] = from[x] < to[x] ? from[x] : to[x];
}

// to = max(to, from)
RELIEVO_SIMD void raise(const float* from, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] = from[x] > to[x] ? from[x] : to[x];
}

template <typename Towards>
void over_square(Plane<float>& plane, int reach, Towards towards, ThreadPool& pool, Plane<float>& room) {
  const int width = plane.width, height = plane.height;
  pool.for_each_band(height, kRowsOfABand, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      float* to = room.row(y);
      std::copy_n(plane.row(y), width, to);
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v)
        towards(plane.row(v), width, to);
    }
  });
  pool.for_each_band(height, kRowsOfABand, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      const float* from = room.row(y);
      float* to = plane.row(y);
      std::copy_n(from, width, to);
      for (int i = 1; i <= std::min(reach, width - 1); ++i) {
        towards(from + i, width - i, to);
        towards(from, width - i, to + i);
      }
    }
  });
}

Gaussian::Gaussian(double sigma_cells) {
  reach_ = std::min(int(std::ceil(3 * sigma_cells)), int(weight_.size()) - 1);
  float sum = 0;
  for (int i = 0; i <= reach_; ++i) {
    float& weight = weight_[std::size_t(i)];
    weight = float((i == 0 ? 0.5 : 1.0) * std::exp(-0.5 * i * i / (sigma_cells * sigma_cells)));
    sum += 2 * weight;
  }
  for (float& weight : weight_) weight /= sum;
}

void Gaussian::smooth(Plane<float>& plane, ThreadPool& pool, Plane<float>& room) const {
  const int reach = reach_;
  pool.for_each_band(plane.height, kRowsOfABand, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      float* wide = room.row(y);
      float* to = wide + reach;
      std::fill_n(to, plane.width, 0.0F);
      for (int i = 0; i <= reach; ++i)
        add_weighted(plane.row(std::max(y - i, 0)), plane.row(std::min(y + i, plane.height - 1)),
                     weight_[std::size_t(i)], plane.width, to);
      std::fill_n(wide, reach, to[0]);
      std::fill_n(to + plane.width, reach, to[plane.width - 1]);
    }
  });
  pool.for_each_band(plane.height, kRowsOfABand, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      const float* from = room.row(y) + reach;
      float* to = plane.row(y);
      std::fill_n(to, plane.width, 0.0F);
      for (int i = 0; i <= reach; ++i)
        add_weighted(from - i, from + i, weight_[std::size_t(i)], plane.width, to);
    }
  });
}

// Every value becomes the least, or the most, of the square of 2 * reach + 1 around it.
void erode(Plane<float>& plane, int reach, ThreadPool& pool, Plane<float>& room) {
  over_square(
      plane, reach, [](const float* from, int count, float* to) { lower(from, count, to); }, pool, room);
}

void dilate(Plane<float>& plane, int reach, ThreadPool& pool, Plane<float>& room) {
  over_square(
      plane, reach, [](const float* from, int count, float* to) { raise(from, count, to); }, pool, room);
}

constexpr int kCell =
    2;  // pixels of a cell's side: what is looked for is smooth, a quarter of the work finds it
// A place says something about the skin's colour where it is lit at all (shares of full light).
constexpr float kLit = 0.05F, kColoured = 0.01F;
// Below this share of the brightness there is no colour to go by: a grey camera, a coloured lamp.
constexpr float kLeastColour = 0.05F;
constexpr float kWhite =
    0.2F;  // less of the light than this is skin's: no highlight but a white of the eye, teeth, a beard
constexpr std::uint8_t kClipped = 252;  // of a channel that has reached its end nobody knows the colour: red
                                        // ends first, and skin would pass for white
constexpr float kReddest = 0.6F;        // of the face's ratio: what is redder than lips is paint
constexpr double kLampReach =
    0.03;  // of the face's width, 4.5 mm: a lamp's image on a lip or a nose is less than twice that wide
constexpr double kFaceOfPicture = 0.3;  // its width, where no face was looked for
constexpr double kSkinShare =
    0.5;  // of the face's width, to every side of its middle: cheeks, nose, mouth, little else

double linear_of(double grey) {
  const double v = grey / 255;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double grey_of(double linear) {
  return 255 * (linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

struct Curves {
  static constexpr int kSteps = 4096;  // of the way back: a twentieth of a grey level where it is steepest
  std::array<float, 256> linear{};
  std::array<float, kSteps + 1> grey{};
  Curves() {
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = float(linear_of(double(i)));
    // By the root of the light, which spreads the dark end.
    for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = float(grey_of(std::pow(double(i) / kSteps, 2)));
  }
  float to_grey(float light) const {
    return grey[std::size_t(std::lround(std::sqrt(std::clamp(light, 0.0F, 1.0F)) * float(kSteps)))];
  }
};

const Curves& curves() {
  static const Curves made;
  return made;
}

// Part of a view, in cells.
struct Part {
  int left = 0, top = 0, width = 0, height = 0;
};

// Where the left view's region lies; in the right one, wherever the searched depths may carry it.
Part part_of(const RectifiedPair& pair, bool right, int reach_px) {
  int x0 = pair.width_px, y0 = pair.height_px, x1 = 0, y1 = 0;
  for (int y = 0; y < pair.height_px; ++y) {
    const auto row = pair.region.begin() + std::ptrdiff_t(y) * pair.width_px;
    const auto first = std::find_if(row, row + pair.width_px, [](std::uint8_t r) { return r != 0; });
    if (first == row + pair.width_px) continue;
    int last = pair.width_px - 1;
    while (row[last] == 0) --last;
    x0 = std::min(x0, int(first - row)), x1 = std::max(x1, last + 1);
    y0 = std::min(y0, y), y1 = y + 1;
  }
  if (right && pair.near_mm > 0 && pair.far_mm > 0) {
    x0 -= int(std::ceil(pair.disparity_px(pair.near_mm)));
    x1 -= int(std::floor(pair.disparity_px(pair.far_mm)));
  }
  x0 -= reach_px, y0 -= reach_px, x1 += reach_px, y1 += reach_px;
  Part part;
  part.left = std::clamp(x0, 0, pair.width_px) / kCell;
  part.top = std::clamp(y0, 0, pair.height_px) / kCell;
  part.width = std::max(0, std::clamp(x1, 0, pair.width_px) / kCell - part.left);
  part.height = std::max(0, std::clamp(y1, 0, pair.height_px) / kCell - part.top);
  return part;
}

struct Light {
  Plane<float> all;     // mean of the channels, linear, 0 .. 1
  Plane<float> colour;  // red beyond green and blue
};

void gather(const RectifiedView& view, int width_px, const Part& part, Light& light, int begin, int end) {
  const std::array<float, 256>& linear = curves().linear;
  constexpr float kShare = 1.0F / (kCell * kCell);
  for (int cy = begin; cy < end; ++cy) {
    float* all = light.all.row(cy);
    float* colour = light.colour.row(cy);
    for (int cx = 0; cx < part.width; ++cx) {
      float red = 0, rest = 0;
      bool valid = true;
      for (int i = 0; i < kCell * kCell; ++i) {
        const std::size_t k = std::size_t((part.top + cy) * kCell + i / kCell) * std::size_t(width_px) +
                              std::size_t((part.left + cx) * kCell + i % kCell);
        const std::uint8_t* rgb = &view.rgb[3 * k];
        red += linear[rgb[0]];
        rest += linear[rgb[1]] + linear[rgb[2]];
        valid = valid && view.valid[k] != 0 && std::max({rgb[0], rgb[1], rgb[2]}) < kClipped;
      }
      all[cx] = valid ? (red + rest) * (kShare / 3) : 0;
      colour[cx] = valid ? (red - 0.5F * rest) * kShare : 0;
    }
  }
}

// Which cells say what colour the skin has: about the middle of a face that was found, all of the part else.
// In the right view it stands where the middle of the searched depths puts it.
Part skin_of(const RectifiedPair& pair, bool right, const Part& part) {
  if (!(pair.face_width_px > 0)) return {0, 0, part.width, part.height};
  const double shift = right && pair.near_mm > 0
                           ? 0.5 * (pair.disparity_px(pair.near_mm) + pair.disparity_px(pair.far_mm))
                           : 0;
  const double half = kSkinShare * pair.face_width_px;
  const auto cell = [](double at, int first, int most) {
    return std::clamp(int(at / kCell) - first, 0, most);
  };
  Part skin;
  skin.left = cell(pair.face_centre_px.x - shift - half, part.left, part.width);
  skin.top = cell(pair.face_centre_px.y - half, part.top, part.height);
  skin.width = cell(pair.face_centre_px.x - shift + half, part.left, part.width) - skin.left;
  skin.height = cell(pair.face_centre_px.y + half, part.top, part.height) - skin.top;
  return skin;
}

// Brightness over colour where the skin is dull, of the whole face; 0 where there is no colour to go by.
float dull_ratio(const Part& skin, const Light& light, double dull, std::pmr::memory_resource* memory) {
  std::pmr::vector<float> ratios(memory);
  ratios.reserve(std::size_t(skin.width) * std::size_t(skin.height));
  for (int y = skin.top; y < skin.top + skin.height; ++y)
    for (int x = skin.left; x < skin.left + skin.width; ++x) {
      const float all = light.all.row(y)[x], colour = light.colour.row(y)[x];
      if (all >= kLit && colour >= kColoured) ratios.push_back(all / colour);
    }
  if (ratios.empty()) return 0;
  const auto ratio = float(percentile(ratios, dull));
  return ratio * kLeastColour < 1 ? ratio : 0;
}

// Lips, blemishes and many a nose are redder than the rest of a face, so that a lamp upon them would pass for
// dull skin: there the ratio is that of the least white nearby. A grey opening keeps what is redder and cuts
// off what is whiter, where that is finer than `reach`.
void find_local_ratio(const Light& light, float ratio, int reach, const Gaussian& gaussian, ThreadPool& pool,
                      Plane<float>& local, Plane<float>& room) {
  for (int y = 0; y < local.height; ++y)
    for (int x = 0; x < local.width; ++x) {
      const float all = light.all.row(y)[x], colour = light.colour.row(y)[x];
      local.row(y)[x] =
          all >= kLit && colour >= kColoured ? std::clamp(all / colour, kReddest * ratio, ratio) : ratio;
    }
  erode(local, reach, pool, room);
  dilate(local, reach, pool, room);
  gaussian.smooth(local, pool, room);
}

// Nothing of what is little, for that may be noise; all of what is much; smooth between, for an edge would be
// matched.
float doubted(float excess, float least) {
  return excess * excess * excess / (excess * excess + least * least + 1e-6F);
}

// What is to be taken away, in grey levels, into light.all, and how far it is to be believed, into
// light.colour.
void find_excess(const Plane<float>& ratio, float least, Light& light, int begin, int end) {
  const Curves& c = curves();
  for (int y = begin; y < end; ++y) {
    float* all = light.all.row(y);
    float* colour = light.colour.row(y);
    for (int x = 0; x < ratio.width; ++x) {
      const float seen = c.to_grey(all[x]);
      const float skin = colour[x] * ratio.row(y)[x];  // light without the lamp's
      colour[x] = std::clamp((skin - kWhite * all[x]) / (kWhite * all[x] + 1e-6F), 0.0F, 1.0F);
      all[x] = doubted(std::max(0.0F, seen - c.to_grey(skin)), least);
    }
  }
}

// Next to a grey wall or an eye the Gaussian mixes skin with what is none: nothing is believed there.
void weigh(Light& light, int reach, ThreadPool& pool, Plane<float>& room) {
  erode(light.colour, reach, pool, room);
  for (std::size_t i = 0; i < light.all.values.size(); ++i) light.all.values[i] *= light.colour.values[i];
}

void subtract(const Plane<float>& excess, const Part& part, int width_px, std::pmr::vector<float>& grey,
              int begin, int end) {
  for (int y = begin; y < end; ++y) {
    // A cell's value stands in its middle.
    const float cy = std::clamp((float(y) + 0.5F) / kCell - 0.5F, 0.0F, float(part.height - 1));
    const int y0 = int(cy);
    const float ty = cy - float(y0);
    const float* upper = excess.row(y0);
    const float* lower = excess.row(std::min(y0 + 1, part.height - 1));
    float* to =
        grey.data() + std::ptrdiff_t(part.top * kCell + y) * width_px + std::ptrdiff_t(part.left) * kCell;
    for (int x = 0; x < part.width * kCell; ++x) {
      const float cx = std::clamp((float(x) + 0.5F) / kCell - 0.5F, 0.0F, float(part.width - 1));
      const int x0 = int(cx), x1 = std::min(x0 + 1, part.width - 1);
      const float tx = cx - float(x0);
      const float a = upper[x0] + tx * (upper[x1] - upper[x0]), b = lower[x0] + tx * (lower[x1] - lower[x0]);
      to[x] = std::max(0.0F, to[x] - (a + ty * (b - a)));
    }
  }
}

void clean(RectifiedPair& pair, bool right, const HighlightRemover& options, const Gaussian& gaussian,
           StageContext& context) {
  RectifiedView& view = right ? pair.right : pair.left;
  const Part part = part_of(pair, right, kCell * gaussian.reach());
  if (part.width == 0 || part.height == 0) return;
  Light light{{&context.scratch, part.width, part.height}, {&context.scratch, part.width, part.height}};
  Plane<float> room(&context.scratch, part.width + 2 * gaussian.reach(), part.height);
  context.pool.for_each_band(part.height, kRowsOfABand, [&](int begin, int end, int) {
    gather(view, pair.width_px, part, light, begin, end);
  });
  gaussian.smooth(light.all, context.pool, room);
  gaussian.smooth(light.colour, context.pool, room);
  const float ratio = dull_ratio(skin_of(pair, right, part), light, options.dull, &context.scratch);
  if (!(ratio > 0)) return;
  Plane<float> local(&context.scratch, part.width, part.height);
  const double face = pair.face_width_px > 0 ? pair.face_width_px : kFaceOfPicture * pair.width_px;
  find_local_ratio(light, ratio, std::max(1, int(std::lround(kLampReach * face / kCell))), gaussian,
                   context.pool, local, room);
  context.pool.for_each_band(part.height, kRowsOfABand, [&](int begin, int end, int) {
    find_excess(local, float(options.least), light, begin, end);
  });
  weigh(light, 2 * gaussian.reach() / 3, context.pool, room);
  context.pool.for_each_band(part.height * kCell, kRowsOfABand, [&](int begin, int end, int) {
    subtract(light.all, part, pair.width_px, view.grey, begin, end);
  });
}

}  // namespace

Result<void> HighlightRemover::process(RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  if (pair.region.empty()) return {};  // no face is looked for: what is known of skin says nothing of leaves
  const Gaussian gaussian(radius_px / kCell);
  for (const bool right : {false, true}) {
    if (context.stop()) return Error{Errc::Cancelled, "the preprocessing was stopped"};
    clean(pair, right, *this, gaussian, context);
  }
  return {};
}

}  // namespace relievo::pipeline
