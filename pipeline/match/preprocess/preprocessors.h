// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The preprocessors.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "hal/base/thread_pool.h"
#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

// HighlightRemover ("remove-highlights"): takes out of the grey values what lamps add that oily skin mirrors.
// Two cameras see a lamp's mirror image at two places of the skin, so that who matches it finds a surface
// behind the face: half a millimetre on a forehead, 1.5 to 4 mm at the tip of a nose. Skin's own colour is
// reddish and what it mirrors is white after the camera's white balance (dichromatic reflection, Shafer
// 1985). R - (G + B) / 2 of linear light does not see white (after Mallick, Zickler, Kriegman, Belhumeur
// 2005); times what it is short of the brightness where the skin is dull, it says how bright the skin would
// be without; lips, blemishes and noses that are redder go by the least white nearby. What is brighter than
// that, over `radius_px`, is subtracted: little of what is less than `least`, which stands above what
// compressed pictures get wrong in colours, most of what is twice that. Where lamps are mirrored, pores and
// creases mirror them too, and each camera sees other sides of a pore shine: what a pixel is brighter than
// its own colour says is subtracted as well, by so much as the excess around it stands above the noise of
// single pixels' colours in dull skin. Where colours are coarser than the brightness (single-chip cameras,
// JPEG) what they miss hangs together from pixel to pixel, and what is fine stays, as freckles and pores in
// dull skin do. What has next to no colour is no skin (the white of an eye, teeth, a beard) and stays, as do
// pictures without colour or without a marked region. What lamps add is kept as `mirrored` of each
// view: what is taken out is never quite it, and matches there are less certain. Values are taken for sRGB's
// (IEC 61966-2-1). Errors: InvalidInput (a view without pixels), OutOfMemory, Cancelled.
struct HighlightRemover {
  double radius_px = 2.5;  // sigma of the Gaussian: finer than mirrored lamps, coarser than colours' noise
  double dull = 0.5;
  double least = 10;

  void describe(auto&& field) {
    field("radius_px", radius_px, OptionRange{0.5, 10},
          "what is finer than this goes by single pixels' colours, pixels of the picture");
    field("dull", dull, OptionRange{0.05, 0.95}, "share of the face that is taken to mirror no lamp");
    field("least", least, OptionRange{0, 64},
          "grey levels of brightness of which half is taken for a highlight's");
  }
  Result<void> process(RectifiedPair& pair, StageContext& context) const;
};

// HistogramNormaliser ("histogram-normalise"): each view's grey values are brought to the full range
// 0..255 by the cumulative histogram of its own valid pixels; the dissertation's HistNorm.
// equalise = 1 (the default): grey becomes 255 times the share of darker pixels, classical histogram
// equalisation (Hummel 1977; Gonzalez and Woods, section 3.3): blind to any monotone change of exposure,
// gamma included, as far as both views show the same things. equalise = 0: a linear stretch that sends
// `tail` of the pixels to either end: keeps the proportions, undoes gain and offset. Between: a mixture.
// Errors: InvalidInput (a view without pixels), OutOfMemory, Cancelled.
struct HistogramNormaliser {
  double equalise = 1;
  double tail = 0.005;

  void describe(auto&& field) {
    field("equalise", equalise, OptionRange{0, 1},
          "1: equalised by the cumulative histogram, 0: stretched linearly, between: a mixture");
    field("tail", tail, OptionRange{0, 0.2},
          "share of the pixels that the stretch sends to black, and to white");
  }
  Result<void> process(RectifiedPair& pair, StageContext& context) const;
};

// HistogramTransfer ("histogram-match"): the right view's grey values are changed so that their
// cumulative histogram becomes the left view's (histogram specification; Gonzalez and Woods, section
// 3.3); the dissertation's HistMatch. Histograms are taken where both views are valid, in the face region if
// one is marked: a pixel counts with the one it would meet at the middle of the depth that is searched, so
// that what only one view sees has no say. Blind to any monotone difference of exposure, gamma included.
// Errors: InvalidInput (a view without pixels), OutOfMemory, Cancelled.
struct HistogramTransfer {
  double strength = 1;

  void describe(auto&& field) {
    field("strength", strength, OptionRange{0, 1},
          "1: the right view takes the left one's histogram, 0: it stays, between: a mixture");
  }
  Result<void> process(RectifiedPair& pair, StageContext& context) const;
};

// GreyHistogram: how often each grey level occurs, and its cumulative curve, without steps: inside a
// level (k - 0.5 to k + 0.5) the curve rises linearly, so that a map made of two of them is monotone and
// continuous and keeps what lies between whole levels.
// Thread: any; the counts are whole numbers, so bands add up to the same on any number of threads.
class GreyHistogram {
 public:
  static constexpr int kLevels = 256;

  // `wanted` says which pixels count. Values beyond 0..255 count as the end levels.
  using Wanted = std::function<bool(int x, int y)>;
  static GreyHistogram of(const std::pmr::vector<float>& grey, int width_px, int height_px,
                          const Wanted& wanted, ThreadPool& pool);

  std::uint64_t count() const { return below_[kLevels]; }
  // Share of the counted pixels darker than `grey`, 0 to 1. Needs count() > 0.
  double share_below(double grey) const;
  // The grey below which `share` of the pixels lie; in the middle of a gap where many would do.
  double grey_at(double share) const;

 private:
  std::array<std::uint64_t, kLevels + 1> below_{};  // pixels darker than k - 0.5
};

}  // namespace relievo::pipeline
