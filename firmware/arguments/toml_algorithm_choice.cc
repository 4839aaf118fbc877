// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <utility>

#include "firmware/arguments/algorithm_choice.h"
#include "hal/base/whole_file.h"

namespace relievo::firmware {
namespace {

constexpr std::size_t kMaxSettingsBytes = 64 * 1024;
// Larger is no list of a picture's points, not of a match at every pixel of 20 megapixels.
constexpr std::size_t kMostTextBytes = std::size_t{512} << 20;

Result<std::string> read_text(const Path& file, std::size_t most_bytes) {
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, most_bytes));
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

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
  return invalid(
             "is no setting: write [matcher] name = \"refined\", or a number or word in a table of its own")
      .at(line_of(file_name, node.source()));
}

Error no_toml(std::string_view file_name, const toml::parse_error& error) {
  return invalid("is not TOML: correct this line").at(line_of(file_name, error.source()));
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

Result<void> apply(pipeline::AlgorithmSet& set, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      return invalid("is no setting: write KEY=VALUE, as in matcher=refined").at(setting);
    }
    RELIEVO_TRY(set.set(setting.substr(0, equals), setting.substr(equals + 1)));
  }
  return {};
}

}  // namespace

Result<std::vector<std::string>> parse_settings(std::string_view text, std::string_view file_name) {
  try {
    return settings_of(toml::parse(text, file_name), file_name, false);
  } catch (const toml::parse_error& error) {
    return no_toml(file_name, error);
  }
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

Result<std::vector<SetWords>> read_sets_file(const Path& file) {
  RELIEVO_TRY_ASSIGN(const std::string text, read_text(file, kMaxSettingsBytes));
  return parse_sets(text, file.string());
}

Result<void> read_texts(pipeline::AlgorithmSet& set) {
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms()) {
    if (!option.file || set.get(option.key).empty() || set.texts().contains(option.key)) continue;
    RELIEVO_TRY_ASSIGN(std::string text, read_text(set.get(option.key), kMostTextBytes));
    set.keep_text(option.key, std::move(text));
  }
  return {};
}

Result<pipeline::AlgorithmSet> choose_algorithms(const AlgorithmArgs& args, pipeline::AlgorithmSet start) {
  pipeline::AlgorithmSet set = std::move(start);
  if (!args.file.empty()) {
    RELIEVO_TRY_ASSIGN(const std::string text, read_text(args.file, kMaxSettingsBytes));
    RELIEVO_TRY_ASSIGN(const auto settings, parse_settings(text, args.file.string()));
    RELIEVO_TRY(apply(set, settings));
  }
  RELIEVO_TRY(apply(set, args.settings));
  RELIEVO_TRY(read_texts(set));
  return set;
}

Result<pipeline::Pipeline> make_pipeline(const AlgorithmArgs& args,
                                         const pipeline::StereoCalibration& calibration) {
  RELIEVO_TRY_ASSIGN(const pipeline::AlgorithmSet set, choose_algorithms(args));
  return pipeline::Pipeline::make(set, calibration, {},
                                  args.whole_view ? pipeline::Region::All : pipeline::Region::Face);
}

std::map<std::string, std::string> choices_in(const std::string& text) {
  std::map<std::string, std::string> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t equals = line.find(" = "); equals != std::string::npos)
      all[line.substr(0, equals)] = line.substr(equals + 3);
  return all;
}

}  // namespace relievo::firmware
