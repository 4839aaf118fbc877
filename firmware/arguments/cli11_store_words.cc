// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/command_words.h"

#include <CLI/CLI.hpp>

namespace relievo::firmware {

void add_store_keeping(CLI::App& app, CommandArgs& chosen, StoreArgs& args) {
  CLI::App* command =
      app.add_subcommand("store", "the store as a whole: check, copy, keys; while the kiosk is stopped");
  command->require_subcommand(1);
  const auto verb = [&](const char* name, const char* help, StoreArgs::Verb which) {
    CLI::App* sub = command->add_subcommand(name, help);
    add_store(*sub, args.store);
    sub->callback([&args, &chosen, which] {
      args.verb = which;
      chosen = args;
    });
    return sub;
  };
  verb("check", "every page, model and line of the log", StoreArgs::Verb::Check)
      ->add_option("--backup", args.file, "a copy of this store: who in it has been erased since?")
      ->type_name("FILE");
  verb("backup", "a copy, sealed as the store is; the key is not in it", StoreArgs::Verb::Backup)
      ->add_option("file", args.file, "where to")
      ->required()
      ->type_name("FILE");
  verb("rekey", "new keys; copies made before keep the old ones", StoreArgs::Verb::Rekey)
      ->add_option("--new-key", args.file, "the key moves to this file")
      ->type_name("FILE");
  verb("recovery-words",
       "draws the twelve words that open the store when its key is lost, and prints them once",
       StoreArgs::Verb::RecoveryWords);
  verb("recover", "reads the twelve words from standard input and makes a new key", StoreArgs::Verb::Recover);
}

}  // namespace relievo::firmware
