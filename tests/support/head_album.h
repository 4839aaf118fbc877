// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulated people photographed once and used many times: the light that fell on both sensors, kept, from
// which pictures of any exposure, blur and noise are developed in milliseconds. Rig: the simulated one at a
// quarter of its size (480 x 300). Thread: one caller. Errors: end the program with one line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "hal/base/thread_pool.h"
#include "hal/sim/head/head_scene.h"
#include "hal/sim/render.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/relief.h"
#include "tests/support/glasses_scene.h"
#include "tests/support/pasted_head.h"

namespace relievo::test {

// Something before or beside the person.
// A friend looks in from the side where there is more room; a twin does the same and needs no second head to
// be built. A bag is held up on that side, level with the face. Pictures hang on a wall a foot behind the
// head.
enum class Extra : std::uint8_t { None, HandBefore, Friend, HandOnCheek, Twin, BagBeside, WallBehind };

// What the person does with the face, and wears on it.
struct Guise {
  hal::sim::Expression expression;
  bool wears_glasses = false;
  hal::sim::Glasses glasses;
  double shine = 1;  // how oily the skin is, of what the person's own is
};

struct Shot {
  std::uint32_t seed = 0;
  hal::sim::HeadPose pose;
  Extra extra = Extra::None;
  Guise guise;
  std::vector<std::uint16_t> left,
      right;  // linear light, kLightUnit a unit; empty room where pose.distance_mm is 0
};
inline constexpr double kLightUnit = 16384;

// How a shot is developed.
struct Developing {
  double exposure = 1;
  double defocus_px = 0;  // deviation of a blur, on top of the lens's own
  double motion_px = 0;   // length of a smear along the rows
  double one_sided = 1;   // light on the picture's right side of the face, share of the left side's
  std::uint64_t noise_seed = 1;
};

class Album {
 public:
  explicit Album(std::filesystem::path cache = {});  // a folder where shots survive the program; empty: none
  const Shot& shoot(std::uint32_t seed, const hal::sim::HeadPose& pose, Extra extra = Extra::None,
                    const Guise& guise = {});
  // Of a head that moves, perhaps before a twin: quickly (pasted_head.h), and not kept.
  Shot photograph(std::uint32_t seed, const hal::sim::HeadPose& pose,
                  const hal::sim::HeadPose* twin = nullptr);
  hal::sim::PicturePair develop(const Shot& shot, const Developing& how) const;
  const pipeline::StereoCalibration& calibration() const { return calibration_; }

 private:
  void expose(Shot& shot);
  std::filesystem::path cache_;
  ThreadPool pool_{2};
  hal::sim::SimRig rig_;
  pipeline::StereoCalibration calibration_;
  std::shared_ptr<const hal::sim::HeadModel> person(std::uint32_t seed,
                                                    const hal::sim::Expression& expression, double shine);
  std::map<std::vector<double>, std::shared_ptr<const hal::sim::HeadModel>> heads_;
  std::map<std::vector<double>, Shot> shots_;
  std::map<std::uint32_t, PastedHead> pasted_;
  hal::sim::LightPicture left_room_, right_room_;
};

// One for all tests of a program. The environment's RELIEVO_ALBUM names a folder where its photographs
// survive the program.
Album& shared_album();

// A pose that faces the middle between the cameras from a place given in the relief's terms: `right_mm` from
// the rig's middle.
hal::sim::HeadPose standing(double distance_mm, double right_mm = 0, double down_mm = 0, double yaw_deg = 0,
                            double pitch_deg = 0, double roll_deg = 0);

// Of somebody who looks in over the shoulder of a person in this pose.
hal::sim::HeadPose behind(hal::sim::HeadPose pose);

// What measure_head() should say of the shot.
struct TrueHead {
  double yaw_deg, pitch_deg, roll_deg;
  pipeline::Vec3d tip_mm;  // pronasale, frame of the relief
};
TrueHead true_head(const Shot& shot, const pipeline::Relief& relief);

}  // namespace relievo::test
