// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the files lie that the program reads and does not hold: words, pictures. Thread: main, before others
// change the environment.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace relievo {

// The folder that the environment's `variable` names; else `name` beside an installed program (PREFIX/bin and
// PREFIX/share/relievo), where it is there; else where the build put it.
inline std::filesystem::path shared_files(const char* variable, std::string_view name,
                                          const std::filesystem::path& built,
                                          const std::filesystem::path& program = "/proc/self/exe") {
  if (const char* named = std::getenv(variable)) return named;
  std::error_code unknown;
  const std::filesystem::path real = std::filesystem::canonical(program, unknown);
  const std::filesystem::path installed = real.parent_path().parent_path() / "share/relievo" / name;
  return !unknown && std::filesystem::is_directory(installed, unknown) ? installed : built;
}

}  // namespace relievo
