// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one file that names implementations: which board, which store.
#include <string>

#include "firmware/command/services.h"
#include "hal/monotonic_clock.h"
#include "storage/sqlite/sqlite_store.h"

namespace relievo::firmware {
namespace {

Result<std::unique_ptr<hal::Board>> open_board(std::string_view board) {
  return Error{Errc::InvalidInput, "is no board: use sim, or folder:DIR with recorded pairs"}.at(board);
}

Result<std::unique_ptr<storage::Store>> open_store(const Path& folder, bool to_write) {
  static const hal::MonotonicClock clock;
  storage::SqliteStoreOptions options;
  options.mode = to_write ? storage::OpenMode::ReadWrite : storage::OpenMode::ReadOnly;
  return storage::open_sqlite_store(folder, clock, options);
}

Result<void> simulate(const SimulateArgs&, const Path&, const Services::SimulateProgress&) {
  return Error{Errc::Unsupported, "not built yet"};
}

}  // namespace
}  // namespace relievo::firmware

int main(int argc, char** argv) {
  namespace fw = relievo::firmware;
  fw::Console console;
  fw::Services services{fw::open_board, fw::open_store, fw::simulate, console};
  return fw::run_command(fw::parse_command_line(argc, argv), services);
}
