// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <type_traits>

#include "firmware/base/settings.h"
#include "firmware/command/commands.h"

namespace relievo::firmware {

Result<std::unique_ptr<storage::Store>> open_kept_store(const Path& folder, Services& services) {
  // To read needs the store: one that is named wrongly is not made. An older one can only be opened to write.
  if (const auto there = services.open_store(folder, false); !there && there.error().code == Errc::NotFound)
    return there.error();
  return services.open_store(folder, true);
}

int run_command(const CommandLine& line, Services& services) {
  return std::visit(
      [&](const auto& args) {
        if constexpr (std::is_same_v<std::decay_t<decltype(args)>, NothingArgs>) {
          return line.exit_code;
        } else {
          const Result<void> done = run(args, services);
          if (!done) services.console.fail(done.error());
          return done ? 0 : 1;
        }
      },
      line.command);
}

}  // namespace relievo::firmware
