// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HighlightRemover ("remove-highlights"): takes out of the grey values what lamps add that oily skin mirrors.
// Two cameras see a lamp's mirror image at two places of the skin, so that who matches it finds a surface
// behind the face: half a millimetre on a forehead, 1.5 to 4 mm at the tip of a nose. Skin's own colour is
// reddish and what it mirrors has the lamp's colour (dichromatic reflection, Shafer 1985), white after the
// camera's white balance. R - (G + B) / 2 of linear light does not see white (after Mallick, Zickler,
// Kriegman, Belhumeur 2005); times what it is short of the brightness where the skin is dull, it says how
// bright the skin would be without; lips, blemishes and noses that are redder than the rest go by the least
// white nearby. What is brighter than that, over `radius_px`, is subtracted: little of what is less than
// `least`, which stands above what compressed pictures get wrong in colours, most of what is twice that.
// Pores and freckles, finer than that, stay. What has next to no colour is no skin (the white of an eye,
// teeth, a beard) and stays. Looks only where a face may be: pictures in which no region is marked stay as
// they are, and those without colour. The pictures' values are taken for sRGB's (IEC 61966-2-1). Errors:
// InvalidInput (a view without pixels), OutOfMemory, Cancelled.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct HighlightRemover {
  double radius_px =
      2.5;  // standard deviation of the Gaussian: finer than mirrored lamps, coarser than pores
  double dull = 0.5;
  double least = 10;

  void describe(auto&& field) {
    field("radius_px", radius_px, OptionRange{0.5, 10},
          "what is finer than this stays, pixels of the picture");
    field("dull", dull, OptionRange{0.05, 0.95}, "share of the face that is taken to mirror no lamp");
    field("least", least, OptionRange{0, 64},
          "grey levels of brightness of which half is taken for a highlight's");
  }
  Result<void> process(RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline
