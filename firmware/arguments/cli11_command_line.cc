// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "firmware/arguments/command_line.h"
#include "firmware/arguments/command_words.h"
#include "firmware/arguments/two_numbers.h"

namespace relievo::firmware {
namespace {

// CLI::Range lets "nan" through.
CLI::Validator within(double least, double most) {
  std::ostringstream words;
  words << least << " to " << most;
  return CLI::Validator(
      [least, most, text = words.str()](std::string& word) {
        const double number = std::strtod(word.c_str(), nullptr);
        return number >= least && number <= most ? std::string()
                                                 : "wants a number from " + text + ", not " + word;
      },
      words.str());
}

// "10x7", 3 to 999 each.
bool corner_counts(const std::string& text, int& across, int& down) {
  const auto counts = two_numbers(text, 'x');
  if (!counts || std::min(counts->first, counts->second) < 3 || std::max(counts->first, counts->second) > 999)
    return false;
  across = counts->first, down = counts->second;
  return true;
}

void add_algorithms(CLI::App& command, AlgorithmArgs& args) {
  command.add_option("--algorithms", args.file, "choice and settings of the algorithms")
      ->type_name("FILE.toml");
  command
      .add_option(
          "--set", args.settings,
          "one choice or setting, as in the file: matcher=zmncc, zmncc.window_px=15 (relievo algorithms)")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--region", [&args](const std::string& word) { args.whole_view = word == "all"; },
          "what to reconstruct")
      ->check(CLI::IsMember({"face", "all"}))
      ->default_str("face");
}

void add_board_words(CLI::App& command, BoardArgs& board, bool required) {
  auto* corners = command
                      .add_option_function<std::string>(
                          "--corners",
                          [&board](const std::string& text) {
                            if (!corner_counts(text, board.corners_across, board.corners_down)) {
                              throw CLI::ValidationError("--corners",
                                                         "wants inner corners across and down, such as 10x7");
                            }
                          },
                          "inner corners, across x down")
                      ->type_name("10x7");
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
  command.add_option("--marker-bits", board.marker_bits, "of a ChArUco marker, a side")
      ->check(CLI::Range(4, 7))
      ->capture_default_str();
}

CLI::Option* add_kind(CLI::App& command, const char* name, BoardArgs& board, const char* help) {
  return command
      .add_option_function<std::string>(
          name, [&board](const std::string& word) { board.charuco = word == "charuco"; }, help)
      ->check(CLI::IsMember({"chessboard", "charuco"}));
}

CLI::Option* add_live(CLI::App& command, CalibrateLiveArgs& args) {
  CLI::Option* live =
      command.add_flag("--live")->description("no folder: pairs as they come, with advice what to show next");
  command
      .add_option("--board", args.cameras,
                  "of --live; before sim a hand follows the advice; " + std::string(kDevices))
      ->type_name("BOARD")
      ->needs(live);
  command
      .add_option("--goal-mm", args.goal_mm,
                  "of --live: the depth error at 560 mm to reach, one standard deviation")
      ->check(within(0.001, 100))
      ->capture_default_str()
      ->needs(live);
  command.add_option("--seed", args.seed, "of --live: another number, another simulated rig and hand")
      ->capture_default_str()
      ->needs(live);
  return live;
}

void add_calibrate(CLI::App& app, CommandArgs& chosen, CalibrateArgs& args, CalibrateLiveArgs& live_args) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "calibrate the rig from pictures of a printed board, or make that board");
  CLI::Option* pictures =
      command->add_option("pictures", args.pictures, "folder with left* and right* pictures")
          ->type_name("DIR");
  add_board_words(*command, args.board, true);
  add_kind(*command, "--pattern", args.board, "what is printed on it")->default_str("chessboard");
  command->add_option("-o,--output", args.output, "the calibration, or the page")
      ->required()
      ->type_name("rig.yml");
  command->add_option("--report", args.report, "a page about it, index.html, with pictures")
      ->type_name("DIR");
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

