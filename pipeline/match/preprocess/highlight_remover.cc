// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/preprocess/preprocessors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/image/plane_filters.h"

namespace relievo::pipeline {
namespace {

constexpr int kRowBands = 16;

constexpr int kCell = 2;  // pixels of a cell's side: what is looked for is smooth
// A place says something about the skin's colour where it is lit at all (shares of full light).
constexpr float kLit = 0.05F, kColoured = 0.01F;
// Below this share of the brightness there is no colour to go by: a grey camera, a coloured lamp.
constexpr float kLeastColour = 0.05F;
constexpr float kWhite = 0.2F;  // less of the light than this is skin's: a white of the eye, teeth, a beard
constexpr std::uint8_t kClipped = 252;  // of a channel that has reached its end nobody knows the colour: red
                                        // ends first, and skin would pass for white
constexpr float kReddest = 0.6F;        // of the face's ratio: what is redder than lips is paint
constexpr double kLampReach = 0.03;     // of the face's width, 4.5 mm: half a lamp's image on a lip or a nose
constexpr double kFaceOfPicture = 0.3;  // its width, where no face was looked for
constexpr double kFineRadius = 0.5;     // pixels, a standard deviation: evens out some of the colours' noise
constexpr float kDull =
    0.03F;  // of the grey value: where a lamp adds less, skin tells what colours are worth
// Times the variance of what is fine in dull skin, grey levels: so bright must a lamp's image be for half of
// what is fine in it to be taken for its own. What is mirrored misleads all pixels one way, noise does not.
constexpr float kPerNoise = 1.3F;
// What colours miss at a pixel, squared: of its neighbour as a share of that of one three pixels away. Where
// every pixel has colours of its own it is noise, and the share 0.5 to 0.7; colours that a single-chip camera
// has put together from neighbours (0.35), or JPEG from four pixels (0.2 to 0.3), say nothing of one pixel.
constexpr float kLeastOwn = 0.4F, kOwn = 0.5F;
constexpr double kSkinShare = 0.5;  // of the face's width, to every side of its middle: little but skin

struct Curves {
  static constexpr int kSteps = 4096;  // of the way back: a twentieth of a grey level where it is steepest
  std::array<float, 256> linear{};
  std::array<float, kSteps + 1> grey{};
  Curves() {
    for (std::size_t i = 0; i < linear.size(); ++i) {
      const double v = double(i) / 255;
      linear[i] = float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    for (std::size_t i = 0; i < grey.size(); ++i) {  // by the root of the light, which spreads the dark end
      const double v = std::pow(double(i) / kSteps, 2);
      grey[i] = float(255 * (v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055));
    }
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

struct Pixel {
  float red, rest;  // linear light, green and blue together
  bool known;       // valid, and no channel at its end
  float all() const { return (red + rest) / 3; }
  float colour() const { return red - 0.5F * rest; }
};

Pixel pixel_of(const RectifiedView& view, std::size_t k) {
  const std::array<float, 256>& linear = curves().linear;
  const std::uint8_t* rgb = &view.rgb[3 * k];
  return {linear[rgb[0]], linear[rgb[1]] + linear[rgb[2]],
          view.valid[k] != 0 && std::max({rgb[0], rgb[1], rgb[2]}) < kClipped};
}

// A row of cells.
void gather(const RectifiedView& view, int width_px, const Part& part, Light& light, int cy) {
  constexpr float kShare = 1.0F / (kCell * kCell);
  float* all = light.all.row(cy);
  float* colour = light.colour.row(cy);
  for (int cx = 0; cx < part.width; ++cx) {
    float red = 0, rest = 0;
    bool valid = true;
    for (int i = 0; i < kCell * kCell; ++i) {
      const std::size_t k = std::size_t((part.top + cy) * kCell + i / kCell) * std::size_t(width_px) +
                            std::size_t((part.left + cx) * kCell + i % kCell);
      const Pixel pixel = pixel_of(view, k);
      red += pixel.red, rest += pixel.rest;
      valid = valid && pixel.known;
    }
    all[cx] = valid ? (red + rest) * (kShare / 3) : 0;
    colour[cx] = valid ? (red - 0.5F * rest) * kShare : 0;
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

// Nothing of what is little (noise), all of what is much; smooth between, for an edge would be matched.
float doubted(float excess, float least) {
  return excess * excess * excess / (excess * excess + least * least + 1e-6F);
}

std::size_t first_pixel(const Part& part, int y, int width_px) {
  return std::size_t(part.top * kCell + y) * std::size_t(width_px) + std::size_t(part.left * kCell);
}

float excess_of(float all, float skin) { return curves().to_grey(all) - curves().to_grey(skin); }

// Grey levels per linear light: the slope of sRGB's curve.
float steepness_of(float all) { return (curves().to_grey(all) + 14) / (2.4F * std::max(all, 0.003F)); }

// What the colours of single pixels are worth, by neighbours on dull skin.
struct FineColours {
  float variance = 0;  // of what a pixel is brighter than its colour says, grey levels squared
  float trust = 0;     // 0: there are none
};

FineColours fine_colours_of(const RectifiedView& view, int width_px, const Part& part, const Part& skin,
                            const Light& light, const Plane<float>& ratio,
                            std::pmr::memory_resource* memory) {
  constexpr int kFar = 3;  // pixels
  std::pmr::vector<float> near(memory), far(memory);
  near.reserve(std::size_t(skin.width) * std::size_t(skin.height)), far.reserve(near.capacity());
  double sum = 0;
  for (int y = skin.top; y < skin.top + skin.height; ++y)
    for (int x = skin.left; x < std::min(skin.left + skin.width, part.width - kFar / kCell); ++x) {
      const float all = light.all.row(y)[x], colour = light.colour.row(y)[x], per = ratio.row(y)[x];
      if (all < kLit || colour < kColoured ||
          std::abs(excess_of(all, colour * per)) >= kDull * curves().to_grey(all))
        continue;
      const std::size_t k = first_pixel(part, y * kCell, width_px) + std::size_t(x * kCell);
      const Pixel here = pixel_of(view, k), next = pixel_of(view, k + 1), beyond = pixel_of(view, k + kFar);
      if (!here.known || !next.known || !beyond.known) continue;
      const float steepness = steepness_of(all);
      const auto missed = [per](const Pixel& pixel) { return pixel.all() - per * pixel.colour(); };
      const auto squared = [&](const Pixel& other) {
        const float apart = steepness * (missed(here) - missed(other));
        return apart * apart;
      };
      near.push_back(squared(next)), far.push_back(squared(beyond));
      sum += double(near.back());
    }
  if (near.empty()) return {};
  const auto variance = float(sum / 2 / double(near.size()));
  const double beyond = median(far);
  if (!(beyond > 0)) return {};
  return {variance, std::clamp((float(median(near) / beyond) - kLeastOwn) / (kOwn - kLeastOwn), 0.0F, 1.0F)};
}

// What lamps add, in cells.
struct Mirrored {
  Plane<float> light;   // linear, coarser than `radius_px`
  Plane<float> excess;  // the same in grey levels
  Plane<float> taken;   // of that what is to be taken away
  Plane<float> fine;    // grey levels to be taken away for finer linear light
  Plane<float> belief;  // how far all of them are to be believed
};

void find_mirrored(const Light& light, const Plane<float>& ratio, const FineColours& colours,
                   Mirrored& mirrored, int y) {
  for (int x = 0; x < ratio.width; ++x) {
    const float all = light.all.row(y)[x];
    const float skin = light.colour.row(y)[x] * ratio.row(y)[x];  // light without the lamp's
    const float excess = std::max(0.0F, excess_of(all, skin)),
                lit = std::max(0.0F, excess - kDull * curves().to_grey(all)),
                bright = kPerNoise * colours.variance;
    const float share = colours.trust * lit * lit / (lit * lit + bright * bright + 1e-6F);
    mirrored.light.row(y)[x] = all - skin;
    mirrored.excess.row(y)[x] = excess;
    mirrored.fine.row(y)[x] = share * steepness_of(all);
    mirrored.belief.row(y)[x] = std::clamp((skin - kWhite * all) / (kWhite * all + 1e-6F), 0.0F, 1.0F);
  }
}

// Next to a grey wall or an eye the Gaussian mixes skin with what is none: nothing is believed there.
void weigh(Mirrored& mirrored, float least, int reach, ThreadPool& pool, Plane<float>& room) {
  erode(mirrored.belief, reach, pool, room);
  for (std::size_t i = 0; i < mirrored.belief.values.size(); ++i) {
    const float belief = mirrored.belief.values[i];
    mirrored.taken.values[i] = doubted(mirrored.excess.values[i], least) * belief;
    mirrored.excess.values[i] *= belief;
    mirrored.fine.values[i] *= belief;
  }
}

// A row of pixels between cells, whose values stand in their middles.
void spread(const Plane<float>& cells, int y, float* to) {
  static_assert(kCell == 2);
  const int near = y / kCell, far = std::clamp(near + (y % kCell == 0 ? -1 : 1), 0, cells.height - 1);
  const float *near_row = cells.row(near), *far_row = cells.row(far);
  const auto at = [&](int x) { return 0.75F * near_row[x] + 0.25F * far_row[x]; };
  float before = at(0), here = before;
  for (int x = 0; x < cells.width; ++x) {
    const float next = at(std::min(x + 1, cells.width - 1));
    to[kCell * x] = 0.75F * here + 0.25F * before;
    to[kCell * x + 1] = 0.75F * here + 0.25F * next;
    before = here, here = next;
  }
}

// What single pores and creases mirror: what a pixel is brighter than its colour says, beyond that of its
// cell. `room`: as wide and high as `fine`, or more.
void find_fine(const RectifiedView& view, int width_px, const Part& part, const Plane<float>& ratio,
               const Mirrored& mirrored, Plane<float>& fine, Plane<float>& room, int y) {
  const std::size_t first = first_pixel(part, y, width_px);
  float *to = fine.row(y), *cells = room.row(y);
  spread(mirrored.light, y, to);
  spread(ratio, y, cells);
  for (int x = 0; x < fine.width; ++x) {
    const Pixel pixel = pixel_of(view, first + std::size_t(x));
    to[x] = pixel.known ? pixel.all() - cells[x] * pixel.colour() - to[x] : 0;
  }
  spread(mirrored.fine, y, cells);
  for (int x = 0; x < fine.width; ++x) to[x] *= cells[x];
}

// Takes what is mirrored out of the grey values, and keeps how much there was.
void subtract(const Mirrored& mirrored, const Plane<float>& fine, const Part& part, int width_px,
              RectifiedView& view, Plane<float>& room, int y) {
  const std::size_t first = first_pixel(part, y, width_px);
  float *to = view.grey.data() + first, *coarse = room.row(y);
  const float* pores = fine.row(y);
  spread(mirrored.taken, y, coarse);
  for (int x = 0; x < fine.width; ++x) to[x] = std::max(0.0F, to[x] - std::max(0.0F, coarse[x] + pores[x]));
  spread(mirrored.excess, y, coarse);
  for (int x = 0; x < fine.width; ++x)
    view.mirrored[first + std::size_t(x)] = std::uint8_t(std::min(coarse[x] + 0.5F, 255.0F));
}

void clean(RectifiedPair& pair, bool right, const HighlightRemover& options, const Gaussian& gaussian,
           StageContext& context) {
  RectifiedView& view = right ? pair.right : pair.left;
  const Part part = part_of(pair, right, kCell * gaussian.reach());
  if (part.width == 0 || part.height == 0) return;
  Light light{{&context.scratch, part.width, part.height}, {&context.scratch, part.width, part.height}};
  Plane<float> room(&context.scratch, part.width + 2 * gaussian.reach(), part.height);
  context.pool.for_each(part.height, kRowBands, [&](int y) { gather(view, pair.width_px, part, light, y); });
  gaussian.smooth(light.all, context.pool, room);
  gaussian.smooth(light.colour, context.pool, room);
  const Part skin = skin_of(pair, right, part);
  const float ratio = dull_ratio(skin, light, options.dull, &context.scratch);
  if (!(ratio > 0)) return;
  const auto plane = [&] { return Plane<float>(&context.scratch, part.width, part.height); };
  Plane<float> local = plane();
  const double face = pair.face_width_px > 0 ? pair.face_width_px : kFaceOfPicture * pair.width_px;
  find_local_ratio(light, ratio, std::max(1, int(std::lround(kLampReach * face / kCell))), gaussian,
                   context.pool, local, room);
  const FineColours colours =
      fine_colours_of(view, pair.width_px, part, skin, light, local, &context.scratch);
  Mirrored mirrored{plane(), plane(), plane(), plane(), plane()};
  context.pool.for_each(part.height, kRowBands,
                        [&](int y) { find_mirrored(light, local, colours, mirrored, y); });
  weigh(mirrored, float(options.least), 2 * gaussian.reach() / 3, context.pool, room);
  const Gaussian pixel(kFineRadius);
  Plane<float> fine(&context.scratch, part.width * kCell, part.height * kCell);
  Plane<float> wide(&context.scratch, fine.width + 2 * pixel.reach(), fine.height);
  if (colours.trust > 0) {
    context.pool.for_each(fine.height, kRowBands, [&](int y) {
      find_fine(view, pair.width_px, part, local, mirrored, fine, wide, y);
    });
    pixel.smooth(fine, context.pool, wide);
  }
  view.pores_left = 1 - colours.trust;
  view.mirrored.assign(pair.pixels(), 0);
  context.pool.for_each(fine.height, kRowBands,
                        [&](int y) { subtract(mirrored, fine, part, pair.width_px, view, wide, y); });
}

}  // namespace

Result<void> HighlightRemover::process(RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  if (pair.region.empty()) return {};  // no face is looked for: what is known of skin says nothing of leaves
  const Gaussian gaussian(radius_px / kCell);
  for (const bool right : {false, true}) {
    if (context.stop()) return stopped();
    clean(pair, right, *this, gaussian, context);
  }
  return {};
}

}  // namespace relievo::pipeline
