// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is a camera that moved noticed in one capture, and one that did not left in peace? Simulated people
// stand before simulated rigs, turned, near and far, with unequal exposure, focus and noise; the rigs
// are calibrated by the product from boards they photograph themselves, with new noise each time. Then
// the right camera is turned by what makes 0.2 px across the rows of the pictures used: nodded, or
// rolled so that the shift is 0.2 px rms over the face. Pans are shown for what they are: invisible.
// Exit code 1 when less than 99 % are noticed or more than 1 % are alarms for nothing.
//   drift_proof [SCALE [PEOPLE [CAPTURES [FIRST_RIG]]]]   default 0.5 60 2 1: half-size pictures, 120
//   captures; another FIRST_RIG means other rigs and other people
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "hal/base/statistics.h"
#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/render.h"
#include "pipeline/calibrate/calibrator.h"
#include "pipeline/calibrate/drift.h"
#include "pipeline/pipeline.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/stage_fixture.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: one file of a proof
namespace sim = hal::sim;

constexpr double kShiftPx = 0.2;
constexpr int kRigs = 4;
constexpr int kCalibrations = 8;  // of each rig
constexpr int kBoards = 30;       // photographed, of which each calibration takes kTaken
constexpr std::size_t kTaken = 14;

struct Tally {
  const char* name;
  bool should_notice;
  int cases = 0, noticed = 0, failed = 0;
  std::vector<double> statistics{}, residuals{};
  std::string wrong{};  // who was judged wrongly, for a closer look

  void add(const DriftJudgement& j, std::uint32_t who) {
    ++cases;
    const bool notice = j.verdict == DriftVerdict::Warn || j.verdict == DriftVerdict::Refuse;
    noticed += notice ? 1 : 0;
    if (notice != should_notice) wrong += " " + std::to_string(who);
    statistics.push_back(j.statistic);
    residuals.push_back(j.residual_px);
  }
  double share() const { return cases > 0 ? static_cast<double>(noticed) / cases : 0; }
  static double quantile(std::vector<double> of, double q) { return of.empty() ? 0 : percentile(of, q); }
};

class Proof {
 public:
  explicit Proof(double scale) : scale_(scale) {}

  // One rig, its calibrations, and the people before it.
  void run_rig(std::uint32_t seed, int people, int captures) {
    sim::RigOptions options;
    options.seed = seed;
    options.width_px = static_cast<int>(options.width_px * scale_);
    options.height_px = static_cast<int>(options.height_px * scale_);
    const sim::SimRig rig = sim::make_rig(options);
    const std::vector<StereoCalibration> calibrations = calibrate_often(rig, seed);
    for (int person = 0; person < people; ++person) {
      const std::uint32_t who = seed * 1000 + static_cast<std::uint32_t>(person);
      photograph(rig, who, captures, calibrations);
      std::printf("rig %u, person %d of %d\r", seed, person + 1, people);
      std::fflush(stdout);
    }
  }

