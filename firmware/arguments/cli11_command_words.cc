// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/command_words.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>
#include <string_view>

namespace relievo::firmware {
namespace {

using Verb = CalibrationArgs::Verb;

// Not a number where it is none, whatever the locale. CLI11 takes a plus before it, from_chars does not.
double word_as_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && (word[1] == '.' || (word[1] >= '0' && word[1] <= '9')))
    word.remove_prefix(1);
  double number = 0;
  const auto [end, bad] = std::from_chars(word.data(), word.data() + word.size(), number);
  return bad == std::errc() && end == word.data() + word.size() ? number
                                                                : std::numeric_limits<double>::quiet_NaN();
}

// CLI::Range lets "nan" through.
CLI::Validator within(double least, double most) {
  std::ostringstream words;
  words << least << " to " << most;
  return CLI::Validator(
      [least, most, text = words.str()](std::string& word) {
        const double number = word_as_number(word);
        return number >= least && number <= most ? std::string()
                                                 : "wants a number from " + text + ", not " + word;
      },
      words.str());
}

std::string check_unit(const std::string& word) {
  const double unit = word_as_number(word);
  return unit >= 1e-6 && unit <= 1e6 ? ""
                                     : "wants the millimetres of one unit, such as 1 or 1000, not " + word;
}

std::string check_revision(const std::string& word) {
  const bool good =
      !word.empty() && word.front() != '0' && word.find_first_not_of("0123456789") == std::string::npos;
  return good ? "" : "wants a number as 'relievo calibration list' has it, from 1 on, not " + word;
}

void add_import(CLI::App& command, CalibrationArgs& args) {
  word(command, "file", args.file, "FILE", "rig.yml; or one of intrinsics.yml, left.yaml")->required();
  word(command, "other", args.other, "FILE",
       "the other half of a pair; default: beside the first, by its name");
  add_two_numbers(
      command, "--image-size", args.width_px, args.height_px,
      {'x', 16, 16, 8192, "WIDTHxHEIGHT", "wants the pictures' width and height, such as 1920x1200"},
      "of the pictures, where the files do not say");
  word(command, "--unit-mm", args.unit_mm, "MM", "millimetres of one unit of T; default 1, of ROS files 1000")
      ->check(check_unit);
  word(command, "--note", args.note, "TEXT", "what the list shall say of it");
}

void add_export(CLI::App& command, CalibrationArgs& args) {
  word(command, "-o,--output", args.file, "PATH", "the file; for ros the folder")->required();
  CLI::Option* revision =
      command.add_option("revision", args.revision, "which; default the one in use")->check(check_revision);
  word(command, "--calibration", args.source, "FILE", "one of a file instead of the store's")
      ->excludes(revision);
  add_either(command, "--as", args.ros, "rig", "ros",
             "rig: one file as OpenCV writes it; ros: left.yaml and right.yaml (camera_info)")
      ->default_str("rig");
}

void add_board_words(CLI::App& command, BoardArgs& board, bool required) {
  auto* corners =
      add_two_numbers(command, "--corners", board.corners_across, board.corners_down,
                      {'x', 3, 3, 999, "10x7", "wants inner corners across and down, such as 10x7"},
                      "inner corners, across x down");
  auto* square =
      command.add_option("--square-mm", board.square_mm, "side of a square")->check(within(0.1, 1000));
  if (required) corners->required(), square->required();
  else
    corners->default_str(std::to_string(board.corners_across) + "x" + std::to_string(board.corners_down)),
        square->capture_default_str();
  command
      .add_option("--marker-mm", board.marker_mm,
                  "side of a ChArUco marker; default seven tenths of a square")
      ->check(within(0.03, 900));
  number(command, "--marker-bits", board.marker_bits, CLI::Range(4, 7), "of a ChArUco marker, a side");
}

CLI::Option* add_kind(CLI::App& command, const char* name, BoardArgs& board, const char* help) {
  return add_either(command, name, board.charuco, "chessboard", "charuco", help);
}

CLI::Option* add_live(CLI::App& command, CalibrateLiveArgs& args) {
  CLI::Option* live =
      command.add_flag("--live")->description("no folder: pairs as they come, with advice what to show next");
  word(command, "--board", args.cameras, "BOARD",
       "of --live; before sim a hand follows the advice; " + std::string(kDevices))
      ->needs(live);
  number(command, "--goal-mm", args.goal_mm, within(0.001, 100),
         "of --live: the depth error at 560 mm to reach, one standard deviation")
      ->needs(live);
  number(command, "--seed", args.seed, "of --live: another number, another simulated rig and hand")
      ->needs(live);
  return live;
}

