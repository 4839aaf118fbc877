// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Are the models fit for recognition? Photographs persons that do not exist, enrols each looking straight
// ahead, probes each turned by up to 30 degrees, and compares every probe with everybody.
//
//   recognition_proof FOLDER [--own 30] [--other 30 --synth PROGRAM --heads FOLDER] [--photographs-only]
//
// PROGRAM is another renderer with heads of its own (photographer.h says how it is called); without it the
// proof runs with our own heads only, and says so. FOLDER keeps pictures and surfaces: a run that was stopped
// goes on. Writes FOLDER/recognition.html and FOLDER/scores.csv. Exit code 1 where rank 1 is below 99 %.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "tests/bench/recognition/enrolment.h"
#include "tests/bench/recognition/photographer.h"
#include "tests/bench/recognition/recognition_page.h"

namespace relievo::bench {
namespace {

constexpr double kWantedRankOne = 0.99;

struct Asked {
  std::filesystem::path folder;
  int own = 30, other = 30;
  OtherMaker maker;
  bool photographs_only = false;
};

bool parse(int argc, char** argv, Asked& asked) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--own" && more) asked.own = std::atoi(argv[++i]);
    else if (word == "--other" && more) asked.other = std::atoi(argv[++i]);
    else if (word == "--synth" && more) asked.maker.program = std::filesystem::absolute(argv[++i]);
    else if (word == "--heads" && more) asked.maker.heads = std::filesystem::absolute(argv[++i]);
    else if (word == "--photographs-only") asked.photographs_only = true;
    else if (!word.starts_with("-") && asked.folder.empty()) asked.folder = std::filesystem::absolute(word);
    else return false;
  }
  return !asked.folder.empty() && asked.own >= 0 && asked.other >= 0 && asked.own <= 900 &&
         asked.other <= 900 && asked.maker.program.empty() == asked.maker.heads.empty();
}

void complain(const Error& e) {
  std::fprintf(stderr, "%.*s: %.*s\n", static_cast<int>(e.where().size()), e.where().data(),
               static_cast<int>(e.what.view().size()), e.what.view().data());
}

using Faces = std::map<std::string, pipeline::ComparableFace>;  // by visit

class Run {
 public:
  explicit Run(const Asked& asked) : asked_(asked), photographer_(asked.folder, asked.maker, room_.pool) {}

  Result<void> run(Proof& proof) {
    for (const Person& person : proof.people) {
      RELIEVO_TRY_ASSIGN(const bool worked, photographer_.photograph(person));
      if (worked) say("photographed", person.name);
      if (asked_.photographs_only) continue;
      see(person.enrolment, proof);
      for (const Visit& probe : person.probes) see(probe, proof);
    }
    if (!asked_.photographs_only) compare(proof);
    return {};
  }

 private:
  static void say(const char* what, const std::string& whom) {
    std::printf("%s %s\n", what, whom.c_str());
    std::fflush(stdout);
  }

  void see(const Visit& visit, Proof& proof) {
    auto face = enrol(photographer_.folder_of(visit), room_);
    if (face) {
      faces_.emplace(visit.name, *std::move(face));
      return;
    }
    proof.failures.push_back({visit.name, std::string(face.error().what.view())});
    say("not reconstructed:", visit.name + ": " + proof.failures.back().why);
  }

