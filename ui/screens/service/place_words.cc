// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/place_words.h"

#include <algorithm>
#include <array>
#include <optional>

namespace relievo::ui {
namespace {

constexpr std::size_t kMostParts = 8;

struct Parts {
  std::array<std::string_view, kMostParts> values{};
  std::size_t count = 0;
};

// What stands in the holes of `key`, where `text` is `key` with them filled.
std::optional<Parts> parts_of(std::string_view text, std::string_view key) {
  Parts parts;
  for (std::size_t hole = key.find("{}");; hole = key.find("{}")) {
    if (!text.starts_with(key.substr(0, hole))) return std::nullopt;
    if (hole == std::string_view::npos)
      return text.size() == key.size() ? std::optional(parts) : std::nullopt;
    text.remove_prefix(hole);
    key.remove_prefix(hole + 2);
    const std::string_view behind = key.substr(0, key.find("{}"));
    const std::size_t end = behind.empty() ? text.size() : text.find(behind);
    if (end == std::string_view::npos || end == 0 || parts.count == kMostParts) return std::nullopt;
    parts.values[parts.count++] = text.substr(0, end);
    text.remove_prefix(end);
  }
}

std::string_view said_camera(StaffFrame& page, std::string_view name) {
  if (const auto serial = parts_of(name, "serial {}"))
    return page.filled(page.tr("serial {}"), serial->values[0]);
  if (const auto socket = parts_of(name, "at {}")) return page.filled(page.tr("at {}"), socket->values[0]);
  return name;
}

// Empty where the place is none of two cameras.
std::string_view said_exchange(StaffFrame& page, std::string_view place) {
  const std::size_t arrow = place.find(kBecame);
  if (arrow == std::string_view::npos) return {};
  const std::string_view was = said_camera(page, place.substr(0, arrow)),
                         is = said_camera(page, place.substr(arrow + kBecame.size()));
  return page.filled(page.tr("{} instead of {}"), {is, was});
}

std::string_view said_cameras(StaffFrame& page, std::string_view place) {
  const std::size_t apart = place.find("; ");
  if (apart == std::string_view::npos) return said_exchange(page, place);
  const std::string_view left = said_exchange(page, place.substr(0, apart)),
                         right = said_exchange(page, place.substr(apart + 2));
  return left.empty() || right.empty() ? std::string_view{}
                                       : page.filled(page.tr("left {}, right {}"), {left, right});
}

// Their keys, as the catalogues have them.
constexpr const char* kPlaces[] = {
    "left picture",
    "right picture",
    "{} mm off a plane; {} mm off a bent sheet, a face at least {}, sigma {}; curved by {} sr, a face at least {}",
};

}  // namespace

std::string_view said_place(StaffFrame& page, std::string_view place) {
  if (const std::string_view cameras = said_cameras(page, place); !cameras.empty()) return cameras;
  for (const char* key : kPlaces) {
    std::optional<Parts> parts = parts_of(place, key);
    if (!parts) continue;
    const auto values = std::span(parts->values).first(parts->count);
    for (std::string_view& value : values) value = page.as_number(value);
    return page.filled(page.tr(key), values);
  }
  return page.as_number(place);
}

}  // namespace relievo::ui