  bool report() const {
    std::printf("%-34s %7s %9s %10s %10s %10s %11s\n", "the right camera", "cases", "noticed", "median T",
                "least T", "most T", "median px");
    bool good = true;
    for (const Tally* t : {&still_, &nodded_, &rolled_, &panned_, &knocked_}) {
      std::printf("%-34s %7d %9d %10.2f %10.2f %10.2f %11.3f%s%s\n", t->name, t->cases, t->noticed,
                  Tally::quantile(t->statistics, 0.5), Tally::quantile(t->statistics, 0),
                  Tally::quantile(t->statistics, 1), Tally::quantile(t->residuals, 0.5),
                  t->wrong.empty() ? "" : "  wrong:", t->wrong.c_str());
      if (t != &panned_)
        good = good && t->cases > 0 && (t->should_notice ? t->share() >= 0.99 : t->share() <= 0.01);
    }
    std::printf(
        "promised: median %.4f px, most %.4f px; uncertainty of one face: median %.4f px, most %.4f px; not judged: %d\n",
        Tally::quantile(promises_, 0.5), Tally::quantile(promises_, 1), Tally::quantile(sigmas_, 0.5),
        Tally::quantile(sigmas_, 1), failed_);
    return good;
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  // The same boards with new noise, another choice of them every time.
  std::vector<StereoCalibration> calibrate_often(const sim::SimRig& rig, std::uint32_t seed) {
    const sim::BoardPattern printed;
    const auto poses = sim::good_board_poses(rig, printed, kBoards, seed);
    std::vector<std::array<sim::LightPicture, 2>> light;
    sim::SensorOptions sensor;
    sensor.grey = true;
    for (const sim::BodyPose& pose : *poses) {
      const sim::BoardScene scene(printed, pose, {}, 1 / rig.left.fx_px);
      light.push_back({sim::expose(scene, rig.left, sensor, bench_.pool),
                       sim::expose(scene, rig.right, sensor, bench_.pool)});
    }
    std::vector<StereoCalibration> calibrations;
    for (int round = 0; round < kCalibrations; ++round) {
      std::shuffle(light.begin(), light.end(), random_);
      CalibratorInput input;
      input.pattern = {printed.corners_x, printed.corners_y, printed.square_mm};
      input.width_px = rig.left.width_px;
      input.height_px = rig.left.height_px;
      for (std::size_t k = 0; k < kTaken; ++k) {
        BoardView& view = input.views.emplace_back();
        const auto left = find_board(sim::read_sensor(light[k][0], sensor, random_()).view(), input.pattern);
        const auto right = find_board(sim::read_sensor(light[k][1], sensor, random_()).view(), input.pattern);
        if (left) view.left = *left;
        if (right) view.right = *right;
      }
      const auto made = calibrate(input);
      if (!made || made->quality.verdict == CalibrationVerdict::Refuse) continue;
      calibrations.push_back(made->calibration);
      promises_.push_back(made->calibration.epipolar_shift_px);
    }
    return calibrations;
  }

  void photograph(const sim::SimRig& rig, std::uint32_t who, int captures,
                  const std::vector<StereoCalibration>& calibrations) {
    who_ = who;
    const sim::HeadPose pose{uniform(-20, 20),  uniform(-10, 10), uniform(-8, 8),
                             uniform(510, 620), uniform(-15, 15), uniform(-15, 15)};
    const auto scene =
        sim::make_head_scene(sim::make_head(sim::traits_of(who), bench_.pool), pose, bench_.pool);
    sim::SensorOptions left, right;
    left.defocus_px *= uniform(0.8, 1.3);
    right.defocus_px *= uniform(0.8, 1.3);
    const sim::LightPicture left_light = sim::expose(*scene, rig.left, left, bench_.pool);
    const sim::LightPicture right_light = sim::expose(*scene, rig.right, right, bench_.pool);
    for (int k = 0; k < captures; ++k) {
      left.exposure = uniform(0.8, 1.15);
      right.exposure = left.exposure * uniform(0.85, 1.18);
      left.noise = right.noise = uniform(0.8, 1.6);
      const hal::Picture l = sim::read_sensor(left_light, left, random_());
      const hal::Picture r = sim::read_sensor(right_light, right, random_());
      const StereoFrame frame{l.view(), r.view(), 0, 0};
      judge_all(
          frame,
          calibrations[static_cast<std::size_t>(uniform(0, static_cast<double>(calibrations.size()) - 1e-9))],
          k);
    }
  }

  void judge_all(const StereoFrame& frame, const StereoCalibration& calibration, int k) {
    RectifiedPair pair(std::pmr::new_delete_resource());
    EpipolarShift face;
    if (!judge(frame, calibration, still_, &face, &pair)) return;
    const double focal = calibration.right.focal_px.y;
    const double way = k % 2 == 0 ? 1 : -1;
    judge(frame, test::turned(calibration, way * kShiftPx / focal, 0, 0), nodded_);
    // Where the right camera's optical axis stands in its window: there a roll moves nothing.
    const Vec3d axis = apply(pair.rectified_from_right, {0, 0, 1});
    const double middle = pair.right_centre_px.x + pair.focal_px * axis.x / axis.z;
    judge(frame,
          test::turned(calibration, 0, 0,
                       way * kShiftPx / std::hypot(face.spread_x_px, face.middle_x_px - middle)),
          rolled_);
    if (k > 0) return;
    judge(frame, test::turned(calibration, 0, kShiftPx / focal, 0), panned_);
    judge(frame, test::turned(calibration, 2 / focal, 0, 0), knocked_);
  }

  bool judge(const StereoFrame& frame, const StereoCalibration& calibration, Tally& tally,
             EpipolarShift* face = nullptr, RectifiedPair* seen = nullptr) {
    bench_.output.reset();
    const auto pipeline = Pipeline::make({}, calibration);
    auto pair = pipeline->rectify(frame, bench_.context);
    if (!pair) return ++failed_, false;
    const auto matches = pipeline->match(*pair, bench_.context);
    if (!matches) return ++failed_, false;
    const DriftJudgement judgement = judge_drift(matches->epipolar_shift, calibration);
    tally.add(judgement, who_);
    if (face != nullptr) {
      *face = matches->epipolar_shift;
      sigmas_.push_back(face->sigma_px);
      seen->rectified_from_right = pair->rectified_from_right;
      seen->right_centre_px = pair->right_centre_px;
      seen->focal_px = pair->focal_px;
    }
    return true;
  }

  double scale_;
  test::StageFixture bench_{std::size_t{640} << 20, std::size_t{768} << 20,
                            static_cast<int>(std::thread::hardware_concurrency())};
  std::mt19937 random_{7};
  std::uint32_t who_ = 0;
  std::vector<double> promises_, sigmas_;
  int failed_ = 0;
  Tally still_{"stands where it was calibrated", false};
  Tally nodded_{"nodded by 0.2 px", true};
  Tally rolled_{"rolled by 0.2 px rms", true};
  Tally panned_{"panned by 0.2 px (along the rows)", false};
  Tally knocked_{"nodded by 2 px", true};
};

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) {
  const double scale = argc > 1 ? std::atof(argv[1]) : 0.5;
  const int people = argc > 2 ? std::atoi(argv[2]) : 60;
  const int captures = argc > 3 ? std::atoi(argv[3]) : 2;
  const int first = argc > 4 ? std::atoi(argv[4]) : 1;
  relievo::bench::Proof proof(scale);
  for (int rig = 0; rig < relievo::bench::kRigs; ++rig)
    proof.run_rig(static_cast<std::uint32_t>(first + rig),
                  (people + relievo::bench::kRigs - 1 - rig) / relievo::bench::kRigs, captures);
  std::printf("pictures %.2f times the usual size, %d people before %d rigs, %d captures each\n", scale,
              people, relievo::bench::kRigs, captures);
  return proof.report() ? 0 : 1;
}