// What is printed, and how well it is seen.
void add_simulated_board(CLI::App& command, SimulateArgs& args) {
  args.printed = {10, 7, 20};
  add_kind(command, "--pattern", args.printed, "what is printed on it")->default_str("chessboard");
  add_board_words(command, args.printed, false);
  number(command, "--blur-px", args.blur_px, within(0, 5), "of the lens, standard deviation");
  number(command, "--noise", args.noise, within(0, 20), "of the sensor, times the usual");
  const auto share = [&command](const char* name, double& value, const char* what) {
    number(command, name, value, within(0, 0.98), what);
  };
  share("--lamp", args.lamp, "share of the light lost from the board's left to its right");
  share("--shadow", args.shadow, "share of the light lost in a shadow over a third of it");
  share("--cover", args.cover, "share of its width that a hand covers");
  number(command, "--highlight", args.highlight, within(0, 20),
         "a lamp's mirror image, in units of white paper");
}

// Of `relievo simulate photograph`, what no other scene has.
void add_held_picture(CLI::App& command, HeldPictureArgs& args) {
  word(command, "picture", args.picture, "PICTURE", "what is held: a photograph of a face, PNG or JPEG")
      ->required();
  number(command, "--width-mm", args.width_mm, "of the picture as it is held; its height follows");
  number(command, "--radius-mm", args.radius_mm,
         "bent: 30 or more towards the cameras, -30 or less away; 0 flat");
  number(command, "--axis", args.axis_deg, "of the bend: 0 as on a column, 90 as on a lying roll, degrees");
  number(command, "--apex-mm", args.apex_mm, "bent to a cone with its apex this far away; 0 a roll");
  number(command, "--wave-mm", args.wave_mm, "bent to and fro, a wave this long; 0 one way");
  number(command, "--gloss", args.gloss, "share of the lamps' light that it mirrors: 0 matt, 0.04 glass");
  command.add_flag("--screen", args.screen, "it shines by itself");
}

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

void add_calibrate(CLI::App& app, CommandArgs& chosen, CalibrateArgs& args, CalibrateLiveArgs& live_args) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "calibrate the rig from pictures of a printed board, or make that board");
  CLI::Option* pictures =
      word(*command, "pictures", args.pictures, "DIR", "folder with left* and right* pictures");
  add_board_words(*command, args.board, true);
  add_kind(*command, "--pattern", args.board, "what is printed on it")->default_str("chessboard");
  word(*command, "-o,--output", args.output, "rig.yml", "the calibration, or the page")->required();
  word(*command, "--report", args.report, "DIR", "a page about it, index.html, with pictures");
  command
      ->add_option(
          "--baseline-mm", args.baseline_mm,
          "known distance of the cameras, to notice a wrong square size; 0: unknown; default with --store: that of the "
          "calibration in use")
      ->check(within(0, 10000));
  add_store(*command, args.store);
  CLI::Option* print = add_kind(*command, "--print-pattern", args.board,
                                "no pictures: a page with the board, as PDF or SVG, to print at 100 %");
  for (const char* other : {"pictures", "--pattern", "--report", "--baseline-mm", "--store"})
    print->excludes(command->get_option(other));
  CLI::Option* live = add_live(*command, live_args);
  for (CLI::Option* other : {pictures, print, command->get_option("--report")}) live->excludes(other);
  command->callback([&args, &live_args, &chosen, pictures, print, live] {
    if (print->count() > 0) {
      chosen = PrintPatternArgs{args.board, args.output};
      return;
    }
    if (live->count() > 0) {
      if (live_args.cameras.empty()) throw CLI::RequiredError("--live: --board");
      live_args.board = args.board;
      live_args.output = args.output;
      live_args.store = args.store;
      live_args.baseline_mm = args.baseline_mm;
      chosen = live_args;
      return;
    }
    if (pictures->count() == 0) throw CLI::RequiredError("DIR with pictures");
    chosen = args;
  });
}

void add_calibration(CLI::App& app, CommandArgs& chosen, CalibrationArgs& args) {
  CLI::App* command = app.add_subcommand("calibration", "the calibrations in the store");
  command->require_subcommand(1);
  const auto verb = [&](const char* name, const char* help, Verb which) -> CLI::App& {
    return add_verb(*command, name, help, args, which, chosen);
  };
  verb("list", "every calibration, the newest last, and how good it was found", Verb::List);
  verb("show", "the numbers of one", Verb::Show)
      .add_option("revision", args.revision, "which; default the one in use")
      ->check(check_revision);
  verb("activate", "use an older one again", Verb::Activate)
      .add_option("revision", args.revision)
      ->required()
      ->check(check_revision);
  add_import(verb("import", "take one from a file, or two, into the store", Verb::Import), args);
  add_export(verb("export", "write one to a file, or two", Verb::Export), args);
}

