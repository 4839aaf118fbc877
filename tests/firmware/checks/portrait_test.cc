// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cameras turned to portrait, through the whole chain: boards, calibration, a face, and its truth.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "firmware/checks/optical_check.h"
#include "firmware/measure/measurement.h"
#include "firmware/reconstruct/reconstruction.h"
#include "hal/picture_file.h"
#include "hal/sim/render.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/firmware/checks/target_rig.h"
#include "tests/support/lying_sensor.h"
#include "tests/support/proof.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

// Pictures of 600 x 960: half of what the cameras give, and a shorter lens than the landscape rig's.
hal::sim::RigOptions portrait() {
  hal::sim::RigOptions rig;
  rig.width_px = 1200;
  rig.height_px = 1920;
  rig.focal_px = 2320;
  return rig;
}

ReconstructArgs pair_in(const Path& folder, const std::string& prefix, const char* calibration) {
  ReconstructArgs args;
  args.pictures = {folder / (prefix + "left.png"), folder / (prefix + "right.png")};
  args.calibrations = {folder / calibration};
  return args;
}

TEST(Portrait, TheRigSeesHigherThanWide) {
  const hal::sim::SimRig rig = hal::sim::make_rig(portrait());
  for (const hal::sim::SimView* view : {&rig.left, &rig.right}) {
    EXPECT_EQ(view->width_px, 1200);
    EXPECT_EQ(view->height_px, 1920);
    EXPECT_NEAR(view->fx_px, 2320, 40);
    EXPECT_NEAR(view->cx_px, 599.5, 25);
    EXPECT_NEAR(view->cy_px, 959.5, 25);
  }
}

TEST(Portrait, CalibratesReconstructsAndIsTrue) {
  const test::TemporaryFolder folder;
  TargetRig rig;
  rig.rig = portrait();
  TargetShot series;
  series.scale = kHalfScale;
  series.targets.board_columns = 7;  // the board turned as the picture is
  series.targets.board_rows = 10;
  const std::atomic<bool> never{false};
  const auto made = calibrate_on_boards(rig, series, 8, never, [] {});
  ASSERT_TRUE(made) << made.error().what.view();
  EXPECT_EQ(made->calibration.left.width_px, 600);
  EXPECT_EQ(made->calibration.left.height_px, 960);
  const hal::sim::SimRig truth = hal::sim::make_rig(rig.options(series).rig);
  EXPECT_NEAR(made->quality.baseline_mm, length(truth.right.centre()), 0.3);
  EXPECT_NEAR(made->calibration.left.focal_px.x / truth.left.fx_px, 1, 0.002);
  ASSERT_TRUE(pipeline::write_calibration(folder.path() / "rig_calibrated.yml", made->calibration));

  hal::sim::SimulationOptions face;
  face.rig = rig.options(series).rig;
  face.truth = true;
  face.seed = 2;
  ASSERT_TRUE(hal::sim::render_to_folder(face, folder.path()));
  Reconstruction reconstruction;
  Console console;
  const auto done = reconstruction.run(pair_in(folder.path(), "", "rig_calibrated.yml"), console);
  ASSERT_TRUE(done) << done.error().what.view();
  const auto view = measure::TruthView::read(folder.path());
  const auto surface = measure::read_true_surface(folder.path() / "head.ply");
  ASSERT_TRUE(view && surface);
  const measure::Measurement m = measure::measure(reconstruction.model().mesh, *view, *surface);
  // Half-size pictures through a short lens: a pixel of disparity is 1.9 mm of depth.
  EXPECT_LT(m.interior_median_mm, 0.3);
  EXPECT_GT(m.complete_1mm, 0.85);
  EXPECT_LT(m.outliers_3mm, 0.03);
  const pipeline::ModelQuality& q = reconstruction.report().quality;
  EXPECT_GT(q.height_mm, 1.1 * q.width_mm);  // a face stands upright in its frame
  EXPECT_GT(q.nose_relief_mm, 10);
  std::printf(
      "portrait: interior median %.3f mm, p95 %.3f mm, complete at 0.5 and 1 mm %.3f %.3f, outliers %.4f, "
      "%.0f x %.0f mm\n",
      m.interior_median_mm, m.accuracy_p95_mm, m.complete_half_mm, m.complete_1mm, m.outliers_3mm, q.width_mm,
      q.height_mm);
}

// Pictures that nobody turns back give the same face, upright in its own frame.
TEST(Portrait, LyingSensorsGiveTheSameFace) {
  RELIEVO_MANY_TRIALS();
  const test::TemporaryFolder folder;
  hal::sim::SimulationOptions face;
  face.rig = portrait();
  face.rig.width_px = 480;
  face.rig.height_px = 768;
  face.seed = 3;
  ASSERT_TRUE(hal::sim::render_to_folder(face, folder.path()));
  const auto calibration = pipeline::read_calibration(folder.path() / "rig.yml");
  ASSERT_TRUE(calibration);
  Reconstruction upright;
  Console console;
  ASSERT_TRUE(upright.run(pair_in(folder.path(), "", "rig.yml"), console));
  for (const test::Side side : {test::Side::Clockwise, test::Side::Counterclockwise}) {
    for (const char* eye : {"left", "right"}) {
      const auto picture = hal::read_picture(folder.path() / (std::string(eye) + ".png"));
      ASSERT_TRUE(picture);
      ASSERT_TRUE(hal::write_picture(folder.path() / (std::string("lying_") + eye + ".png"),
                                     test::laid(picture->view(), side).view()));
    }
    ASSERT_TRUE(pipeline::write_calibration(folder.path() / "lying.yml", test::laid(*calibration, side)));
    Reconstruction lying;
    const auto done = lying.run(pair_in(folder.path(), "lying_", "lying.yml"), console);
    ASSERT_TRUE(done) << done.error().what.view();
    const pipeline::ModelQuality& expected = upright.report().quality;
    // The outline is known to a part of the lattice's cells, 2 mm wide on pictures this small, and below to
    // where skin was last seen of a chin: at this size the last two or three cells are hardly sure enough.
    EXPECT_NEAR(lying.report().quality.width_mm, expected.width_mm, 1.5);
    EXPECT_NEAR(lying.report().quality.height_mm, expected.height_mm, 6);
    EXPECT_NEAR(lying.report().quality.nose_relief_mm, expected.nose_relief_mm, 0.8)
        << "less than half a cell";
    // The same place in the room, the same place on the head: as well as frames of one head may differ at
    // full size.
    const pipeline::Rotation turn = test::lying_from_upright(side);
    for (const pipeline::Vec3d at : {pipeline::Vec3d{0, 0, 560}, {60, 0, 560}, {0, 80, 580}}) {
      const pipeline::Vec3d a = apply(upright.model().head_from_camera, at);
      const pipeline::Vec3d b = apply(lying.model().head_from_camera, apply(turn, at));
      EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0.7);
    }
  }
}

}  // namespace
}  // namespace relievo::firmware