  // A row of scores a probe; probes are shared out among the threads.
  void compare(Proof& proof) {
    struct Row {
      int person, probe;
    };
    std::vector<Row> rows;
    for (std::size_t p = 0; p < proof.people.size(); ++p)
      for (int k = 0; k < kProbes; ++k) rows.push_back({static_cast<int>(p), k});
    const std::size_t gallery = proof.people.size();
    proof.scores.resize(rows.size() * gallery);
    room_.pool.for_each_band(
        static_cast<int>(rows.size()), static_cast<int>(rows.size()), [&](int begin, int end, int) {
          for (int r = begin; r < end; ++r) {
            const Row& row = rows[static_cast<std::size_t>(r)];
            const auto probe = faces_.find(proof.people[static_cast<std::size_t>(row.person)]
                                               .probes[static_cast<std::size_t>(row.probe)]
                                               .name);
            for (std::size_t g = 0; g < gallery; ++g) {
              Score& score = proof.scores[static_cast<std::size_t>(r) * gallery + g];
              score = {static_cast<int>(g), row.person, row.probe, {}, 0};
              const auto enrolled = faces_.find(proof.people[g].enrolment.name);
              if (probe == faces_.end() || enrolled == faces_.end()) continue;
              if (const auto d = compare_faces(enrolled->second, probe->second)) {
                score.rms_mm = d->rms_mm;
                score.shared = d->shared;
              }
            }
          }
        });
  }

  const Asked& asked_;
  test::StageFixture room_;
  Photographer photographer_;
  Faces faces_;
};

bool write_results(const Proof& proof, const std::filesystem::path& folder) {
  std::ofstream csv(folder / "scores.csv");
  csv << "probe,yaw_deg,enrolled,rms_mm,shared\n";
  for (const Score& s : proof.scores) {
    const Visit& probe =
        proof.people[static_cast<std::size_t>(s.probe_person)].probes[static_cast<std::size_t>(s.probe)];
    csv << probe.name << ',' << probe.yaw_deg << ',' << proof.people[static_cast<std::size_t>(s.gallery)].name
        << ',';
    if (s.rms_mm) csv << *s.rms_mm;
    csv << ',' << s.shared << '\n';
  }
  std::ofstream page(folder / "recognition.html");
  page << page_of(proof);
  return csv.flush() && page.flush();
}

void print(const Proof& proof) {
  std::printf("%-46s %7s %8s %8s %6s %9s %9s %9s %9s\n", "probes", "count", "rank 1", "EER", "d'", "same med",
              "same max", "diff min", "diff med");
  for (const Group& g : groups_of(proof)) {
    const Verdict& v = g.verdict;
    if (v.probes == 0) continue;
    std::printf("%-46s %7d %6.2f %% %6.2f %% %6.2f %9.3f %9.3f %9.3f %9.3f\n", g.name.c_str(), v.probes,
                100.0 * v.right_first / v.probes, 100 * v.equal_error, v.d_prime, v.median_same_mm,
                v.greatest_same_mm, v.least_different_mm, v.median_different_mm);
  }
  const Verdict all = judge(proof.scores);
  std::printf(
      "%d comparisons: %d same, %d different, %d impossible; %zu visits not reconstructed; false non-match %.2f %% at one false match in 1000\n",
      all.same + all.different, all.same, all.different, all.not_compared, proof.failures.size(),
      100 * all.non_match_at_thousandth);
}

int main_of(int argc, char** argv) {
  Asked asked;
  if (!parse(argc, argv, asked)) {
    std::fprintf(
        stderr,
        "usage: recognition_proof FOLDER [--own 30] [--other 30 --synth PROGRAM --heads FOLDER] [--photographs-only]\n");
    return 2;
  }
  if (asked.maker.program.empty()) {
    std::printf(
        "no --synth PROGRAM --heads FOLDER: with our own heads only, so that the proof rests on one generator\n");
    asked.other = 0;
  }
  std::error_code ignored;
  std::filesystem::create_directories(asked.folder, ignored);
  Proof proof;
  proof.people = make_population(asked.own, asked.other);
  if (const auto done = Run(asked).run(proof); !done) return complain(done.error()), 1;
  if (asked.photographs_only) return 0;
  print(proof);
  if (!write_results(proof, asked.folder))
    return std::fprintf(stderr, "%s: cannot be written to\n", asked.folder.c_str()), 1;
  std::printf("drawn: %s\n", (asked.folder / "recognition.html").c_str());
  const Verdict all = judge(proof.scores);
  return all.probes > 0 && all.right_first >= kWantedRankOne * all.probes ? 0 : 1;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) { return relievo::bench::main_of(argc, argv); }
