// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is the head's frame the same however the head is turned? Folders of one photograph each (left.png,
// right.png, rig.yml, head.ply), named PERSON_POSE, as `relievo simulate face --truth` writes them: each is
// reconstructed (once: mesh.bin keeps the surface, remove it to match again), and the frames of one person
// are compared pair by pair, their true motion undone. Exit code 1 where any two frames of one person are
// further apart than 0.7 mm or 0.7 degrees.
//   frame_repeatability FOLDER...
// A set:  for s in $(seq 1 10); do for p in "front 0 0" "left 25 0" "right -25 0" "down 0 15" "up 0 -15"; do
//           set -- $p; relievo simulate face --seed $s --yaw $2 --pitch $3 --scale 0.5 --truth -o
//           set/s${s}_$1; done; done
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "firmware/measure/measurement.h"
#include "pipeline/model/vector3.h"
#include "tests/bench/frame_trial.h"
#include "tests/bench/recognition/enrolment.h"

namespace relievo::bench {
namespace {

constexpr double kBarMm = 0.7, kBarDeg = 0.7;

Result<Photograph> look_at(const std::filesystem::path& folder, test::StageFixture& room) {
  Photograph photo{person_of(folder), pose_of(folder), {}, {}, {}};
  RELIEVO_TRY_ASSIGN(photo.true_surface, firmware::measure::read_true_surface(folder / "head.ply"));
  RELIEVO_TRY_ASSIGN(const SeenSurface seen, surface_of(folder, room));
  photo.across = seen.across;
  auto frame = pipeline::run_stage(
      room.context, [&](pipeline::StageContext& c) { return find_head_frame(seen.mesh, c, photo.across); });
  if (!frame) return frame.error();
  photo.frame = *frame;
  return photo;
}

struct Tally {
  double worst_mm = 0, worst_deg = 0, sum_mm2 = 0, sum_deg2 = 0;
  int pairs = 0, over = 0;
  void add(double mm, double deg) {
    worst_mm = std::max(worst_mm, mm), worst_deg = std::max(worst_deg, deg);
    sum_mm2 += mm * mm, sum_deg2 += deg * deg;
    ++pairs;
    over += mm > kBarMm || deg > kBarDeg ? 1 : 0;
  }
};

void compare(const std::vector<Photograph>& photos, Tally& tally) {
  for (std::size_t i = 0; i < photos.size(); ++i)
    for (std::size_t j = i + 1; j < photos.size(); ++j) {
      const Apart apart = between(photos[i], photos[j], a_from_b(photos[i], photos[j]));
      const double mm = pipeline::length(apart.origin_mm);
      std::printf("%-8s %-6s %-6s  %5.2f mm (%5.2f %5.2f %5.2f)  %5.2f deg (%5.2f %5.2f %5.2f)%s\n",
                  photos[i].person.c_str(), photos[i].pose.c_str(), photos[j].pose.c_str(), mm,
                  apart.origin_mm.x, apart.origin_mm.y, apart.origin_mm.z, apart.turned_deg,
                  apart.turns_deg.x, apart.turns_deg.y, apart.turns_deg.z,
                  mm > kBarMm || apart.turned_deg > kBarDeg ? "  over" : "");
      tally.add(mm, apart.turned_deg);
    }
}

int run(int count, char** folders) {
  test::StageFixture room;
  std::map<std::string, std::vector<Photograph>> people;
  for (int i = 1; i < count; ++i) {
    auto photo = look_at(folders[i], room);
    if (!photo) {
      std::fprintf(stderr, "%s: %.*s\n", folders[i], static_cast<int>(photo.error().what.view().size()),
                   photo.error().what.view().data());
      return 1;
    }
    auto& of_person = people[photo->person];
    of_person.push_back(*std::move(photo));
  }
  Tally tally;
  for (const auto& [person, photos] : people) compare(photos, tally);
  const double pairs = std::max(1, tally.pairs);
  std::printf(
      "%zu people, %d pairs, %d over: rms %.2f mm, %.2f degrees, worst %.2f mm, %.2f degrees (wanted: %.1f, %.1f)\n",
      people.size(), tally.pairs, tally.over, std::sqrt(tally.sum_mm2 / pairs),
      std::sqrt(tally.sum_deg2 / pairs), tally.worst_mm, tally.worst_deg, kBarMm, kBarDeg);
  return tally.pairs == 0 || tally.over > 0 ? 1 : 0;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) { return relievo::bench::run(argc, argv); }
