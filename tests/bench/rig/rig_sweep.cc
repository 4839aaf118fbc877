// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which rig? Sweeps baseline, focal length, distance and toe-in, landscape and portrait, with simulated
// people before simulated cameras and the whole chain behind them.
//
//   rig_sweep DIR [--scale 1] [--persons 2] [--panel NAME]   writes DIR/sweep.csv and DIR/sweep.svg
//   rig_sweep --draw DIR                                        draws the chart again from the csv
//
// A run that was stopped goes on where it was: lines already in the csv are not tried again.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "tests/bench/rig/rig_plan.h"
#include "tests/bench/rig/sweep_chart.h"

namespace relievo::bench {
namespace {

struct Asked {
  std::filesystem::path folder;
  double scale = 1;
  int persons = 2;
  std::string panel;  // empty: all
  bool only_draw = false;
};

bool parse(int argc, char** argv, Asked& asked) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--scale" && more) asked.scale = std::atof(argv[++i]);
    else if (word == "--persons" && more) asked.persons = std::atoi(argv[++i]);
    else if (word == "--panel" && more) asked.panel = argv[++i];
    else if (word == "--draw") asked.only_draw = true;
    else if (!word.starts_with("-") && asked.folder.empty()) asked.folder = word;
    else return false;
  }
  return !asked.folder.empty() && asked.scale >= 0.2 && asked.scale <= 1 && asked.persons >= 1 &&
         asked.persons <= 100;
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

// What makes two rows the same trial: everything but the panel it is shown in, and whether it is one.
std::string key_of(Row row, double scale) {
  row.panel = only_geometry(row) ? "seen" : "measured";
  row.result = {};
  return csv_line(row, scale);
}

bool run(const Asked& asked, const std::filesystem::path& csv) {
  std::map<std::string, TrialResult> known;
  std::set<std::string> written;
  for (const Row& row : parse_csv(content_of(csv))) {
    known[key_of(row, asked.scale)] = row.result;
    written.insert(row.panel + key_of(row, asked.scale));
  }
  std::ofstream out(csv, std::ios::app);
  if (written.empty()) out << csv_header();
  test::StageFixture room(std::size_t{640} << 20, std::size_t{1024} << 20,
                          static_cast<int>(std::thread::hardware_concurrency()));
  std::map<std::uint32_t, Person> persons;
  for (Row row : plan(asked.persons)) {
    const std::string key = key_of(row, asked.scale);
    if (!asked.panel.empty() && !row.panel.starts_with(asked.panel)) continue;
    if (!written.insert(row.panel + key).second) continue;
    if (!known.contains(key)) {
      if (!persons.contains(row.person)) persons.emplace(row.person, make_person(row.person, room.pool));
      const Person& person = persons.at(row.person);
      known[key] = only_geometry(row) ? look_at(row.rig, person, row.stand, row.person)
                                      : run_trial(row.rig, person, row.stand, row.person, asked.scale, room);
    }
    row.result = known[key];
    const std::string line = csv_line(row, asked.scale);
    out << line << std::flush;
    if (!only_geometry(row)) std::fprintf(stderr, "%s", line.c_str());
    if (!row.result.why.empty()) std::fprintf(stderr, "  no surface: %s\n", row.result.why.c_str());
  }
  return static_cast<bool>(out);
}

int main_of(int argc, char** argv) {
  Asked asked;
  if (!parse(argc, argv, asked)) {
    std::fprintf(stderr,
                 "rig_sweep DIR [--scale 0.2..1] [--persons N] [--panel NAME] | rig_sweep --draw DIR\n");
    return 2;
  }
  std::error_code failed;
  std::filesystem::create_directories(asked.folder, failed);
  const auto csv = asked.folder / "sweep.csv";
  if (!asked.only_draw && !run(asked, csv)) {
    std::fprintf(stderr, "rig_sweep: %s cannot be written\n", csv.c_str());
    return 1;
  }
  const std::vector<Row> rows = parse_csv(content_of(csv));
  if (rows.empty()) {
    std::fprintf(stderr, "rig_sweep: %s holds no trials\n", csv.c_str());
    return 1;
  }
  std::ofstream svg(asked.folder / "sweep.svg");
  svg << draw_sweep(rows);
  return svg ? 0 : 1;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) { return relievo::bench::main_of(argc, argv); }
