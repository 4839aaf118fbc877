// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Selectors find what they are for, in pictures whose corners and blobs are known; fast forms agree with
// slow ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "pipeline/match/select/response/corner_response.h"
#include "pipeline/pipeline.h"
#include "tests/pipeline/match/select/selection_fixture.h"
#include "tests/support/rig_calibration.h"

namespace relievo::pipeline {
namespace {

using test::make_selector;
using test::SelectionFixture;

float& pixel(RectifiedPair& pair, int x, int y) {
  return pair.left.grey[static_cast<std::size_t>(y * pair.width_px + x)];
}

// Bright squares; returns their corners (between pixels).
std::vector<Vec2f> paint_squares(RectifiedPair& pair) {
  std::vector<Vec2f> corners;
  for (const auto& [left, top, side] :
       {std::array{30, 25, 40}, std::array{110, 40, 55}, std::array{40, 95, 45}}) {
    for (int y = top; y < top + side; ++y)
      for (int x = left; x < left + side; ++x) pixel(pair, x, y) = 190;
    for (const int y : {top, top + side})
      for (const int x : {left, left + side})
        corners.push_back({static_cast<float>(x) - 0.5F, static_cast<float>(y) - 0.5F});
  }
  return corners;
}

float nearest(const Vec2f& at, const Keypoints& points) {
  float best = 1e9F;
  for (const Keypoint& p : points.points)
    best = std::min(best, std::hypot(p.at_px.x - at.x, p.at_px.y - at.y));
  return best;
}

class Corners : public testing::TestWithParam<const char*> {};

// The corner lies in the window of what is found: 7 pixels square, half a diagonal and half a pixel.
TEST_P(Corners, OfSquaresAreFoundAndTheirEdgesAreNot) {
  SelectionFixture fixture;
  RectifiedPair pair = fixture.plain();
  const auto corners = paint_squares(pair);
  const auto found = fixture.select(
      make_selector(GetParam(), {{"good-features.levels", "0.3:4"}, {"harris.quality", "0.7"}}), pair);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->points.size(), corners.size());
  for (const Vec2f& corner : corners) EXPECT_LT(nearest(corner, *found), 4.3F) << corner.x << " " << corner.y;
}

INSTANTIATE_TEST_SUITE_P(Both, Corners, testing::Values("good-features", "harris"),
                         [](const auto& name) { return test::test_name(name.param); });

TEST(GoodFeatures, LevelsAreUnitedAndEachKeepsItsDistance) {
  SelectionFixture fixture;
  const auto& pair = SelectionFixture::rendered();
  using Place = std::pair<float, float>;
  const auto places = [&](const char* levels) {
    std::set<Place> all;
    const auto chosen =
        fixture.select(make_selector("good-features", {{"good-features.levels", levels}}), pair);
    EXPECT_TRUE(chosen);
    for (const Keypoint& p : chosen->points) all.insert({p.at_px.x, p.at_px.y});
    return all;
  };
  const auto strong = places("0.3:2"), weak = places("0.02:12"), both = places("0.3:2+0.02:12");
  std::set<Place> united = strong;
  united.insert(weak.begin(), weak.end());
  EXPECT_EQ(both, united);
  EXPECT_GT(united.size(), strong.size());
  EXPECT_GT(united.size(), weak.size());
  for (const Place& a : weak)
    for (const Place& b : weak)
      EXPECT_TRUE(a == b || std::hypot(a.first - b.first, a.second - b.second) >= 12);
}

TEST(GoodFeatures, BinaryThresholdsFindOutlinesTheGreyPictureHides) {
  SelectionFixture fixture;
  RectifiedPair pair = fixture.plain();
  paint_squares(pair);
  for (int y = 10; y < 20; ++y)
    for (int x = 150; x < 175; ++x) pixel(pair, x, y) = 44;  // four grey levels above the ground
  const Vec2f corner{149.5F, 9.5F};
  const auto grey = fixture.select(make_selector("good-features", {{"good-features.levels", "0.3:4"}}), pair);
  const auto binary = fixture.select(
      make_selector("good-features",
                    {{"good-features.levels", "0.3:4"}, {"good-features.binary_thresholds", "42+100"}}),
      pair);
  ASSERT_TRUE(grey && binary);
  EXPECT_GT(nearest(corner, *grey), 10);
  EXPECT_LT(nearest(corner, *binary), 4.3F);
}

TEST(GoodFeatures, TakeUpToSixteenLevels) {
  const auto makes = [](const char* option, const std::string& part, int count) {
    std::string parts = part;
    for (int k = 1; k < count; ++k) parts += "+" + part;
    AlgorithmSet set;
    EXPECT_TRUE(set.set("selector", "good-features") && set.set(option, parts));
    return pipeline::make_algorithms(set).has_value();
  };
  EXPECT_TRUE(makes("good-features.levels", "0.1:4", 16));
  EXPECT_FALSE(makes("good-features.levels", "0.1:4", 17));
  EXPECT_TRUE(makes("good-features.binary_thresholds", "64", 16));
  EXPECT_FALSE(makes("good-features.binary_thresholds", "64", 17));
}

TEST(GoodFeatures, WrongLevelsAreRefused) {
  for (const char* levels : {"", "0.1", "0.1:", ":4", "0.1:4+", "0:4", "1.1:4", "0.1:0.5", "0.1:4x", "nan:4",
                             "0.1:1e9", "0.1:4,0.2:3"}) {
    AlgorithmSet set;
    ASSERT_TRUE(set.set("selector", "good-features") && set.set("good-features.levels", levels));
    const auto made = pipeline::make_algorithms(set);
    ASSERT_FALSE(made) << levels;
    EXPECT_EQ(made.error().code, Errc::InvalidInput);
  }
  for (const char* levels : {"", "0", "255", "64+", "64,128", "nan"}) {
    AlgorithmSet set;
    ASSERT_TRUE(set.set("selector", "good-features") && set.set("good-features.binary_thresholds", levels));
    EXPECT_FALSE(pipeline::make_algorithms(set)) << levels;
  }
}

// The structure tensor summed pixel by pixel.
TEST(CornerResponse, AgreesWithItsSlowTwin) {
  SelectionFixture fixture;
  const RectifiedPair& pair = SelectionFixture::rendered();
  const Selectable selectable(pair, &fixture.scratch);
  Plane<float> response(&fixture.scratch, pair.width_px, pair.height_px);
  ASSERT_TRUE(
      corner_response(pair.left.grey, selectable, {3, 1}, smaller_eigenvalue, 0, fixture.context, response));
  const auto grey = [&](int x, int y) {
    return static_cast<double>(pair.left.grey[static_cast<std::size_t>(y * pair.width_px + x)]);
  };
  for (int y = 5; y < pair.height_px - 5; y += 13)
    for (int x = 5; x < pair.width_px - 5; x += 11) {
      double xx = 0, xy = 0, yy = 0;
      for (int j = y - 3; j <= y + 3; ++j)
        for (int i = x - 3; i <= x + 3; ++i) {
          double gx = 0, gy = 0;
          for (int k = -1; k <= 1; ++k) {
            gx += (2 - std::abs(k)) * (grey(i + 1, j + k) - grey(i - 1, j + k)) / 8;
            gy += (2 - std::abs(k)) * (grey(i + k, j + 1) - grey(i + k, j - 1)) / 8;
          }
          xx += gx * gx / 49, xy += gx * gy / 49, yy += gy * gy / 49;
        }
      // Eigenvalues by their sum and product.
      const double smaller = (xx + yy - std::sqrt((xx + yy) * (xx + yy) - 4 * (xx * yy - xy * xy))) / 2;
      EXPECT_NEAR(static_cast<double>(response.row(y)[x]), smaller, 1e-3 * (1 + smaller));
    }
}

TEST(CornerResponse, HarrisTellsCornersEdgesAndPlainsApart) {
  EXPECT_GT(harris_measure(10, 0, 10, 0.05F), 0);
  EXPECT_LT(harris_measure(10, 0, 0, 0.05F), 0);
  EXPECT_EQ(harris_measure(0, 0, 0, 0.05F), 0);
  EXPECT_NEAR(harris_measure(5, 5, 5, 0.05F), -5, 1e-4);  // an edge at 45 degrees
}

TEST(Haar, BlobsOfDifferentSizesAreFoundInTheirMiddle) {
  SelectionFixture fixture;
  RectifiedPair pair = fixture.plain(100);
  struct Blob {
    double x, y, sigma, height;
  };
  const Blob blobs[] = {{40, 40, 2.2, 60}, {110.4, 50.3, 3.5, -60}, {60, 110, 5, 80}, {150, 110, 2.5, 50}};
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x)
      for (const Blob& b : blobs)
        pixel(pair, x, y) += static_cast<float>(
            b.height * std::exp(-(std::pow(x - b.x, 2) + std::pow(y - b.y, 2)) / (2 * b.sigma * b.sigma)));
  const auto found =
      fixture.select(make_selector("haar", {{"haar.quality", "0.45"}, {"haar.min_distance_px", "10"}}), pair);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->points.size(), std::size(blobs));
  for (const Blob& b : blobs)
    EXPECT_LT(nearest({static_cast<float>(b.x), static_cast<float>(b.y)}, *found), 1.1F);
}

