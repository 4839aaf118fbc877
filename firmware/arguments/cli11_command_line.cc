// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <system_error>
#include <tuple>

#include "firmware/arguments/command_words.h"

namespace relievo::firmware {

std::string check_not_empty(const std::string& word) {
  return word.empty() ? "wants a name, and was given an empty word" : "";
}

void add_store(CLI::App& command, Path& store) {
  word(command, "--store", store, "DIR", "folder of the store");
  command.add_option(kKeyOption, "file with the store's key, if it does not lie beside the store")
      ->type_name("FILE")
      ->check(check_not_empty);
}

CLI::Option* add_two_numbers(CLI::App& command, const char* name, int& first, int& second,
                             const TwoNumbersRule& rule, const char* help) {
  return command
      .add_option_function<std::string>(
          name,
          [&first, &second, name, rule](const std::string& text) {
            int one = 0, other = 0;
            const char* const end = text.data() + text.size();
            const auto [at, bad_one] = std::from_chars(text.data(), end, one);
            const bool two = bad_one == std::errc() && at != end && *at == rule.between;
            const auto [rest, bad_other] = std::from_chars(two ? at + 1 : end, end, other);
            if (bad_other != std::errc() || rest != end || one < rule.least_first ||
                other < rule.least_second || std::max(one, other) > rule.most ||
                (rule.rising && one >= other))
              throw CLI::ValidationError(name, rule.wants + (", not " + text));
            first = one, second = other;
          },
          help)
      ->type_name(rule.type);
}

CLI::Option* add_either(CLI::App& command, const char* name, bool& second, const char* one, const char* other,
                        const char* help) {
  return command
      .add_option_function<std::string>(
          name, [&second, other](const std::string& word) { second = word == other; }, help)
      ->check(CLI::IsMember({one, other}));
}

namespace {

// The words before any command.
void add_kiosk(CLI::App& app, KioskArgs& args) {
  app.add_option("--board", args.device, "the kiosk's cameras: " + std::string(kDevices))
      ->type_name("BOARD")
      ->capture_default_str();
  word(app, "--calibration", args.calibration, "rig.yml",
       "default: the one in the store; of the simulated rig, its own");
  add_store(app, args.store);
  add_two_numbers(app, "--windowed", args.width_px, args.height_px,
                  {'x', 640, 480, 1 << 20, "WxH", "wants a size such as 1280x800, of 640x480 or more"},
                  "a window instead of the whole screen");
  word(app, "--screenshots", args.screenshots, "DIR", "pictures of all screens in all languages, as files");
  word(app, "--script", args.script, "FILE",
       "a visit by synthetic fingers, and what it cost; its pictures go to --screenshots");
  word(
      app, "--only", args.only, "TEXT",
      "of those, the sheets with this in their name, as 1280x800_100_de; behind a slash, the pages with this in theirs: 1280x800_100_de/thanks");
  app.add_flag_function(
      "--tell-nobody", [&args](std::int64_t) { args.tells_known = false; },
      "who types a name is not told that it is in the records already");
  app.add_flag("--showpiece", args.write_invitation_head,
               "with --screenshots: only the head of the page that invites")
      ->group("");
}

void add_algorithms(CLI::App& command, AlgorithmArgs& args) {
  word(command, "--algorithms", args.file, "FILE.toml", "choice and settings of the algorithms");
  word(command, "--set", args.settings, "KEY=VALUE",
       "one choice or setting, as in the file: matcher=zmncc, zmncc.window_px=15 (relievo algorithms)")
      ->take_all()
      ->allow_extra_args(false);
  add_either(command, "--region", args.whole_view, "face", "all", "what to reconstruct")->default_str("face");
}

void add_further(CLI::App& command, FurtherModels& further) {
  word(command, "--lod", further.lod, "TRIANGLES", "a lighter model beside it, light.*, of so many triangles")
      ->check(CLI::Range(100, 10'000'000));
  command.add_flag(
      "--watertight", further.watertight,
      "a solid for printing beside it, solid.*: closed by a usual person's head, cut flat at the neck");
}

void add_reconstruct(CLI::App& app, CommandArgs& chosen, ReconstructArgs& args) {
  CLI::App* command = app.add_subcommand(
      "reconstruct", "a pair of pictures to a textured model, or several of a head that turned");
  word(*command, "pictures", args.pictures, "LEFT RIGHT",
       "LEFT RIGHT, or the folder of a recording alone, or LEFT RIGHT and further pairs of the same head "
       "turned to other sides, up to seven; the first is the one from in front");
  word(*command, "--calibration", args.calibrations, "rig.yml", "one for all pairs, or one each");
  CLI::Option* load = word(*command, "--load", args.load, "FILE",
                           "no pictures: a saved reconstruction, with its calibration and settings");
  command
      ->add_option("--from", args.from,
                   "of a saved one: the first stage to be done again; default: the first that --set changes")
      ->check(CLI::IsMember({"match", "reconstruct", "mesh", "texture", "assemble"}))
      ->needs(load);
  word(
      *command, "--save", args.save, "FILE",
      "save all of it in one file: pictures, calibration, settings, every stage. It holds the person's face: keep it as you keep that");
  word(
      *command, "--by-hand", args.by_hand, "FILE",
      "matches made by hand, beside the matcher's: a line each, x y disparity [sigma], pixels of the rectified views; with --load in place of those that were saved");
  word(*command, "-o,--output", args.output, "DIR", "folder for the model and the report")->required();
  add_either(*command, "--frame", args.camera_frame, "head", "camera", "axes of the model")
      ->default_str("head");
  command->add_flag("--despite-drift", args.despite_drift,
                    "go on though the cameras have moved since they were calibrated");
  add_further(*command, args.further);
  add_algorithms(*command, args.algorithms);
  const char* const instead[] = {"pictures", "--calibration"};
  for (const char* other : instead) load->excludes(command->get_option(other));
  load->excludes(command->get_option("--region"));
  command->callback([&chosen, &args, command, load] {
    if (load->count() == 0 && args.calibrations.empty()) throw CLI::RequiredError("--calibration");
    // Pictures after --calibration look like further calibrations: the first of them is the only one.
    if (args.pictures.empty() && args.calibrations.size() > 1) {
      args.pictures.assign(args.calibrations.begin() + 1, args.calibrations.end());
      args.calibrations.resize(1);
    }
    if (load->count() == 0 && args.pictures.empty()) throw CLI::RequiredError("pictures");
    const std::size_t pairs = args.pictures.size() / 2;
    std::error_code error;
    const bool recording =
        args.pictures.size() == 1 && std::filesystem::is_directory(args.pictures[0], error);
    if (args.pictures.size() % 2 != 0 && !recording)
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

void add_memory(CLI::App& app, CommandArgs& chosen, MemoryArgs& args) {
  CLI::App* command =
      app.add_subcommand("memory", "the memory plan; with --store also what its kiosk's last visits took");
  add_store(*command, args.store);
  command->callback([&] { chosen = args; });
}

void add_enrol(CLI::App& app, CommandArgs& chosen, EnrolArgs& args) {
  CLI::App* command = app.add_subcommand("enrol", "one whole enrolment without a screen");
  word(*command, "--board", args.device, "BOARD", kDevices)->required();
  word(*command, "--subject", args.subject, "NAME", "who it is")->required();
  word(*command, "--calibration", args.calibration, "rig.yml",
       "default: the one in the store; of the simulated rig, its own");
  add_store(*command, args.store);
  add_algorithms(*command, args.algorithms);
  command->callback([&] { chosen = args; });
}

void add_subjects(CLI::App& app, CommandArgs& chosen, SubjectsArgs& args) {
  CLI::App* command = app.add_subcommand("subjects", "the people in the store");
  command->require_subcommand(1);
  using Verb = SubjectsArgs::Verb;
  const auto verb = [&](const char* name, const char* help, Verb which) {
    CLI::App* sub = &add_verb(*command, name, help, args, which, chosen);
    if (which != Verb::List && which != Verb::Import)
      sub->add_option("subject", args.subject)->required()->type_name("NAME")->check(check_not_empty);
    return sub;
  };
  verb("list", "everyone, one a line", Verb::List);
  verb("show", "the enrolments of one", Verb::Show);
  CLI::App* exported = verb("export", "the newest model of one as files", Verb::Export);
  word(*exported, "-o,--output", args.output, "DIR", "")->required();
  add_further(*exported, args.further);
  CLI::Option* to =
      word(*exported, "--to", args.recipient, "age1...", "one file instead, sealed to this recipient of age")
          ->check(check_not_empty);
  CLI::Option* by = word(*exported, "--passphrase-file", args.passphrase, "FILE",
                         "one file instead, sealed by the passphrase that stands in this one")
                        ->excludes(to);
  for (const char* folder_only : {"--lod", "--watertight"})
    for (CLI::Option* sealed : {to, by}) sealed->excludes(exported->get_option(folder_only));
  CLI::App* imported = verb("import", "takes in somebody whom another store exported", Verb::Import);
  word(*imported, "copy", args.copy, "FILE",
       "what the export made: a folder, one sealed file, or the tar that was in it")
      ->required();
  CLI::Option* identity = word(*imported, "--identity", args.identity, "FILE",
                               "the key it was sealed to, as age-keygen makes it");
  word(*imported, "--passphrase-file", args.passphrase, "FILE", "or where the passphrase stands")
      ->excludes(identity);
  word(*imported, "--signed-by", args.signer, "KEY",
       "believe this key; 'store check' names it where the copy was made");
  imported->add_flag("--same-name", args.same_name, "this is somebody else than the one who has the name");
  verb("erase", "one and everything known about them", Verb::Erase);
}

void add_staff(CLI::App& app, CommandArgs& chosen, StaffArgs& args) {
  CLI::App* command = app.add_subcommand(
      "staff",
      "a PIN that was forgotten, a touch screen that nobody can use any more; while the kiosk is stopped");
  command->require_subcommand(1);
  const auto verb = [&](const char* name, const char* help, StaffArgs::Verb which) {
    return &add_verb(*command, name, help, args, which, chosen);
  };
  CLI::App* forget = verb("forget-pin", "one role chooses its PIN anew at the next start; the other's stays",
                          StaffArgs::Verb::ForgetPin);
  forget
      ->add_option_function<std::string>(
          "role", [&args](const std::string& word) { args.technician = word == "technician"; }, "whose")
      ->required()
      ->type_name("ROLE")
      ->check(CLI::IsMember({"technician", "operator"}));
  verb("plain-touch", "the touch screen is taken as it is, without a correction",
       StaffArgs::Verb::PlainTouch);
}

void add_store_keeping(CLI::App& app, CommandArgs& chosen, StoreArgs& args) {
  CLI::App* command = app.add_subcommand("store", "the store as a whole: check, log, copy, keys");
  command->require_subcommand(1);
  const auto verb = [&](const char* name, const char* help, StoreArgs::Verb which) {
    return &add_verb(*command, name, help, args, which, chosen);
  };
  word(*verb("check", "every page, model and line of the log", StoreArgs::Verb::Check), "--backup", args.file,
       "FILE", "a copy of this store: who in it has been erased since?");
  verb("log",
       "every line of the audit log: number, time, what, of whom; 'store check' tells whether it is whole",
       StoreArgs::Verb::Log);
  word(*verb("backup", "a copy, sealed as the store is; the key is not in it", StoreArgs::Verb::Backup),
       "file", args.file, "FILE", "where to")
      ->required();
  CLI::App* rekey = verb("rekey", "new keys; copies made before keep the old ones", StoreArgs::Verb::Rekey);
  CLI::Option* to_file = word(*rekey, "--new-key", args.file, "FILE", "the key moves to this file");
  rekey->add_flag("--tpm", args.tpm, "the key moves beside the store, sealed by this board's TPM")
      ->excludes(to_file);
  verb("recovery-words",
       "draws the twelve words that open the store when its key is lost, and prints them once",
       StoreArgs::Verb::RecoveryWords);
  verb("recover", "reads the twelve words from standard input and makes a new key", StoreArgs::Verb::Recover);
}

void add_algorithm_list(CLI::App& app, CommandArgs& chosen, AlgorithmsArgs& args) {
  CLI::App* command = app.add_subcommand(
      "algorithms", "what --set and --algorithms may choose: kinds, names, options, sources");
  word(*command, "name", args.name, "NAME",
       "of a kind or an algorithm: only that, with its options, defaults and ranges");
  command->callback([&] { chosen = args; });
}

// One of each command's, to be filled.
template <typename... Args>
std::tuple<Args...> one_of_each(const std::variant<Args...>&);
using AllArgs = decltype(one_of_each(CommandArgs()));

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Relievo: two cameras, one face, a textured 3D model.", "relievo");
  app.require_subcommand(0, 1);
  CommandLine line;
  AllArgs args;
  add_kiosk(app, std::get<KioskArgs>(args));
  add_calibrate(app, line.command, std::get<CalibrateArgs>(args), std::get<CalibrateLiveArgs>(args));
  add_calibration(app, line.command, std::get<CalibrationArgs>(args));
  add_reconstruct(app, line.command, std::get<ReconstructArgs>(args));
  add_algorithms(*add_compare(app, line.command, std::get<CompareArgs>(args)),
                 std::get<CompareArgs>(args).algorithms);
  add_enrol(app, line.command, std::get<EnrolArgs>(args));
  add_subjects(app, line.command, std::get<SubjectsArgs>(args));
  add_staff(app, line.command, std::get<StaffArgs>(args));
  add_store_keeping(app, line.command, std::get<StoreArgs>(args));
  add_simulate(app, line.command, std::get<SimulateArgs>(args));
  add_selftest(app, line.command, std::get<SelfTestArgs>(args));
  add_algorithm_list(app, line.command, std::get<AlgorithmsArgs>(args));
  add_memory(app, line.command, std::get<MemoryArgs>(args));
  app.add_subcommand("version", "what this is")->callback([&] { line.command = VersionArgs{}; });
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) line.command = std::get<KioskArgs>(args);
    for (const CLI::Option* option : app.get_options())  // else it would go to another store than was said
      if (!app.get_subcommands().empty() && option->count() > 0)
        throw CLI::ValidationError(option->get_name(), "is the kiosk's here: write it behind the command");
    const CLI::App* innermost = &app;
    while (!innermost->get_subcommands().empty()) innermost = innermost->get_subcommands().front();
    if (innermost != &app && std::holds_alternative<NothingArgs>(line.command))
      throw CLI::ValidationError(innermost->get_name(), "does nothing: its callback chooses no command");
    const CLI::Option* key = innermost->get_option_no_throw(kKeyOption);
    if (key != nullptr && key->count() > 0) line.key = key->as<std::string>();
  } catch (const CLI::CallForHelp&) {
    const std::string help = app.help();  // of the innermost command that was named
    line.command = NothingArgs{};
    if (std::printf("%s", help.c_str()) < 0 || std::fflush(stdout) != 0) {
      std::fprintf(stderr, "relievo: standard output: the help could not be written there\n");
      line.exit_code = 1;
    }
  } catch (const CLI::ParseError& error) {
    std::string what = error.what();
    std::ranges::replace(what, '\n', ' ');
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
