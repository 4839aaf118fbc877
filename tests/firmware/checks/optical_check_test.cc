// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The optical self-test must pass a good rig and find a bad calibration: half-size pictures, the whole
// chain, faults put in by hand.
#include "firmware/checks/optical_check.h"

#include <gtest/gtest.h>

#include "hal/sim/optics/rig.h"
#include "pipeline/model/vector3.h"
#include "tests/firmware/checks/target_rig.h"
#include "tests/support/proof.h"

namespace relievo::firmware {
namespace {

// Boards are photographed once for all tests here.
const pipeline::StereoCalibration& calibrated() {
  static const pipeline::StereoCalibration calibration = [] {
    TargetShot series;
    series.scale = kHalfScale;
    const std::atomic<bool> never{false};
    auto made = calibrate_on_boards(TargetRig{}, series, 8, never, [] {});
    EXPECT_TRUE(made);
    return made ? made->calibration : pipeline::StereoCalibration{};
  }();
  return calibration;
}

OpticalCheckOptions few() {
  OpticalCheckOptions o;
  o.scale = kHalfScale;
  o.dumbbells = {dumbbell_places()[0], dumbbell_places()[4]};
  o.plates = {plate_places()[3]};
  return o;
}

Result<AcceptanceReport> measured(const pipeline::StereoCalibration& calibration,
                                  const OpticalCheckOptions& options, const TargetRig& rig = {}) {
  const std::atomic<bool> never{false};
  return measure_targets(calibration, rig, options, never, [] {});
}

const AcceptanceLine& line_of(const std::vector<AcceptanceLine>& lines, const std::string& name) {
  return *std::find_if(lines.begin(), lines.end(),
                       [&](const AcceptanceLine& l) { return l.measure == name; });
}

TEST(OpticalCheck, AGoodRigHoldsEveryLimitAndFindsTheCentres) {
  OpticalCheckOptions options = few();
  std::vector<std::string> names;
  options.show = [&](const std::string& name, const hal::Picture& picture) -> Result<void> {
    names.push_back(name);
    EXPECT_GT(picture.width_px, 150);
    EXPECT_EQ(picture.bytes.size(), static_cast<std::size_t>(3 * picture.width_px * picture.height_px));
    return {};
  };
  const auto report = measured(calibrated(), options);
  ASSERT_TRUE(report) << report.error().where() << ": " << report.error().what.view();
  for (const AcceptanceLine& line : report->lines(limits_at(kHalfScale)))
    EXPECT_TRUE(line.held()) << line.measure << " " << line.value_mm << " mm, limit " << line.limit_mm
                             << " at " << line.where;
  EXPECT_TRUE(report->verdict(limits_at(kHalfScale)));
  ASSERT_EQ(report->targets.size(), 5U);
  ASSERT_EQ(report->spacings.size(), 2U);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto truth = left_from_target(few().dumbbells[k / 2], {k % 2 == 0 ? -60.0 : 60.0, 0, 0});
    EXPECT_LT(pipeline::distance(report->targets[k].centre_mm, truth), 1.0) << report->targets[k].name;
    EXPECT_GT(report->targets[k].used, 2000U);
    EXPECT_LE(static_cast<double>(report->targets[k].discarded),
              kDiscardShare * static_cast<double>(report->targets[k].used + report->targets[k].discarded));
    EXPECT_LT(report->targets[k].used, report->targets[k].measured);
  }
  EXPECT_GT(report->targets[4].used, 20000U);
  EXPECT_EQ(names, (std::vector<std::string>{"dumbbell 1 a", "dumbbell 1 b", "dumbbell 2 a", "dumbbell 2 b",
                                             "plate 1"}));
}

TEST(OpticalCheck, ABaselineWrongByOnePercentFailsTheSphereSpacing) {
  RELIEVO_MANY_TRIALS();
  pipeline::StereoCalibration wrong = calibrated();
  wrong.right_from_left.translation_mm.x *= 1.01;
  wrong.right_from_left.translation_mm.y *= 1.01;
  wrong.right_from_left.translation_mm.z *= 1.01;
  OpticalCheckOptions options = few();
  options.plates.clear();
  const auto report = measured(wrong, options);
  ASSERT_TRUE(report);
  const auto lines = report->lines(limits_at(kHalfScale));
  EXPECT_FALSE(line_of(lines, "sphere spacing").held());
  EXPECT_NEAR(line_of(lines, "sphere spacing").value_mm, 1.2, 0.2);  // one percent of 120 mm
  EXPECT_FALSE(report->verdict(limits_at(kHalfScale)));
}

TEST(OpticalCheck, ALensTermOfTheWrongSignFailsTheFlatness) {
  RELIEVO_MANY_TRIALS();
  pipeline::StereoCalibration wrong = calibrated();
  wrong.right.distortion[0] = -wrong.right.distortion[0];
  OpticalCheckOptions options = few();
  options.dumbbells.clear();
  const auto report = measured(wrong, options);
  ASSERT_TRUE(report);
  const auto lines = report->lines(limits_at(kHalfScale));
  EXPECT_FALSE(line_of(lines, "flatness").held()) << line_of(lines, "flatness").value_mm;
}

TEST(OpticalCheck, SpheresThatAreNotAsCertifiedFailSizeAndSpacing) {
  RELIEVO_MANY_TRIALS();
  TargetRig rig;
  rig.true_targets.emplace();
  rig.true_targets->sphere_diameter_mm = 61;
  rig.true_targets->sphere_spacing_mm = 121;
  OpticalCheckOptions options = few();
  options.dumbbells.resize(1);
  options.plates.clear();
  const auto report = measured(calibrated(), options, rig);
  ASSERT_TRUE(report);
  const auto lines = report->lines(limits_at(kHalfScale));
  EXPECT_NEAR(line_of(lines, "probing error, size").value_mm, 1, 0.3);
  EXPECT_NEAR(line_of(lines, "sphere spacing").value_mm, 1, 0.2);
  EXPECT_FALSE(line_of(lines, "probing error, size").held());
  EXPECT_FALSE(line_of(lines, "sphere spacing").held());
}

TEST(OpticalCheck, ATargetThatCannotBeMeasuredIsNamed) {
  OpticalCheckOptions options = few();
  const auto cut = measured(calibrated(), options, [] {
    TargetRig rig;
    rig.true_targets.emplace();
    rig.true_targets->sphere_spacing_mm = 400;
    return rig;
  }());
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, Errc::PoorGeometry);
  // A speckle as good as blank: nothing to match, and the error says where.
  const std::atomic<bool> never{false};
  const auto blank = measure_targets(
      calibrated(),
      [](const TargetShot& shot) {
        auto pictures = TargetRig{}(shot);
        if (pictures)
          for (hal::Picture* p : {&pictures->left, &pictures->right})
            std::fill(p->bytes.begin(), p->bytes.end(), std::byte{90});
        return pictures;
      },
      options, never, [] {});
  ASSERT_FALSE(blank);
  EXPECT_EQ(blank.error().where(), "dumbbell 1 a");
}

TEST(OpticalCheck, StopsWhenCancelled) {
  const std::atomic<bool> yes{true};
  EXPECT_EQ(measure_targets(calibrated(), TargetRig{}, few(), yes, [] {}).error().code, Errc::Cancelled);
  EXPECT_EQ(calibrate_on_boards(TargetRig{}, {}, 3, yes, [] {}).error().code, Errc::Cancelled);
}

}  // namespace
}  // namespace relievo::firmware
