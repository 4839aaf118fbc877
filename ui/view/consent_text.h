// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The operator's own consent text, in the languages they have it in. Plain data, UTF-8.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ui/language/language.h"

namespace relievo::ui {

struct ConsentPoint {
  std::string title, words;
  bool operator==(const ConsentPoint&) const = default;
};

struct ConsentText {
  std::string title;
  std::vector<ConsentPoint> points;
  bool operator==(const ConsentText&) const = default;
};

struct ConsentTexts {
  std::string version;  // stored with every record, as "2026-03"
  std::array<std::optional<ConsentText>, kLanguages> in;
  const ConsentText* of(Language language) const {
    const auto& text = in[static_cast<std::size_t>(language)];
    return text ? &*text : nullptr;
  }
  bool operator==(const ConsentTexts&) const = default;
};

}  // namespace relievo::ui
