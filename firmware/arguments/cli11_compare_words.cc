// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include <algorithm>

#include "firmware/arguments/command_words.h"

namespace relievo::firmware {
namespace {

// The dissertation's report is one of its own, on one pair, or on a simulated person.
void check_dissertation(const CompareArgs& args) {
  if (args.suites.size() > 1 || !args.set_files.empty() || !args.set_words.empty() || args.keep_maps)
    throw CLI::ValidationError(
        "--suite dissertation",
        "is a report of its own: give no other --suite, no --sets, --set-of or --keep-maps");
  if (args.pictures.size() > 2)
    throw CLI::ValidationError("--suite dissertation",
                               "takes one pair, LEFT RIGHT, or none: a simulated person");
}

void check_counts(const CompareArgs& args) {
  const bool dissertation = std::ranges::find(args.suites, "dissertation") != args.suites.end();
  if (dissertation) check_dissertation(args);
  if (args.pictures.empty()) {
    if (dissertation && args.calibrations.empty() && !args.rectified && args.truths.empty()) return;
    throw CLI::ValidationError("LEFT RIGHT",
                               "are wanted: two pictures; without any there is --suite dissertation only");
  }
  if (args.pictures.size() % 2 != 0)
    throw CLI::ValidationError("pictures", "come in pairs: LEFT RIGHT [LEFT RIGHT ...]");
  const std::size_t pairs = args.pictures.size() / 2;
  const auto fits = [pairs](const std::vector<Path>& given) {
    return given.size() <= 1 || given.size() == pairs;
  };
  if (!fits(args.calibrations))
    throw CLI::ValidationError("--calibration", "is given once, or once for every pair");
  if (!fits(args.truths)) throw CLI::ValidationError("--truth", "is given once, or once for every pair");
  if (args.rectified == !args.calibrations.empty())
    throw CLI::ValidationError("--calibration",
                               "of the rig that took the pictures is wanted, or --rectified, and not both");
}

}  // namespace

CLI::App* add_compare(CLI::App& app, CommandArgs& chosen, CompareArgs& args) {
  CLI::App* command = app.add_subcommand(
      "compare", "sets of algorithms beside each other, on one pair or many: a page and its figures");
  word(*command, "pictures", args.pictures, "LEFT RIGHT",
       "left, right, left, right, ...; none is needed for --suite dissertation");
  const auto each = [command](const char* name, std::vector<Path>& to, const char* help, const char* type) {
    return command->add_option(name, to, help)->type_name(type)->take_all()->allow_extra_args(false);
  };
  each("--calibration", args.calibrations, "once, or once for every pair", "rig.yml");
  CLI::Option* rectified =
      command->add_flag("--rectified", args.rectified, "the pictures are rectified already");
  add_two_numbers(
      *command, "--disparities", args.least_disparity_px, args.most_disparity_px,
      {':', -4096, -4096, 4096, "FROM:TO",
       "wants the least disparity and, above it, the first that is too large, from -4096 to 4096, such as 0:256",
       true},
      "of --rectified: where a partner is looked for, pixels")
      ->default_str("0:256")
      ->needs(rectified);
  each(
      "--truth", args.truths,
      "folder that 'relievo simulate face --truth' wrote, or a disparity map: PFM, or PNG whose 0 is unknown",
      "DIR|FILE");
  number(*command, "--truth-scale", args.truth_scale, CLI::Range(0.001, 65535.0),
         "of a PNG: grey values per pixel of disparity");
  number(*command, "--bad-px", args.limit_px, CLI::Range(0.01, 1000.0), "a disparity off by more is bad");
  each("--sets", args.set_files, "sets of algorithms, a table each", "FILE.toml");
  word(*command, "--set-of", args.set_words, "SET", "one set: \"NAME: KEY=VALUE KEY=VALUE\"")
      ->take_all()
      ->allow_extra_args(false);
  word(
      *command, "--suite", args.suites, "NAME",
      "sets that belong together: peers, matchers, constraints, selectors, preprocessors, meshers, dissertation-face; or dissertation: its tables 1 and 2, figures 6 to 12 and 17 done again, as one report")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--keep-maps", args.keep_maps, "every set's disparities as PFM beside the page");
  word(*command, "-o,--output", args.output, "DIR", "folder for the page and the figures")->required();
  command->callback([&args, &chosen] {
    check_counts(args);
    chosen = args;
  });
  return command;
}

}  // namespace relievo::firmware
