// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <utility>

#include "pipeline/algorithms.h"

namespace relievo::pipeline {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

Result<void> check_value(const OptionDescription& option, const std::string& value) {
  // Nothing else comes back as it was from to_text().
  if (trimmed(value) != value || std::ranges::any_of(value, [](unsigned char c) { return c < ' '; }))
    return invalid("takes no line ends or other control characters, and no blanks at its ends")
        .at(option.key);
  if (option.text) return {};
  if (!option.names.empty()) {
    std::vector<std::string> parts = option.several ? split_names(value) : std::vector<std::string>{value};
    for (const std::string& part : parts)
      if (std::ranges::find(option.names, part) == option.names.end()) {
        if (option.is_option()) return out_of_range(option.key, value, option.range);
        return Error{Errc::NotFound, "no such algorithm: choose one of those in brackets"}.at(
            option.key + " = " + value + " (" + joined(option.names) + ")");
      }
    std::ranges::sort(parts);
    if (std::ranges::adjacent_find(parts) != parts.end())
      return invalid("names an algorithm twice").at(option.key + " = " + value);
    if (parts.size() > 1 && std::ranges::find(parts, "none") != parts.end())
      return invalid("names none and an algorithm").at(option.key + " = " + value);
    return {};
  }
  const std::optional<double> number = number_in(value);
  if (!number || !option.range.holds(*number)) return out_of_range(option.key, value, option.range);
  return {};
}

// Names what there is instead.
Error unknown_key(std::string_view key, const std::vector<OptionDescription>& all) {
  const std::string_view section = key.substr(0, key.find('.'));
  const std::string begin = std::string(section) + ".";
  std::vector<std::string> kinds, options;
  for (const OptionDescription& option : all) {
    if (!option.is_option()) kinds.push_back(option.key);
    else if (option.key.starts_with(begin)) options.push_back(option.key.substr(begin.size()));
  }
  const auto place = [key](const std::vector<std::string>& there) {
    return std::string(key) + " (" + joined(there) + ")";
  };
  const std::size_t room = Error{Errc::NotFound, ""}.where_text.size() - 1;
  if (!options.empty() && place(options).size() <= room)
    return Error{
        Errc::NotFound,
        "no such option: its algorithm has those in brackets ('relievo algorithms NAME' says what they are)"}
        .at(place(options));
  if (!options.empty())
    return Error{Errc::NotFound, "no such option: 'relievo algorithms NAME' lists those of its algorithm"}.at(
        key);
  return Error{
      Errc::NotFound,
      "no such setting: choose a kind, one of those in brackets, or ALGORITHM.OPTION ('relievo algorithms' lists them)"}
      .at(place(kinds));
}

}  // namespace

Result<void> check_neighbours(const AlgorithmSet& set) {
  const std::vector<OptionDescription> kinds = describe_algorithms();
  const auto on_lattice = [&](std::string_view key) {
    for (const OptionDescription& kind : kinds)
      for (const AlgorithmDescription& algorithm : kind.algorithms)
        if (kind.key == key && set.get(key) == algorithm.name) return algorithm.lattice;
    return false;
  };
  if ((on_lattice("selector") && on_lattice("matcher")) || !on_lattice("mesher")) return {};
  return invalid(
             "this mesher joins neighbours of a lattice and these matches are scattered: choose mesher=delaunay, or selector=dense or grid-points and a matcher other than file-matches")
      .at("selector=" + set.get("selector") + " matcher=" + set.get("matcher") +
          " mesher=" + set.get("mesher"));
}

Result<void> AlgorithmSet::set(std::string_view key, std::string_view value) {
  const std::vector<OptionDescription> all = describe_algorithms();
  for (const OptionDescription& option : all)
    if (option.key == key) {
      RELIEVO_TRY(check_value(option, std::string(value)));
      chosen_[std::string(key)] = std::string(value);
      texts_.erase(std::string(key));
      return {};
    }
  return unknown_key(key, all);
}

void AlgorithmSet::keep_text(std::string_view key, std::string text) {
  texts_[std::string(key)] = std::make_shared<const std::string>(std::move(text));
}

std::string AlgorithmSet::get(std::string_view key) const {
  if (const auto chosen = chosen_.find(key); chosen != chosen_.end()) return chosen->second;
  for (const OptionDescription& option : describe_algorithms())
    if (option.key == key) return option.value;
  return {};
}

Result<AlgorithmSet> AlgorithmSet::from_text(std::string_view text, std::vector<std::string>* unknown) {
  AlgorithmSet set;
  const auto take = [&set](std::string_view line) -> Result<void> {
    const std::size_t sign = line.find('=');
    if (sign == std::string_view::npos)
      return invalid("is no choice of an algorithm: key = value is expected").at(line);
    const std::string_view key = trimmed(line.substr(0, sign)), value = trimmed(line.substr(sign + 1));
    // What is stored may be older than a name.
    if (key == "grid-points.max_points") return {};
    if (key == "selector" && (value == "grid" || value == "file"))
      return set.set(key, std::string(value) + "-points");
    return set.set(key, value);
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    const Result<void> taken = take(line);
    if (taken) continue;
    if (unknown == nullptr) return taken.error();
    unknown->emplace_back(line);
  }
  return set;
}

std::string AlgorithmSet::to_text() const {
  std::map<std::string, std::string, std::less<>> all = chosen_;
  for (const OptionDescription& kind : describe_algorithms())
    if (!kind.is_option()) all.try_emplace(kind.key, kind.value);
  std::string text;
  for (const auto& [key, value] : all) text += key + " = " + value + "\n";
  return text;
}

}  // namespace relievo::pipeline
