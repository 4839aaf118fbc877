// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of the commands that cli11_command_line.cc does not hold itself: two files, since each pays five
// seconds for CLI11. What they fill must outlive the parsing; `args` of a command is copied into `chosen`
// when that command is met. Thread: main.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "firmware/arguments/command_line.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace relievo::firmware {

// What --board may be. The word on the command line and the file board.toml name the device (hal/device.h):
// they are kept because people type them and services name them.
inline constexpr const char* kDevices =
    "sim; folder:DIR with recorded pairs; linux, or linux:FILE that says what is wired where (default /etc/relievo/board.toml)";

// A complaint where a script's variable was empty: the word would mean another place, or none, than was asked
// for.
std::string check_not_empty(const std::string& word);

// An option of a word or several, `type` as its help calls them, a path never empty; and one of a number,
// within `range`, with its default. The templates know App no better than this header does.
template <typename App, typename Value>
auto* word(App& command, const char* name, Value& value, const char* type, const std::string& help) {
  auto* option = command.add_option(name, value, help)->type_name(type);
  if constexpr (std::is_same_v<Value, Path> || std::is_same_v<Value, std::vector<Path>>)
    option->check(check_not_empty);
  return option;
}
template <typename App, typename Value>
auto* number(App& command, const char* name, Value& value, const std::string& help) {
  return command.add_option(name, value, help)->capture_default_str();
}
template <typename App, typename Value, typename Range>
auto* number(App& command, const char* name, Value& value, const Range& range, const std::string& help) {
  return number(command, name, value, help)->check(range);
}

// Two whole numbers in one word, such as "1280x800": each from its least on, to `most`. `wants`: the
// complaint.
struct TwoNumbersRule {
  char between = 'x';
  int least_first = 0, least_second = 0, most = 0;
  const char *type = "", *wants = "";
  bool rising = false;  // the second is the larger
};
CLI::Option* add_two_numbers(CLI::App& command, const char* name, int& first, int& second,
                             const TwoNumbersRule& rule, const char* help);

// One of two words: is it the second?
CLI::Option* add_either(CLI::App& command, const char* name, bool& second, const char* one, const char* other,
                        const char* help);

inline constexpr const char* kKeyOption = "--key";
void add_store(CLI::App& command, Path& store);  // and kKeyOption, which CommandLine::key takes up

// A command of its own below `command`, on a store.
template <typename App, typename Args>
App& add_verb(App& command, const char* name, const char* help, Args& args, typename Args::Verb which,
              CommandArgs& chosen) {
  App* verb = command.add_subcommand(name, help);
  add_store(*verb, args.store);
  verb->callback([&args, &chosen, which] {
    args.verb = which;
    chosen = args;
  });
  return *verb;
}
void add_calibrate(CLI::App& app, CommandArgs& chosen, CalibrateArgs& args, CalibrateLiveArgs& live_args);
void add_calibration(CLI::App& app, CommandArgs& chosen, CalibrationArgs& args);
void add_simulate(CLI::App& app, CommandArgs& chosen, SimulateArgs& args);
void add_selftest(CLI::App& app, CommandArgs& chosen, SelfTestArgs& args);
CLI::App* add_compare(CLI::App& app, CommandArgs& chosen, CompareArgs& args);

}  // namespace relievo::firmware
