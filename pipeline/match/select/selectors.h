// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The selectors. Their keypoints are in rows from the top.
// Errors of all: InvalidInput (a pair without pixels), NoFace (an empty region), OutOfMemory, Cancelled.
#pragma once

#include <string>

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

// DenseSelector ("dense", the default): a keypoint on every node of a lattice inside the face region.
// Unlike scattered selectors it keeps neighbourhoods: lattice_step_px is set.
struct DenseSelector {
  int step_px = 2;

  void describe(auto&& field) {
    field("step_px", step_px, OptionRange{1, 16}, "distance between keypoints, pixels");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

// GridSelector ("grid-points"): a keypoint every step_px pixels of a rectangle of the left rectified view,
// from its upper left corner on, as far as it lies in the face region; the dissertation's PatternGrid.
// lattice_step_px is set: neighbourhoods are kept. Errors: InvalidInput (a rectangle that leaves the view).
struct GridSelector {
  int step_px = 8;
  int left_px = 0, top_px = 0;      // the rectangle's corner
  int width_px = 0, height_px = 0;  // 0: to the view's edge

  void describe(auto&& field) {
    field("step_px", step_px, OptionRange{1, 256}, "distance between keypoints, pixels");
    field("left_px", left_px, OptionRange{0, 8191},
          "left edge of the rectangle, pixels of the left rectified view");
    field("top_px", top_px, OptionRange{0, 8191},
          "upper edge of the rectangle, pixels of the left rectified view");
    field("width_px", width_px, OptionRange{0, 8192},
          "width of the rectangle, pixels; 0: to the view's edge");
    field("height_px", height_px, OptionRange{0, 8192},
          "height of the rectangle, pixels; 0: to the view's edge");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

// GoodFeaturesSelector ("good-features"): corners by the smaller eigenvalue of the structure tensor
// (J. Shi and C. Tomasi, Good Features to Track, CVPR 1994); the dissertation's CvGoodTrackingFeatures.
// Several thresholds at once, as there: each of `levels` is a quality (share of the strongest corner's
// eigenvalue) and the least distance between corners of that quality; their results are united, so
// that strong corners may stand close together and weak ones fill plain skin sparsely.
// `binary_thresholds`: grey levels at which the picture is also made black and white and searched for
// corners of the outlines, with the same levels.
// Keypoints are whole pixels; strength is the share of the strongest eigenvalue. Errors: TooFewMatches (no
// corner). Memory: eight planes of the picture's size in `scratch`.
struct GoodFeaturesSelector {
  std::string levels = "0.02:4+0.004:7+0.0005:10";
  std::string binary_thresholds = "none";
  int window_px = 7;
  int max_points = 20'000;
  Result<void> check() const;

  void describe(auto&& field) {
    field("levels", levels, OptionRange{0, 0},
          "QUALITY:DISTANCE_PX joined by '+': corners this good keep this distance; united");
    field("binary_thresholds", binary_thresholds, OptionRange{0, 0},
          "grey levels joined by '+' at which black and white outlines are searched too, or none");
    field("window_px", window_px, OptionRange{3, 31, 2},
          "side of the window a corner is judged in, pixels; odd");
    field("max_points", max_points, OptionRange{1, 1'000'000}, "most keypoints: the strongest are kept");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

// HarrisSelector ("harris"): C. Harris and M. Stephens, A Combined Corner and Edge Detector, 1988:
// det - sensitivity * trace^2 of the structure tensor under a smooth window (three running means, close
// to the paper's Gaussian); peaks among their neighbours (non-maximum suppression) that have at least
// quality^4 of the strongest response: it grows with the fourth power of the contrast. Keypoints are whole
// pixels; strength is the share of the strongest response. Errors: TooFewMatches (no corner). Memory: seven
// planes of the picture's size in `scratch`.
struct HarrisSelector {
  double sensitivity = 0.05;
  double quality = 0.02;
  int window_px = 3;
  int min_distance_px = 4;
  int max_points = 20'000;

  void describe(auto&& field) {
    field("sensitivity", sensitivity, OptionRange{0.01, 0.24}, "how much an edge counts against a corner");
    field("quality", quality, OptionRange{1e-6, 1}, "least contrast, share of the strongest corner's");
    field("window_px", window_px, OptionRange{3, 15, 2},
          "side of each of the three running means, pixels; odd");
    field("min_distance_px", min_distance_px, OptionRange{1, 64}, "corners keep this distance, pixels");
    field("max_points", max_points, OptionRange{1, 1'000'000}, "most keypoints: the strongest are kept");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

// HaarSelector ("haar"): blobs by Haar-like box filters on the integral image, the Fast-Hessian of
// H. Bay, A. Ess, T. Tuytelaars, L. Van Gool, Speeded-Up Robust Features (SURF), CVIU 110, 2008:
// det = Dxx Dyy - (0.9 Dxy)^2 of box filters 9, 15, 21, 27 pixels wide (first octave; twice the growth
// and half the sampling in each further one), peaks among their 26 neighbours in place and size,
// placed by a quadratic (Brown and Lowe 2002), then rounded to whole pixels. A peak needs quality^2 of
// the strongest response: it grows with the square of the contrast. Strength is the share of the strongest
// response. Errors: TooFewMatches (no blob). Memory: ten planes of the picture's size in `scratch`.
struct HaarSelector {
  int octaves = 2;
  double quality = 0.005;
  int min_distance_px = 3;
  int max_points = 20'000;

  void describe(auto&& field) {
    field("octaves", octaves, OptionRange{1, 4},
          "ranges of blob sizes: filters of 9 to 27, 51, 99, 195 pixels");
    field("quality", quality, OptionRange{1e-6, 1}, "least contrast, share of the strongest blob's");
    field("min_distance_px", min_distance_px, OptionRange{1, 64}, "blobs keep this distance, pixels");
    field("max_points", max_points, OptionRange{1, 1'000'000}, "most keypoints: the strongest are kept");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

// WaveletSalientSelector ("wavelet-salient"): E. Loupias, N. Sebe, S. Bres, J.-M. Jolion, Wavelet-based
// salient points for image retrieval, ICIP 2000, with the orthonormal Haar wavelet. From every
// coefficient, of every scale and of the three orientations, the track follows the greatest (in
// magnitude) of its four children down to the finest scale, and ends at the pixel with the greatest
// gradient under that one. The pixel's saliency is the sum of the magnitudes along the track, the greatest of
// all tracks that end there: what varies over large and small scales alike stands out. Keypoints are whole
// pixels; strength is the share of the greatest saliency. Errors: TooFewMatches (nothing varies). Memory:
// four planes of the picture's size in `scratch`.
struct WaveletSalientSelector {
  int scales = 4;
  double quality = 0.01;
  int min_distance_px = 4;
  int max_points = 20'000;

  void describe(auto&& field) {
    field("scales", scales, OptionRange{1, 8},
          "how many dyadic scales tracks may begin at: 2 to 2^scales pixels");
    field("quality", quality, OptionRange{1e-6, 1}, "least saliency, share of the greatest");
    field("min_distance_px", min_distance_px, OptionRange{1, 64}, "points keep this distance, pixels");
    field("max_points", max_points, OptionRange{1, 1'000'000}, "most keypoints: the most salient are kept");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

// RandomSelector ("random"): `max_points` different pixels of the face region, every one equally likely
// (selection sampling: Knuth, The Art of Computer Programming 2, 3.4.2, algorithm S). The same seed
// gives the same pixels on every machine. The yardstick for selectors that claim to know better.
struct RandomSelector {
  int max_points = 20'000;
  int seed = 1;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1, 1'000'000},
          "how many keypoints; all pixels where the region has no more");
    field("seed", seed, OptionRange{0, 2'000'000'000}, "another seed draws other pixels");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

// FileSelector ("file-points"): the keypoints of a text file, one a line (match_text.h): x and y in pixels of
// the left rectified view; further columns are not looked at. What lies outside of the face region is left
// out; the same place is taken once. Errors: NotFound (none is named, or it was not read); InvalidInput with
// the line's number: not two numbers, or outside of the view; NoFace (none in the face region).
struct FileSelector {
  TextFile file;

  void describe(auto&& field) {
    field("path", file, OptionRange{0, 0},
          "text file of keypoints: x,y in pixels of the left rectified view, one a line");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline
