// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>

#include "firmware/arguments/settings_file.h"
#include "hal/base/whole_file.h"

namespace relievo::firmware {
namespace {

constexpr std::size_t kMaxSettingsBytes = 64 * 1024;

// A value as --set writes it; empty for what is no single value.
std::string word_of(const toml::node& value) {
  if (const auto* text = value.as_string()) return text->get();
  if (!value.is_number() && !value.is_boolean()) return {};
  std::ostringstream out;
  value.visit([&out](const auto& node) {
    if constexpr (toml::is_number<decltype(node)> || toml::is_boolean<decltype(node)>) out << node;
  });
  return out.str();
}

std::string line_of(std::string_view file_name, const toml::source_region& place) {
  return std::string(file_name) + ":" + std::to_string(place.begin.line);
}

Error at_line(std::string_view file_name, const toml::node& node) {
  return Error{Errc::InvalidInput,
               "is no setting: write [matcher] name = \"refined\", or a number or word in a table of its own"}
      .at(line_of(file_name, node.source()));
}

Error no_toml(std::string_view file_name, const toml::parse_error& error) {
  return Error{Errc::InvalidInput, "is not TOML: correct this line"}.at(line_of(file_name, error.source()));
}

// `words`: a kind may be set by a word of its own too, matcher = "refined".
Result<std::vector<std::string>> settings_of(const toml::table& root, std::string_view file_name,
                                             bool words) {
  std::vector<std::string> settings;
  for (const auto& [table_name, node] : root) {
    const toml::table* table = node.as_table();
    const std::string alone = words ? word_of(node) : std::string();
    if (!alone.empty()) settings.push_back(std::string(table_name.str()) + "=" + alone);
    else if (table == nullptr) return at_line(file_name, node);
    if (table == nullptr) continue;
    for (const auto& [key, value] : *table) {
      const std::string word = word_of(value);
      if (word.empty()) return at_line(file_name, value);
      std::string setting(table_name.str());
      if (key.str() != "name") setting.append(".").append(key.str());
      settings.push_back(setting.append("=").append(word));
    }
  }
  return settings;
}

}  // namespace

Result<std::vector<std::string>> parse_settings(std::string_view text, std::string_view file_name) {
  try {
    return settings_of(toml::parse(text, file_name), file_name, false);
  } catch (const toml::parse_error& error) {
    return no_toml(file_name, error);
  }
}

Result<std::vector<std::string>> read_settings_file(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMaxSettingsBytes));
  return parse_settings({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

Result<std::vector<SetWords>> parse_sets(std::string_view text, std::string_view file_name) {
  try {
    const toml::table root = toml::parse(text, file_name);
    std::vector<std::pair<toml::source_index, SetWords>> sets;  // the library sorts by name
    for (const auto& [name, node] : root) {
      if (!node.is_table()) return at_line(file_name, node);
      RELIEVO_TRY_ASSIGN(auto settings, settings_of(*node.as_table(), file_name, true));
      sets.push_back({node.source().begin.line, {std::string(name.str()), std::move(settings)}});
    }
    std::ranges::stable_sort(sets, [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<SetWords> in_order;
    in_order.reserve(sets.size());
    for (auto& set : sets) in_order.push_back(std::move(set.second));
    return in_order;
  } catch (const toml::parse_error& error) {
    return no_toml(file_name, error);
  }
}

Result<std::vector<SetWords>> read_sets_file(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMaxSettingsBytes));
  return parse_sets({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace relievo::firmware