void add_further(CLI::App& command, FurtherModels& further) {
  command.add_option("--lod", further.lod, "a lighter model beside it, light.*, of so many triangles")
      ->type_name("TRIANGLES")
      ->check(CLI::Range(100, 10'000'000));
  command.add_flag(
      "--watertight", further.watertight,
      "a solid for printing beside it, solid.*: closed by a usual person's head, cut flat at the neck");
}

void add_reconstruct(CLI::App& app, CommandArgs& chosen, ReconstructArgs& args) {
  CLI::App* command = app.add_subcommand(
      "reconstruct", "a pair of pictures to a textured model, or several of a head that turned");
  command
      ->add_option(
          "pictures", args.pictures,
          "LEFT RIGHT, and further pairs of the same head turned to other sides, up to seven; the first is the "
          "one from in front")
      ->type_name("LEFT RIGHT");
  command->add_option("--calibration", args.calibrations, "one for all pairs, or one each")
      ->type_name("rig.yml");
  CLI::Option* load =
      command
          ->add_option("--load", args.load,
                       "no pictures: a saved reconstruction, with its calibration and settings")
          ->type_name("FILE");
  command
      ->add_option("--from", args.from,
                   "of a saved one: the first stage to be done again; default: the first that --set changes")
      ->check(CLI::IsMember({"match", "reconstruct", "mesh", "texture", "assemble"}))
      ->needs(load);
  command
      ->add_option(
          "--save", args.save,
          "save all of it in one file: pictures, calibration, settings, every stage. It holds the person's face: keep it as you keep that")
      ->type_name("FILE");
  command
      ->add_option(
          "--by-hand", args.by_hand,
          "matches made by hand, beside the matcher's: a line each, x y disparity [sigma], pixels of the rectified views; with --load in place of those that were saved")
      ->type_name("FILE");
  command->add_option("-o,--output", args.output, "folder for the model and the report")
      ->required()
      ->type_name("DIR");
  command
      ->add_option_function<std::string>(
          "--frame", [&args](const std::string& word) { args.camera_frame = word == "camera"; },
          "axes of the model")
      ->check(CLI::IsMember({"head", "camera"}))
      ->default_str("head");
  command->add_flag("--despite-drift", args.despite_drift,
                    "go on though the cameras have moved since they were calibrated");
  add_further(*command, args.further);
  add_algorithms(*command, args.algorithms);
  const char* const instead[] = {"pictures", "--calibration"};
  for (const char* other : instead) load->excludes(command->get_option(other));
  load->excludes(command->get_option("--region"));
  command->callback([&chosen, &args, command, load, instead] {
    if (load->count() == 0 && args.calibrations.empty()) throw CLI::RequiredError("--calibration");
    // Pictures after --calibration look like further calibrations: the first of them is the only one.
    if (args.pictures.empty() && args.calibrations.size() > 1) {
      args.pictures.assign(args.calibrations.begin() + 1, args.calibrations.end());
      args.calibrations.resize(1);
    }
    if (load->count() == 0 && args.pictures.empty()) throw CLI::RequiredError("pictures");
    const std::size_t pairs = args.pictures.size() / 2;
    if (args.pictures.size() % 2 != 0)
      throw CLI::ValidationError("pictures", "a left one and a right one each");
    if (pairs > kMostPairs) throw CLI::ValidationError("pictures", "seven pairs make a head; these are more");
    if (load->count() == 0 && args.calibrations.size() != 1 && args.calibrations.size() != pairs)
      throw CLI::ValidationError("--calibration", "one for all pairs, or one each");
    if (pairs > 1)
      for (const char* other : {"--save", "--by-hand", "--region"})
        if (command->get_option(other)->count() > 0)
          throw CLI::ValidationError(other, "of one pair alone, not of a head from several");
    chosen = args;
  });
}

