// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/settings.h"

#include <cstdlib>
#include <sstream>

namespace relievo::firmware {

Result<std::filesystem::path> store_folder(const std::filesystem::path& named) {
  if (!named.empty()) return named;
  const char* data = std::getenv("XDG_DATA_HOME");
  if (data != nullptr && *data == '/') return std::filesystem::path(data) / "relievo";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return std::filesystem::path(home) / ".local/share/relievo";
  return invalid("there is no home to keep the store in: name it (--store DIR)");
}

std::string text_of(const ui::Settings& settings) {
  std::ostringstream out;
  for (std::size_t i = 0; i < ui::kSettings; ++i) {
    const auto setting = static_cast<ui::Setting>(i);
    out << info_of(setting).key << ' ' << settings.of(setting) << '\n';
  }
  return out.str();
}

ui::Settings settings_of(std::string_view text, std::vector<std::string>& complaints) {
  ui::Settings settings;
  std::istringstream in{std::string(text)};
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string key, rest;
    std::int32_t value = 0;
    const bool whole = static_cast<bool>(words >> key >> value) && !(words >> rest);
    bool taken = false;
    for (std::size_t i = 0; i < ui::kSettings && whole; ++i) {
      const auto setting = static_cast<ui::Setting>(i);
      if (info_of(setting).key == key) taken = settings.set(setting, value);
    }
    if (!taken) complaints.push_back(line);
  }
  return settings;
}

Result<void> disk_has_room(const std::filesystem::path& folder, std::int32_t least_mib) {
  std::error_code none;
  const auto room = std::filesystem::space(folder, none);
  if (none) return Error{Errc::IoFailed, "the disk does not tell how much room it has"};
  if (room.available >> 20 < static_cast<std::uintmax_t>(least_mib))
    return Error{Errc::MediaFull, "less room is left on the disk than is to stay free: make room"};
  return {};
}

}  // namespace relievo::firmware
