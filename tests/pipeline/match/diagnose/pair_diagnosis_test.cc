// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulated face, photographed well and then spoilt in every way in which a cable, a hand or a lamp may.
#include "pipeline/match/diagnose/pair_diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <vector>

#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/render.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

constexpr int kPairWidth = 640;
constexpr int kPairHeight = 400;

using Pixels = std::vector<std::uint8_t>;

Pixels pixels(const hal::Picture& picture) {
  const ImageView view = picture.view();
  Pixels rgb;
  for (int y = 0; y < view.height_px; ++y)
    rgb.insert(rgb.end(), view.row(y), view.row(y) + 3 * view.width_px);
  return rgb;
}

ImageView view_of(const Pixels& rgb) {
  return {reinterpret_cast<const std::byte*>(rgb.data()), kPairWidth, kPairHeight, kPairWidth * 3,
          PixelFormat::Rgb8};
}

Pixels brighter(Pixels picture, double factor) {
  for (std::uint8_t& v : picture) v = static_cast<std::uint8_t>(std::clamp(v * factor, 0.0, 255.0));
  return picture;
}

// Far too bright about the middle and dark beyond, as a lit face before a wall is.
Pixels face_too_bright(const Pixels& picture) {
  Pixels made = brighter(picture, 8);
  for (int y = 0; y < kPairHeight; ++y)
    for (int x = 0; x < kPairWidth; ++x)
      if (std::hypot(x - kPairWidth / 2, y - kPairHeight / 2) > 110)
        std::fill_n(made.begin() + 3 * (y * kPairWidth + x), 3, std::uint8_t{40});
  return made;
}

// So many rows up, black below.
Pixels lifted(Pixels picture, int rows) {
  const auto by = static_cast<std::size_t>(rows) * kPairWidth * 3;
  std::copy(picture.begin() + static_cast<std::ptrdiff_t>(by), picture.end(), picture.begin());
  std::fill(picture.end() - static_cast<std::ptrdiff_t>(by), picture.end(), std::uint8_t{0});
  return picture;
}

// One test: photographing the head takes longest.
TEST(PairDiagnosis, TellsWhatWasDoneToThePictures) {
  hal::sim::RigOptions options;
  options.width_px = kPairWidth;
  options.height_px = kPairHeight;
  const hal::sim::SimRig rig = hal::sim::make_rig(options);
  ThreadPool pool(2);
  const auto scene = hal::sim::make_head_scene(hal::sim::make_head(hal::sim::traits_of(3), pool), {}, pool);
  const hal::sim::PicturePair shot = hal::sim::render_pair(*scene, rig, {}, 1, pool);
  const Pixels left = pixels(shot.left), right = pixels(shot.right);
  const Pixels grey(left.size(), 128);
  const struct {
    const char* what;
    Pixels left, right;
    std::optional<PairFault> fault;
  } kRows[] = {{"nothing", left, right, std::nullopt},
               {"unequal exposures are no fault", left, brighter(right, 0.4), std::nullopt},
               {"the right lens covered", left, brighter(right, 0.03), PairFault::RightDark},
               {"the left lens covered", brighter(left, 0.03), right, PairFault::LeftDark},
               {"both covered", brighter(left, 0.03), brighter(right, 0.03), PairFault::BothDark},
               {"a lamp in the left", brighter(left, 8), right, PairFault::LeftOverexposed},
               {"a lamp in both", brighter(left, 8), brighter(right, 8), PairFault::BothOverexposed},
               {"a lamp on the face, seen by the right one", left, face_too_bright(right),
                PairFault::RightOverexposed},
               {"one grey", left, grey, PairFault::RightBlank},
               {"the same twice", left, left, PairFault::SamePicture},
               {"one higher", left, lifted(right, 24), PairFault::Shifted}};
  for (const auto& row : kRows) {
    test::StageFixture fixture{std::size_t{64} << 20, std::size_t{64} << 20};
    const auto fault = diagnose_pair({view_of(row.left), view_of(row.right)}, test::true_calibration(rig), {},
                                     fixture.context);
    EXPECT_EQ(fault, row.fault) << row.what;
    EXPECT_TRUE(!fault || !error_of(*fault).what.view().empty());
    EXPECT_EQ(fixture.output.used(), 0U);
  }
  test::StageFixture tiny{1024, 1024};
  EXPECT_THROW(static_cast<void>(diagnose_pair({view_of(left), view_of(right)}, test::true_calibration(rig),
                                               {}, tiny.context)),
               std::bad_alloc);
}

}  // namespace
}  // namespace relievo::pipeline