TEST(Haar, TheIntegralImageAgreesWithItsSlowTwin) {
  SelectionFixture fixture;
  const RectifiedPair& pair = SelectionFixture::rendered();
  const FastHessian fast(pair.left.grey, pair.width_px, pair.height_px, &fixture.scratch);
  const auto box = [&](int x0, int y0, int x1, int y1) {  // both ends included
    double sum = 0;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        sum += static_cast<double>(pair.left.grey[static_cast<std::size_t>(y * pair.width_px + x)]);
    return sum;
  };
  for (const int size : {9, 15, 27, 51}) {
    const int l = size / 3, h = size / 2;
    for (const auto& [x, y] : {std::pair(30, 30), std::pair(97, 81), std::pair(170, 120)}) {
      const double yy = box(x - l + 1, y - h, x + l - 1, y - h + l - 1) -
                        2 * box(x - l + 1, y - h + l, x + l - 1, y - h + 2 * l - 1) +
                        box(x - l + 1, y - h + 2 * l, x + l - 1, y + h);
      const double xx = box(x - h, y - l + 1, x - h + l - 1, y + l - 1) -
                        2 * box(x - h + l, y - l + 1, x - h + 2 * l - 1, y + l - 1) +
                        box(x - h + 2 * l, y - l + 1, x + h, y + l - 1);
      const double xy = box(x - l, y - l, x - 1, y - 1) + box(x + 1, y + 1, x + l, y + l) -
                        box(x + 1, y - l, x + l, y - 1) - box(x - l, y + 1, x - 1, y + l);
      const double expected = (xx * yy - 0.81 * xy * xy) / std::pow(size, 4);
      EXPECT_NEAR(static_cast<double>(fast.determinant(x, y, size)), expected,
                  1e-5 * (1 + std::abs(expected)))
          << size;
    }
  }
}