void add_enrol(CLI::App& app, CommandArgs& chosen, EnrolArgs& args) {
  CLI::App* command = app.add_subcommand("enrol", "one whole enrolment without a screen");
  command->add_option("--board", args.device, kDevices)->required()->type_name("BOARD");
  command->add_option("--subject", args.subject, "who it is")->required()->type_name("NAME");
  command
      ->add_option("--calibration", args.calibration,
                   "default: the one in the store; of the simulated rig, its own")
      ->type_name("rig.yml");
  add_store(*command, args.store);
  add_algorithms(*command, args.algorithms);
  command->callback([&] { chosen = args; });
}

void add_subjects(CLI::App& app, CommandArgs& chosen, SubjectsArgs& args) {
  CLI::App* command = app.add_subcommand("subjects", "the people in the store");
  command->require_subcommand(1);
  using Verb = SubjectsArgs::Verb;
  const auto verb = [&](const char* name, const char* help, Verb which) {
    CLI::App* sub = command->add_subcommand(name, help);
    add_store(*sub, args.store);
    if (which != Verb::List) sub->add_option("subject", args.subject)->required()->type_name("NAME");
    sub->callback([&args, &chosen, which] {
      args.verb = which;
      chosen = args;
    });
    return sub;
  };
  verb("list", "everyone, one a line", Verb::List);
  verb("show", "the enrolments of one", Verb::Show);
  CLI::App* exported = verb("export", "the newest model of one as files", Verb::Export);
  exported->add_option("-o,--output", args.output)->required()->type_name("DIR");
  add_further(*exported, args.further);
  verb("erase", "one and everything known about them", Verb::Erase);
}

// What is printed, and how well it is seen.
void add_simulated_board(CLI::App& command, SimulateArgs& args) {
  args.printed = {10, 7, 20};
  add_kind(command, "--pattern", args.printed, "what is printed on it")->default_str("chessboard");
  add_board_words(command, args.printed, false);
  command.add_option("--blur-px", args.blur_px, "of the lens, standard deviation")
      ->check(within(0, 5))
      ->capture_default_str();
  command.add_option("--noise", args.noise, "of the sensor, times the usual")
      ->check(within(0, 20))
      ->capture_default_str();
  const auto share = [&command](const char* name, double& value, const char* what) {
    command.add_option(name, value, what)->check(within(0, 0.98))->capture_default_str();
  };
  share("--lamp", args.lamp, "share of the light lost from the board's left to its right");
  share("--shadow", args.shadow, "share of the light lost in a shadow over a third of it");
  share("--cover", args.cover, "share of its width that a hand covers");
  command.add_option("--highlight", args.highlight, "a lamp's mirror image, in units of white paper")
      ->check(within(0, 20))
      ->capture_default_str();
}

