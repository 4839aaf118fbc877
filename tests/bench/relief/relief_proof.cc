// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is a picture of a face ever taken for a face, and how often a face for a picture? Photographs of simulated
// people, printed flat, printed and bent, and shown on a screen, and as many simulated people, each before
// the rig at half size in a pose, a distance, a light and an exposure of its own, through the whole chain.
// Exit code 1 where a picture was accepted, or more than 3 % of the people were refused for any reason.
//   relief_proof [COUNT = 300] [DIR]
// COUNT of each of the four kinds. DIR gets trials.txt, a line a trial, and the first three pictures of each
// kind.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/bench/relief/relief_trial.h"

namespace relievo::bench {
namespace {

constexpr double kMostRefused = 0.03;
// Of simulated people, whom no threshold has seen. The album's are others than those who come themselves.
constexpr std::uint32_t kFirstInAlbum = 3001, kFirstToCome = 4001;
constexpr int kMostInAlbum = 40, kPicturesKept = 3;
constexpr std::uint64_t kFirstPlace = 100000;  // so are the poses, lights and bends

struct Tally {
  int shown = 0, accepted = 0, without_relief = 0, otherwise = 0;
  double least_off = 1e9, most_off = 0, least_curved = 1e9, most_curved = 0;
  void add(const Verdict& v) {
    ++shown;
    accepted += v.accepted ? 1 : 0;
    without_relief += !v.accepted && v.relief ? 1 : 0;
    otherwise += !v.accepted && !v.relief ? 1 : 0;
    if (!v.relief) return;
    least_off = std::min(least_off, v.relief->off_sheet_mm),
    most_off = std::max(most_off, v.relief->off_sheet_mm);
    least_curved = std::min(least_curved, v.relief->curvature_sr),
    most_curved = std::max(most_curved, v.relief->curvature_sr);
  }
};

std::string line_of(Shown shown, int number, const Trial& trial, const Verdict& v) {
  char figures[160] = "no surface";
  if (const auto& r = v.relief)
    std::snprintf(figures, sizeof figures,
                  "covered %.2f sigma %.2f plane %.2f sheet %.2f range %.2f curvature %.2f", r->covered,
                  r->sigma_mm, r->off_plane_mm, r->off_sheet_mm, r->sheet_range_mm, r->curvature_sr);
  return std::string(name_of(shown)) + "\t" + std::to_string(number) + "\t" +
         (v.accepted ? "accepted" : "refused: " + v.why) + "\t" + figures + "\t" + trial.what;
}

class Proof {
 public:
  Proof(int count, std::filesystem::path folder) : count_(count), folder_(std::move(folder)) {
    if (folder_.empty()) return;
    std::filesystem::create_directories(folder_);
    lines_.open(folder_ / "trials.txt");
  }

  void show_pictures() {
    const Album album(kFirstInAlbum, std::clamp(count_ / 8, 2, kMostInAlbum), room_.pool);
    for (const Shown shown : {Shown::PrintedFlat, Shown::PrintedBent, Shown::Screen}) {
      for (int k = 0; k < count_; ++k)
        run(shown, k, show_picture(shown, album, kFirstPlace + static_cast<std::uint64_t>(k)));
      sum_up(shown);
    }
  }
  void show_people() {
    People people(kFirstToCome, room_.pool);
    for (int k = 0; k < count_; ++k)
      run(Shown::Face, k, people.show(kFirstPlace + static_cast<std::uint64_t>(k)));
    sum_up(Shown::Face);
  }
  bool holds() const { return holds_; }

 private:
  void run(Shown shown, int number, const Trial& trial) {
    const auto pictures = photograph(trial, room_.pool);
    const Verdict verdict = judge(trial, pictures, room_);
    tally_.add(verdict);
    const bool wrong = verdict.accepted != (shown == Shown::Face);
    const std::string line = line_of(shown, number, trial, verdict);
    if (wrong) std::printf("%s\n", line.c_str()), std::fflush(stdout);
    if (folder_.empty()) return;
    lines_ << line << std::endl;
    if (!wrong && number >= kPicturesKept) return;
    const std::string name = std::string(name_of(shown)) + " " + std::to_string(number);
    for (const auto& [side, picture] :
         {std::pair{" left.png", &pictures.left}, std::pair{" right.png", &pictures.right}})
      if (!hal::write_picture(folder_ / (name + side), picture->view()))
        std::fprintf(stderr, "a picture could not be written\n");
  }

  void sum_up(Shown shown) {
    const Tally t = tally_;
    tally_ = {};
    std::printf(
        "%-16s %d shown: %d accepted, %d refused for want of relief, %d for another reason; off a sheet %.2f to %.2f mm, curvature %.2f to %.2f sr\n",
        name_of(shown), t.shown, t.accepted, t.without_relief, t.otherwise, t.least_off, t.most_off,
        t.least_curved, t.most_curved);
    std::fflush(stdout);
    holds_ =
        holds_ && (shown == Shown::Face ? t.shown - t.accepted <= kMostRefused * t.shown : t.accepted == 0);
  }

  int count_;
  std::filesystem::path folder_;
  std::ofstream lines_;
  test::StageFixture room_;
  Tally tally_;
  bool holds_ = true;
};

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 300;
  if (count < 1 || argc > 3) {
    std::fprintf(stderr, "usage: relief_proof [COUNT] [DIR]\n");
    return 2;
  }
  relievo::bench::Proof proof(count, argc > 2 ? argv[2] : "");
  proof.show_pictures();
  proof.show_people();
  std::printf("%s\n", proof.holds() ? "holds" : "does not hold");
  return proof.holds() ? 0 : 1;
}
