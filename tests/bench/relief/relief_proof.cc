// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is a picture of a face ever taken for a face, and how often a face for a picture? Photographs of simulated
// people, printed flat, printed and bent, and shown on a screen, and as many simulated people, each before
// the rig at half size in a pose, a distance, a light and an exposure of its own, through the whole chain.
// And is a rigid mask with closed eyes told from a person by how both turn the head? Exit code 1 where a
// picture or a mask was accepted, or more than 3 % of the people were refused for any reason, 2 % of those
// who turned.
//   relief_proof [COUNT = 300 [DIR [TURNING = COUNT]]]
// COUNT of each of the four kinds that stand still, TURNING of the two that turn. DIR (- for none) gets
// trials.txt, a line a trial, and the first three pictures of each kind.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/bench/relief/relief_trial.h"

namespace relievo::bench {
namespace {

constexpr double kMostRefused = 0.03, kMostTurningRefused = 0.02;
// Of simulated people, whom no threshold has seen. The album's are others than those who come themselves.
constexpr std::uint32_t kFirstInAlbum = 3001, kFirstToCome = 4001, kFirstToTurn = 5001;
constexpr int kMostInAlbum = 40, kPicturesKept = 3;
constexpr std::uint64_t kFirstPlace = 100000;  // so are the poses, lights and bends

struct Tally {
  int shown = 0, accepted = 0, without_relief = 0, otherwise = 0;
  double least_off = 1e9, most_off = 0, least_curved = 1e9, most_curved = 0;
  int not_alive = 0;  // of the otherwise refused
  double least_follow = 1e9, most_follow = -1e9, least_iris = 1e9, most_iris = -1e9;
  void add(const Verdict& v) {
    ++shown;
    accepted += v.accepted ? 1 : 0;
    without_relief += !v.accepted && v.relief ? 1 : 0;
    otherwise += !v.accepted && !v.relief ? 1 : 0;
    if (const auto& a = v.aliveness; a.eyes_follow && a.iris_contrast) {
      not_alive += a.verdict() == pipeline::Aliveness::Verdict::NotAlive ? 1 : 0;
      least_follow = std::min(least_follow, *a.eyes_follow);
      most_follow = std::max(most_follow, *a.eyes_follow);
      least_iris = std::min(least_iris, *a.iris_contrast), most_iris = std::max(most_iris, *a.iris_contrast);
    }
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
  if (const auto& a = v.aliveness; a.eyes_follow && a.iris_contrast)
    std::snprintf(figures, sizeof figures, "eyes follow %.2f iris contrast %.2f", *a.eyes_follow,
                  *a.iris_contrast);
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
  void show_turning_heads(int count) {
    std::vector<std::byte> block(std::size_t{96} << 20);
    Arena kept(block);
    for (const Shown shown : {Shown::TurningMask, Shown::TurningPerson}) {
      for (int k = 0; k < count; ++k) {
        const auto trials =
            show_turning(shown, kFirstToTurn, kFirstPlace + static_cast<std::uint64_t>(k), room_.pool);
        std::vector<hal::sim::PicturePair> pictures;
        for (const Trial& trial : trials) pictures.push_back(photograph(trial, room_.pool));
        const Verdict verdict = judge_turning(trials, pictures, room_, kept);
        add(shown, k, trials.front(), pictures.front(), verdict);
      }
      if (count > 0) sum_up(shown);
    }
  }
  bool holds() const { return holds_; }

 private:
  static bool is_person(Shown shown) { return shown == Shown::Face || shown == Shown::TurningPerson; }
  void run(Shown shown, int number, const Trial& trial) {
    const auto pictures = photograph(trial, room_.pool);
    add(shown, number, trial, pictures, judge(trial, pictures, room_));
  }
  void add(Shown shown, int number, const Trial& trial, const hal::sim::PicturePair& pictures,
           const Verdict& verdict) {
    tally_.add(verdict);
    const bool wrong = verdict.accepted != is_person(shown);
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
    const bool turned = shown == Shown::TurningPerson || shown == Shown::TurningMask;
    std::printf("%-16s %d shown: %d accepted, ", name_of(shown), t.shown, t.accepted);
    if (turned)
      std::printf("%d not alive, %d refused before; eyes follow %.2f to %.2f, iris contrast %.2f to %.2f\n",
                  t.not_alive, t.otherwise - t.not_alive, t.least_follow, t.most_follow, t.least_iris,
                  t.most_iris);
    else
      std::printf(
          "%d refused for want of relief, %d for another reason; off a sheet %.2f to %.2f mm, curvature %.2f to %.2f sr\n",
          t.without_relief, t.otherwise, t.least_off, t.most_off, t.least_curved, t.most_curved);
    std::fflush(stdout);
    const double most = turned ? kMostTurningRefused : kMostRefused;
    holds_ = holds_ && (is_person(shown) ? t.shown - t.accepted <= most * t.shown : t.accepted == 0);
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
  const int count = argc > 1 ? std::atoi(argv[1]) : 300, turning = argc > 3 ? std::atoi(argv[3]) : count;
  if (count < 0 || turning < 0 || count + turning < 1 || argc > 4) {
    std::fprintf(stderr, "usage: relief_proof [COUNT [DIR [TURNING]]]\n");
    return 2;
  }
  relievo::bench::Proof proof(count, argc > 2 && std::string_view(argv[2]) != "-" ? argv[2] : "");
  if (count > 0) proof.show_pictures(), proof.show_people();
  proof.show_turning_heads(turning);
  std::printf("%s\n", proof.holds() ? "holds" : "does not hold");
  return proof.holds() ? 0 : 1;
}
