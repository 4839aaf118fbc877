// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The operator's own consent text, in the languages they have it in. Plain data, UTF-8.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/image_view.h"
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

// In a link, where the number stands that names a portrait and erases nothing.
inline constexpr std::string_view kModelPlace = "{model}", kHttps = "https://";
// "museum.example" of "https://museum.example/heads/1".
constexpr std::string_view site_of(std::string_view link) {
  link.remove_prefix(std::min(link.size(), kHttps.size()));
  return link.substr(0, link.find('/'));
}

// Who runs the device.
struct Host {
  std::string name, reached;    // how they are reached; both may be empty
  std::string link;             // where they offer a portrait, with kModelPlace in it; empty: nowhere
  std::vector<std::byte> sign;  // Rgb8 or Grey8, rows without padding; empty: none
  int sign_width_px = 0, sign_height_px = 0;
  PixelFormat sign_format = PixelFormat::Rgb8;
  ImageView sign_view() const {
    return {sign.data(), sign_width_px, sign_height_px, sign_width_px * bytes_per_pixel(sign_format),
            sign_format};
  }
  bool operator==(const Host&) const = default;
};

struct ConsentTexts {
  std::string version;  // stored with every record, as "2026-03"
  Host host;
  std::array<std::optional<ConsentText>, kLanguages> in;
  const ConsentText* of(Language language) const {
    const auto& text = in[std::size_t(language)];
    return text ? &*text : nullptr;
  }
  bool operator==(const ConsentTexts&) const = default;
};

}  // namespace relievo::ui