void add_simulate(CLI::App& app, CommandArgs& chosen, SimulateArgs& args) {
  CLI::App* command = app.add_subcommand("simulate", "photograph with the simulated rig");
  command->require_subcommand(1);
  CLI::App* face = command->add_subcommand("face", "a face made of a seed");
  CLI::App* held =
      command->add_subcommand("photograph", "a picture held before the cameras, printed or on a screen");
  add_held_picture(*held, args.held);
  for (CLI::App* sub :
       {command->add_subcommand("board", "a printed board in many poses, or in the one that is given"), face,
        held}) {
    const bool board = sub != face && sub != held;
    if (board) add_simulated_board(*sub, args);
    sub->add_option("-o,--output", args.output, "folder for left*.png, right*.png and the true rig.yml")
        ->required()
        ->type_name("DIR");
    sub->add_option("--seed", args.seed, "another number, another face, other poses")->capture_default_str();
    if (board)
      sub->add_option("--pairs", args.pairs, "how many")->check(CLI::Range(1, 1000))->capture_default_str();
    sub->add_option("--scale", args.scale, "size of the pictures")
        ->check(within(0.1, 1))
        ->capture_default_str();
    sub->add_flag("--portrait", args.portrait, "cameras turned upright: pictures higher than wide");
    const auto pose = [&args, sub](const char* name, double& value, double least, double most,
                                   const char* what) {
      sub->add_option(name, value, what)
          ->check(within(least, most))
          ->capture_default_str()
          ->each([&args](const std::string&) { args.one_pose = true; });
    };
    pose("--yaw", args.yaw_deg, -60, 60, "turn about the upright axis, degrees");
    pose("--pitch", args.pitch_deg, -45, 45, "nod, degrees");
    pose("--roll", args.roll_deg, -60, 60, "lean, degrees");
    pose("--distance", args.distance_mm, 250, 2000, "from the left camera to the middle, mm");
    pose("--right", args.right_mm, -500, 500, "to the side, mm");
    pose("--down", args.down_mm, -500, 500, "downwards, mm");
    if (sub == face)
      sub->add_flag("--truth", args.truth, "also write the true surface, for 'relievo compare'");
    sub->callback([&args, &chosen, board] {
      args.board = board;
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
  command->add_option("-o,--output", args.output, "folder for the report and a picture of every target")
      ->type_name("DIR")
      ->needs(optical);
  command->add_option("--seed", args.seed, "another rig, other noise")->capture_default_str()->needs(optical);
  command->add_option("--scale", args.scale, "size of the pictures; the limits grow as their pixels do")
      ->check(within(0.5, 1))
      ->capture_default_str()
      ->needs(optical);
  command->callback([&] { chosen = args; });
}

void add_algorithm_list(CLI::App& app, CommandArgs& chosen, AlgorithmsArgs& args) {
  CLI::App* command = app.add_subcommand(
      "algorithms", "what --set and --algorithms may choose: kinds, names, options, sources");
  command
      ->add_option("name", args.name,
                   "of a kind or an algorithm: only that, with its options, defaults and ranges")
      ->type_name("NAME");
  command->callback([&] { chosen = args; });
}

struct AllArgs {
  KioskArgs kiosk;
  CalibrateArgs calibrate;
  CalibrateLiveArgs calibrate_live;
  CalibrationArgs calibration;
  ReconstructArgs reconstruct;
  CompareArgs compare;
  EnrolArgs enrol;
  SubjectsArgs subjects;
  StaffArgs staff;
  StoreArgs store;
  SimulateArgs simulate;
  SelfTestArgs selftest;
  AlgorithmsArgs algorithms;
};

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Relievo: two cameras, one face, a textured 3D model.", "relievo");
  app.require_subcommand(0, 1);
  CommandLine line;
  AllArgs args;
  add_kiosk(app, args.kiosk);
  add_calibrate(app, line.command, args.calibrate, args.calibrate_live);
  add_calibration(app, line.command, args.calibration);
  add_reconstruct(app, line.command, args.reconstruct);
  add_algorithms(*add_compare(app, line.command, args.compare), args.compare.algorithms);
  add_enrol(app, line.command, args.enrol);
  add_subjects(app, line.command, args.subjects);
  add_staff(app, line.command, args.staff);
  add_store_keeping(app, line.command, args.store);
  add_simulate(app, line.command, args.simulate);
  add_selftest(app, line.command, args.selftest);
  add_algorithm_list(app, line.command, args.algorithms);
  app.add_subcommand("memory", "the memory plan")->callback([&] { line.command = MemoryArgs{}; });
  app.add_subcommand("version", "what this is")->callback([&] { line.command = VersionArgs{}; });
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) line.command = args.kiosk;
    const CLI::App* innermost = &app;
    while (!innermost->get_subcommands().empty()) innermost = innermost->get_subcommands().front();
    const CLI::Option* key = innermost->get_option_no_throw(kKeyOption);
    if (key != nullptr && key->count() > 0) line.key = key->as<std::string>();
  } catch (const CLI::CallForHelp&) {
    std::printf("%s", app.help().c_str());  // of the innermost command that was named
    line.command = NothingArgs{};
  } catch (const CLI::ParseError& error) {
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    std::string command = app.get_name();
    for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
      at = at->get_subcommands().front();
      command += " " + at->get_name();
    }
    std::fprintf(stderr, "relievo: %s (%s --help lists the words)\n", what.c_str(), command.c_str());
    line.command = NothingArgs{};
    line.exit_code = 2;
  }
  return line;
}

}  // namespace relievo::firmware
