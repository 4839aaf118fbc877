// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo algorithms`: what may be chosen, from the description that choices are read by.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/output_folder.h"
#include "firmware/command/commands.h"
#include "firmware/jobs/job_thread.h"
#include "pipeline/algorithms.h"

namespace relievo::firmware {
namespace {

using Options = std::vector<pipeline::OptionDescription>;

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size() + 1), ' ');
  return text;
}

bool say_options(const Options& all, std::string_view section, Console& console) {
  bool any = false;
  for (const auto& option : all) {
    if (!option.is_option() || option.key.substr(0, option.key.find('.')) != section) continue;
    console.say("  " + padded(option.key + " = " + option.value, 36) +
                padded(option.file   ? "a file"
                       : option.text ? "text"
                                     : option.range.possible(),
                       18) +
                option.sentence);
    any = true;
  }
  return any;
}

bool say_algorithms(const Options& all, std::string_view name, Console& console) {
  bool any = false;
  for (const auto& kind : all)
    for (const auto& algorithm : kind.algorithms) {
      if (algorithm.name != name) continue;
      console.say(kind.key + " = " + algorithm.name + (kind.value == name ? " (the default)" : "") + ": " +
                  algorithm.sentence);
      console.say("  source: " + std::string(algorithm.source));
      any = true;
    }
  return any;
}

bool say_kind(const Options& all, std::string_view key, Console& console) {
  const auto kind = std::ranges::find_if(
      all, [key](const auto& option) { return !option.is_option() && option.key == key; });
  if (kind == all.end()) return false;
  console.say(kind->key + ": " + kind->sentence + "; default " + kind->value);
  for (const auto& algorithm : kind->algorithms)
    console.say("  " + padded(algorithm.name, 22) + algorithm.sentence + " [" + algorithm.source + "]");
  return true;
}

void say_overview(const Options& all, Console& console) {
  for (const auto& option : all)
    if (say_kind(all, option.key, console)) console.say("");
  console.say(
      "Choose with --set KIND=NAME, set with --set NAME.OPTION=VALUE; 'relievo algorithms NAME' lists a "
      "NAME's options,");
  console.say("'relievo algorithms face' those of the part of the surface that is kept, whatever is chosen.");
}

}  // namespace

Result<void> run(const AlgorithmsArgs& args, Services& services) {
  const Options all = pipeline::describe_algorithms();
  if (args.name.empty()) {
    say_overview(all, services.console);
    return {};
  }
  // A word may be a kind, an algorithm of two kinds, or only settings.
  const bool kind = say_kind(all, args.name, services.console);
  const bool algorithm = say_algorithms(all, args.name, services.console);
  const bool options = say_options(all, args.name, services.console);
  if (kind || algorithm || options) return {};
  return Error{Errc::NotFound, "no such kind or algorithm: 'relievo algorithms' lists them"}.at(args.name);
}

Result<void> run(const SimulateArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  FunctionJob job([&](JobControl& control) -> Result<void> {
    RELIEVO_TRY(services.simulate(args, folder.path()));
    if (control.cancelled.load()) return Error{Errc::Cancelled, "the pictures were no longer wanted"};
    return {};
  });
  if (const auto done = run_watched(job, services.console, [] { return "Simulate"; }); !done) {
    if (!args.held.picture.empty() && done.error().where() == args.held.picture.native()) return done.error();
    return done.error().at(args.output.string());  // not where the files lie for the moment
  }
  RELIEVO_TRY(folder.commit());
  services.console.say("pictures: " + args.output.string());
  return {};
}

}  // namespace relievo::firmware
