// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/shared_files.h"

#include <cstdlib>
#include <system_error>

namespace relievo {

std::filesystem::path shared_files(const char* variable, std::string_view name,
                                   const std::filesystem::path& built, const std::filesystem::path& program) {
  if (const char* named = std::getenv(variable)) return named;
  std::error_code unknown;
  const std::filesystem::path real = std::filesystem::canonical(program, unknown);
  const std::filesystem::path installed = real.parent_path().parent_path() / "share/relievo" / name;
  return !unknown && std::filesystem::is_directory(installed, unknown) ? installed : built;
}

}  // namespace relievo
