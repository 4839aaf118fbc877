// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/recognition/photographer.h"

#include <algorithm>
#include <string>
#include <system_error>

#include "hal/sim/render.h"
#include "tests/support/process.h"

namespace relievo::bench {
namespace {

constexpr int kWidthPx = 960, kHeightPx = 600;
constexpr std::uint32_t kRig = 5;
// Both makers measure yaw from the left camera; who looks between the cameras has turned this far to the
// right.
constexpr double kTowardsTheMiddleDeg = 7.1;  // atan(70 / 560)

// What a face does that bones do not: corners of the mouth, cheeks, lids.
hal::sim::HeadTraits traits_in(const Visit& visit) {
  hal::sim::HeadTraits t = hal::sim::traits_of(visit.person_seed);
  t.mouth_curve += 1.6 * visit.smile;
  t.mouth_width += 4 * visit.smile;
  t.fullness += 0.4 * visit.smile;
  t.eye_open -= 1.2 * visit.squint;
  return t;
}

}  // namespace

Result<void> Photographer::photograph_own(const Visit& visit, const std::filesystem::path& folder) {
  namespace sim = hal::sim;
  sim::RigOptions rig_options;
  rig_options.width_px = kWidthPx;
  rig_options.height_px = kHeightPx;
  rig_options.seed = kRig;
  const sim::SimRig rig = sim::make_rig(rig_options);
  const sim::HeadPose pose{
      visit.yaw_deg + kTowardsTheMiddleDeg, visit.pitch_deg, visit.roll_deg, visit.distance_mm, 0, 0};
  const sim::HeadLighting light{visit.light_left, visit.light_right, visit.light_below};
  if (head_ == nullptr || shown_.person_seed != visit.person_seed || shown_.smile != visit.smile) {
    head_ = sim::make_head(traits_in(visit), pool_);
    shown_ = visit;
  }
  const auto scene = sim::make_head_scene(head_, pose, pool_, light);
  sim::SensorOptions sensor;
  sensor.noise = visit.noise;
  const sim::PicturePair pair = sim::render_pair(*scene, rig, sensor, visit.visit_seed, pool_);
  RELIEVO_TRY(hal::write_picture(folder / "left.png", pair.left.view()));
  RELIEVO_TRY(hal::write_picture(folder / "right.png", pair.right.view()));
  RELIEVO_TRY(sim::write_rig(folder / "rig.yml", rig));
  return sim::write_mesh(folder / "head.ply", scene->solid_mesh());
}

Result<void> Photographer::photograph_other(const Visit& visit, const std::filesystem::path& folder) {
  const auto number = [](double v) { return std::to_string(v); };
  const test::Said said = test::run_program({other_.program.string(),
                                             folder.string(),
                                             std::to_string(visit.visit_seed),
                                             "head",
                                             other_.heads.string(),
                                             "--size",
                                             std::to_string(kWidthPx),
                                             std::to_string(kHeightPx),
                                             "--spp",
                                             "4",
                                             "--yaw",
                                             number(-visit.yaw_deg - kTowardsTheMiddleDeg),
                                             "--pitch",
                                             number(visit.pitch_deg),
                                             "--noise",
                                             number(visit.noise),
                                             "--dist",
                                             number(visit.distance_mm),
                                             "--gain",
                                             number(visit.right_gain),
                                             "--rig",
                                             std::to_string(kRig),
                                             "--same-head",
                                             std::to_string(visit.person_seed)},
                                            folder);
  if (said.exit_code != 0)
    return Error{Errc::LibraryFailed, "the other maker's program failed: run it by hand to see why"}.at(
        other_.program.string() + ": " + said.err);
  std::error_code ignored;
  std::filesystem::remove(folder / "truth.bin", ignored);
  for (const char* const name : {"left.png", "right.png", "rig.yml", "head.ply"})
    if (!std::filesystem::exists(folder / name))
      return Error{Errc::LibraryFailed, "the other maker's program left out a file"}.at(
          other_.program.string() + ": " + name);
  return {};
}

Result<bool> Photographer::photograph(const Person& person) {
  std::vector<const Visit*> visits{&person.enrolment};
  for (const Visit& probe : person.probes) visits.push_back(&probe);
  std::stable_sort(visits.begin(), visits.end(),
                   [](const Visit* a, const Visit* b) { return a->smile < b->smile; });  // one head at a time
  bool worked = false;
  for (const Visit* visit : visits) {
    const std::filesystem::path done = folder_of(*visit);
    if (std::filesystem::exists(done)) continue;
    const std::filesystem::path unfinished = folder_ / ("unfinished-" + visit->name);
    std::error_code failed;
    std::filesystem::remove_all(unfinished, failed);
    std::filesystem::create_directories(unfinished, failed);
    if (failed)
      return Error{Errc::IoFailed, "cannot make this folder", failed.value()}.at(unfinished.string());
    RELIEVO_TRY(visit->maker == Maker::Own ? photograph_own(*visit, unfinished)
                                           : photograph_other(*visit, unfinished));
    std::filesystem::rename(unfinished, done, failed);
    if (failed)
      return Error{Errc::IoFailed, "cannot give this folder its name", failed.value()}.at(done.string());
    worked = true;
  }
  return worked;
}

}  // namespace relievo::bench
