// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/command_words.h"

#include <CLI/CLI.hpp>

#include <string>

namespace relievo::firmware {

void add_staff(CLI::App& app, CommandArgs& chosen, StaffArgs& args) {
  CLI::App* command = app.add_subcommand(
      "staff",
      "a PIN that was forgotten, a touch screen that nobody can use any more; while the kiosk is stopped");
  command->require_subcommand(1);
  const auto verb = [&](const char* name, const char* help, StaffArgs::Verb which) {
    CLI::App* sub = command->add_subcommand(name, help);
    add_store(*sub, args.store);
    sub->callback([&args, &chosen, which] {
      args.verb = which;
      chosen = args;
    });
    return sub;
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

}  // namespace relievo::firmware
