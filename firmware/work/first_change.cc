// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/first_change.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace relievo::firmware {
namespace {

State stage_of(const pipeline::OptionDescription& option) {
  const std::string& kind = option.kind.empty() ? option.key : option.kind;
  if (option.key.starts_with("face.")) return State::Match;  // what is matched is cut to it, too
  if (kind == "triangulator" || kind == "outliers") return State::Reconstruct;
  if (kind == "mesher" || kind == "completion") return State::Mesh;
  if (kind == "texturer") return State::Texture;
  if (kind == "fuser") return State::Review;  // of several pairs
  return kind == "relief" ? State::Assemble : State::Match;
}

std::string_view text_of(const pipeline::AlgorithmSet& set, const pipeline::OptionDescription& option) {
  const auto text = set.texts().find(option.key);
  return text == set.texts().end() ? std::string_view() : std::string_view(*text->second);
}

}  // namespace

State first_change(const pipeline::AlgorithmSet& before, const pipeline::AlgorithmSet& after) {
  State first = State::Review;
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms())
    if (before.get(option.key) != after.get(option.key) ||
        (option.file && text_of(before, option) != text_of(after, option)))
      first = std::min(first, stage_of(option));
  return first;
}

}  // namespace relievo::firmware