TEST(WaveletSalient, TheTransformKeepsTheEnergy) {
  SelectionFixture fixture;
  constexpr int kSide = 64;
  std::pmr::vector<float> grey(kSide * kSide);
  std::mt19937 random(4);
  double energy = 0;
  for (float& g : grey) {
    g = static_cast<float>(random() % 256) - 128;
    energy += static_cast<double>(g) * static_cast<double>(g);
  }
  const SalientTracks tracks(grey, kSide, kSide, 6, &fixture.scratch);
  double mean = 0, found = 0;
  for (const float g : grey) mean += static_cast<double>(g) / kSide;
  found = mean * mean;  // the one approximation left at the coarsest scale
  for (int s = 1; s <= 6; ++s)
    for (int o = 0; o < SalientTracks::kOrientations; ++o)
      for (int y = 0; y < tracks.rows(s); ++y)
        for (int x = 0; x < tracks.columns(s); ++x)
          found += std::pow(static_cast<double>(tracks.magnitude(s, o, x, y)), 2);
  EXPECT_NEAR(found / energy, 1, 1e-5);
}

TEST(WaveletSalient, TracksEndWhereThePictureVaries) {
  SelectionFixture fixture;
  RectifiedPair pair = fixture.plain();
  paint_squares(pair);
  pixel(pair, 95, 21) = 200;  // a speck varies at every scale, too
  const auto found = fixture.select(make_selector("wavelet-salient"), pair);
  ASSERT_TRUE(found);
  EXPECT_LT(nearest({95, 21}, *found), 2.3F);
  for (const Keypoint& p : found->points) {
    const int x = static_cast<int>(p.at_px.x), y = static_cast<int>(p.at_px.y);
    float least = 255, most = 0;
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i) {
        least = std::min(least, pixel(pair, x + i, y + j));
        most = std::max(most, pixel(pair, x + i, y + j));
      }
    EXPECT_GT(most - least, 100) << x << " " << y << " lies on a plain";
  }
}

TEST(WaveletSalient, SaliencyIsTheSumAlongTheTrack) {
  SelectionFixture fixture;
  std::pmr::vector<float> grey(64, 10.0F);
  grey[8 * 5 + 2] = 110;  // (2, 5)
  const SalientTracks tracks(grey, 8, 8, 3, &fixture.scratch);
  // One pixel h above the rest has |h| / 2^s in each orientation of scale s.
  for (int o = 0; o < SalientTracks::kOrientations; ++o) {
    EXPECT_FLOAT_EQ(tracks.follow(3, o, 0, 0).strength, 100 / 2.0F + 100 / 4.0F + 100 / 8.0F);
    const Candidate end = tracks.follow(3, o, 0, 0);
    EXPECT_TRUE(end.x / 2 == 1 && end.y / 2 == 2);
  }
}

