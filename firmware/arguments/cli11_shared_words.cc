// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/command_words.h"

#include <CLI/CLI.hpp>

namespace relievo::firmware {

void add_store(CLI::App& command, Path& store) {
  command.add_option("--store", store, "folder of the store")->type_name("DIR");
  command.add_option(kKeyOption, "file with the store's key, if it does not lie beside the store")
      ->type_name("FILE");
}

}  // namespace relievo::firmware
