// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulated face, photographed well and then spoilt in every way in which a cable, a hand or a lamp may.
#include "pipeline/match/diagnose/pair_diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hal/sim/head/head_traits.h"
#include "hal/sim/render.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/stage_bench.h"

namespace relievo::pipeline {
namespace {

class PairDiagnosis : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    hal::sim::RigOptions options;
    options.width_px = 640;
    options.height_px = 400;
    rig = new hal::sim::SimRig(hal::sim::make_rig(options));
    ThreadPool pool(2);
    const auto scene = hal::sim::make_head_scene(hal::sim::make_head(hal::sim::traits_of(3), pool), {}, pool);
    shot = new hal::sim::PicturePair(hal::sim::render_pair(*scene, *rig, {}, 1, pool));
  }
  static void TearDownTestSuite() {
    delete shot;
    delete rig;
  }

  using Pixels = std::vector<std::uint8_t>;
  static Pixels pixels(const hal::Picture& picture) {
    const ImageView view = picture.view();
    Pixels rgb;
    for (int y = 0; y < view.height_px; ++y) rgb.insert(rgb.end(), view.row(y), view.row(y) + 3 * view.width_px);
    return rgb;
  }
  Pixels left = pixels(shot->left), right = pixels(shot->right);

  static void multiply(Pixels& picture, double factor) {
    for (std::uint8_t& v : picture) v = static_cast<std::uint8_t>(std::clamp(v * factor, 0.0, 255.0));
  }
  // Rows up, black below.
  static void lift(Pixels& picture, int rows) {
    const auto by = static_cast<std::size_t>(rows) * 640 * 3;
    std::copy(picture.begin() + static_cast<std::ptrdiff_t>(by), picture.end(), picture.begin());
    std::fill(picture.end() - static_cast<std::ptrdiff_t>(by), picture.end(), std::uint8_t{0});
  }

  std::optional<PairFault> diagnose() {
    const auto view = [](const Pixels& rgb) {
      return ImageView{reinterpret_cast<const std::byte*>(rgb.data()), 640, 400, 640 * 3, PixelFormat::Rgb8};
    };
    relievo::test::StageBench bench{std::size_t{64} << 20, std::size_t{64} << 20};
    const auto fault = diagnose_pair({view(left), view(right)}, relievo::test::true_calibration(*rig), {}, bench.context);
    EXPECT_EQ(bench.output.used(), 0U);
    EXPECT_TRUE(!fault || !error_of(*fault).what.view().empty());
    return fault;
  }

  static hal::sim::SimRig* rig;
  static hal::sim::PicturePair* shot;
};
hal::sim::SimRig* PairDiagnosis::rig = nullptr;
hal::sim::PicturePair* PairDiagnosis::shot = nullptr;

TEST_F(PairDiagnosis, GoodPicturesHaveNothing) { EXPECT_FALSE(diagnose()); }

TEST_F(PairDiagnosis, UnequalExposuresAreNoFault) {
  multiply(right, 0.4);
  EXPECT_FALSE(diagnose());
}

TEST_F(PairDiagnosis, ALensIsCovered) {
  multiply(right, 0.03);
  EXPECT_EQ(diagnose(), PairFault::RightDark);
  multiply(left, 0.03);
  EXPECT_EQ(diagnose(), PairFault::BothDark);
  right = pixels(shot->right);
  EXPECT_EQ(diagnose(), PairFault::LeftDark);
}

TEST_F(PairDiagnosis, TooMuchLight) {
  multiply(left, 8);
  EXPECT_EQ(diagnose(), PairFault::LeftOverexposed);
  multiply(right, 8);
  EXPECT_EQ(diagnose(), PairFault::BothOverexposed);
}

TEST_F(PairDiagnosis, OneGreyAllOver) {
  std::fill(right.begin(), right.end(), std::uint8_t{128});
  EXPECT_EQ(diagnose(), PairFault::RightBlank);
}

TEST_F(PairDiagnosis, TheSamePictureTwice) {
  right = left;
  EXPECT_EQ(diagnose(), PairFault::SamePicture);
}

TEST_F(PairDiagnosis, OneHigherThanTheOther) {
  lift(right, 24);
  EXPECT_EQ(diagnose(), PairFault::Shifted);
}

TEST_F(PairDiagnosis, WithoutMemoryItGivesUpLoudly) {
  relievo::test::StageBench bench{1024, 1024};
  const ImageView view{reinterpret_cast<const std::byte*>(left.data()), 640, 400, 640 * 3, PixelFormat::Rgb8};
  const ImageView other{reinterpret_cast<const std::byte*>(right.data()), 640, 400, 640 * 3, PixelFormat::Rgb8};
  EXPECT_THROW(static_cast<void>(diagnose_pair({view, other}, relievo::test::true_calibration(*rig), {}, bench.context)), std::bad_alloc);
}

}  // namespace
}  // namespace relievo::pipeline