TEST(Random, EveryPlaceIsEquallyLikelyAndTheSeedDecides) {
  SelectionFixture fixture;
  const auto& pair = SelectionFixture::rendered();
  const auto draw = [&](const char* seed) {
    return fixture.select(make_selector("random", {{"random.max_points", "6400"}, {"random.seed", seed}}),
                          pair);
  };
  const auto one = draw("1"), again = draw("1"), other = draw("2");
  ASSERT_TRUE(one && again && other);
  ASSERT_EQ(one->points.size(), 6400U);
  std::array<double, 16> cells{};
  std::size_t same = 0;
  for (std::size_t k = 0; k < one->points.size(); ++k) {
    const Vec2f at = one->points[k].at_px;
    EXPECT_EQ(at.x, again->points[k].at_px.x);
    same += at.x == other->points[k].at_px.x ? 1 : 0;
    ++cells[static_cast<std::size_t>(at.y / 40) * 4 + static_cast<std::size_t>(at.x / 50)];
  }
  EXPECT_LT(same, 200U);
  double chi = 0;
  for (const double n : cells) chi += (n - 400) * (n - 400) / 400;
  EXPECT_LT(chi, 37.7);  // 15 degrees of freedom: one seed of a thousand would exceed it
}

TEST(GridPoints, EveryStepOfTheRectangleAndNowhereElse) {
  SelectionFixture fixture;
  const auto& pair = SelectionFixture::rendered();  // 200 x 160
  const auto whole = fixture.select(make_selector("grid-points"), pair);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->lattice_step_px, 8);
  EXPECT_EQ(whole->points.size(), 25U * 20U);
  const auto part = fixture.select(make_selector("grid-points", {{"grid-points.step_px", "7"},
                                                                 {"grid-points.left_px", "31"},
                                                                 {"grid-points.top_px", "12"},
                                                                 {"grid-points.width_px", "22"},
                                                                 {"grid-points.height_px", "14"}}),
                                   pair);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->lattice_step_px, 7);
  ASSERT_EQ(part->points.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(part->points[k].at_px.x, 31.0F + 7.0F * static_cast<float>(k % 4));
    EXPECT_EQ(part->points[k].at_px.y, 12.0F + 7.0F * static_cast<float>(k / 4));
  }
  // Down to the view's edge, and what lies beyond it.
  const auto corner = fixture.select(
      make_selector("grid-points", {{"grid-points.left_px", "199"}, {"grid-points.top_px", "150"}}), pair);
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->points.size(), 2U);
  for (const char* option :
       {"grid-points.left_px", "grid-points.top_px", "grid-points.width_px", "grid-points.height_px"}) {
    const auto beyond = fixture.select(make_selector("grid-points", {{option, "201"}}), pair);
    ASSERT_FALSE(beyond) << option;
    EXPECT_EQ(beyond.error().code, Errc::InvalidInput);
    EXPECT_EQ(beyond.error().where(), "grid-points (200 x 160)");
  }
}

TEST(GridPoints, ARectangleBesideTheFaceSaysSo) {
  SelectionFixture fixture;
  RectifiedPair pair(&fixture.output);
  pair = SelectionFixture::rendered();
  pair.region.assign(pair.left.grey.size(), 0);
  for (std::size_t k = 0; k < 200U * 40U; ++k) pair.region[k] = 1;  // its upper quarter
  const auto beside = fixture.select(make_selector("grid-points", {{"grid-points.top_px", "40"}}), pair);
  ASSERT_FALSE(beside);
  EXPECT_EQ(beside.error().code, Errc::NoFace);
  EXPECT_NE(beside.error().what.view().find("rectangle"), std::string_view::npos);
  const auto across = fixture.select(
      make_selector("grid-points", {{"grid-points.top_px", "32"}, {"grid-points.height_px", "80"}}), pair);
  ASSERT_TRUE(across);
  EXPECT_EQ(across->points.size(), 25U);
}

TEST(Pipeline, AScatteredSelectorWithAMesherForLatticesIsRefusedAtOnce) {
  const StereoCalibration calibration = test::true_calibration(hal::sim::make_rig({}));
  for (const std::string& name : test::names_of("selector")) {
    AlgorithmSet set;
    ASSERT_TRUE(set.set("selector", name) && set.set("mesher", "grid"));
    const auto made = Pipeline::make(set, calibration, {}, Region::All);
    if (check_neighbours(set)) {  // a lattice
      EXPECT_TRUE(made);
      continue;
    }
    ASSERT_FALSE(made) << name;
    EXPECT_EQ(made.error().code, Errc::InvalidInput);
    EXPECT_NE(made.error().where().find(name), std::string_view::npos);
    ASSERT_TRUE(set.set("mesher", "delaunay"));
    EXPECT_TRUE(Pipeline::make(set, calibration, {}, Region::All)) << name;
  }
}

}  // namespace
}  // namespace relievo::pipeline