void add_simulate(CLI::App& app, CommandArgs& chosen, SimulateArgs& args) {
  CLI::App* command = app.add_subcommand("simulate", "photograph with the simulated rig");
  command->require_subcommand(1);
  CLI::App* face = command->add_subcommand("face", "a face made of a seed");
  CLI::App* visit = command->add_subcommand(
      "visit",
      "a face that turns about its neck: front, 25 and 45 degrees to both sides, 15 down, a folder each");
  number(*visit, "--drift", args.drift, within(0, 3),
         "how much lips, jaw and lids move between the pairs; 1: the jaw by up to 0.8 mm");
  visit
      ->add_option("--cast", args.cast,
                   "a rigid cast of the person instead, its eyes painted open, or closed")
      ->check(CLI::IsMember({"open", "closed"}));
  CLI::App* held =
      command->add_subcommand("photograph", "a picture held before the cameras, printed or on a screen");
  add_held_picture(*held, args.held);
  for (CLI::App* sub :
       {command->add_subcommand("board", "a printed board in many poses, or in the one that is given"), face,
        visit, held}) {
    const bool board = sub != face && sub != visit && sub != held;
    if (board) add_simulated_board(*sub, args);
    word(*sub, "-o,--output", args.output, "DIR", "folder for left*.png, right*.png and the true rig.yml")
        ->required();
    number(*sub, "--seed", args.seed, "another number, another face, other poses");
    if (board) number(*sub, "--pairs", args.pairs, CLI::Range(1, 1000), "how many");
    number(*sub, "--scale", args.scale, within(0.1, 1), "size of the pictures");
    sub->add_flag("--portrait", args.portrait, "cameras turned upright: pictures higher than wide");
    const auto pose = [&args, sub](const char* name, double& value, double least, double most,
                                   const char* what) {
      number(*sub, name, value, within(least, most), what)->each([&args](const std::string&) {
        args.one_pose = true;
      });
    };
    pose("--yaw", args.yaw_deg, -60, 60, "turn about the upright axis, degrees");
    pose("--pitch", args.pitch_deg, -45, 45, "nod, degrees");
    pose("--roll", args.roll_deg, -60, 60, "lean, degrees");
    pose("--distance", args.distance_mm, 250, 2000, "from the left camera to the middle, mm");
    pose("--right", args.right_mm, -500, 500, "to the side, mm");
    pose("--down", args.down_mm, -500, 500, "downwards, mm");
    if (sub == face || sub == visit)
      sub->add_flag("--truth", args.truth, "also write the true surface, for 'relievo compare'");
    sub->callback([&args, &chosen, board, is_visit = sub == visit] {
      args.board = board;
      args.visit = is_visit;
      chosen = args;
    });
  }
}

void add_selftest(CLI::App& app, CommandArgs& chosen, SelfTestArgs& args) {
  CLI::App* command = app.add_subcommand("selftest", "is everything in place?");
  add_store(*command, args.store);
  CLI::Option* optical =
      command->add_flag("--optical", args.optical,
                        "measure known spheres and plates through the whole chain instead (a minute)");
  word(*command, "-o,--output", args.output, "DIR", "folder for the report and a picture of every target")
      ->needs(optical);
  number(*command, "--seed", args.seed, "another rig, other noise")->needs(optical);
  number(*command, "--scale", args.scale, within(0.5, 1),
         "size of the pictures; the limits grow as their pixels do")
      ->needs(optical);
  command->callback([&] { chosen = args; });
}

CLI::App* add_compare(CLI::App& app, CommandArgs& chosen, CompareArgs& args) {
  CLI::App* command = app.add_subcommand(
      "compare", "sets of algorithms beside each other, on one pair or many: a page and its figures");
  word(*command, "pictures", args.pictures, "LEFT RIGHT",
       "left, right, left, right, ...; none is needed for --suite dissertation");
  const auto each = [command](const char* name, std::vector<Path>& to, const char* help, const char* type) {
    return word(*command, name, to, type, help)->take_all()->allow_extra_args(false);
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
  number(*command, "--truth-scale", args.truth_scale, within(0.001, 65535),
         "of a PNG: grey values per pixel of disparity");
  number(*command, "--bad-px", args.limit_px, within(0.01, 1000), "a disparity off by more is bad");
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
