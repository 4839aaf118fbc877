// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/platform/missing_screen.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace relievo::ui {
namespace {

namespace fs = std::filesystem;

// What begins with "card" there: the graphics devices in one place, their sockets in the other. In order of
// their names.
std::vector<fs::path> cards_in(const fs::path& folder) {
  std::vector<fs::path> cards;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().native().starts_with("card")) cards.push_back(entry->path());
  }
  std::ranges::sort(cards);
  return cards;
}

std::string status_of(const fs::path& socket) {
  std::string word;
  std::ifstream(socket / "status") >> word;
  return word;
}

}  // namespace

std::optional<Error> why_no_screen(const ScreenPlaces& places) {
  const std::vector<fs::path> cards = cards_in(places.devices);
  if (cards.empty())
    return Error{
        Errc::NotFound,
        "there is no graphics device: is its driver in the kernel (dmesg | grep drm)? Where nobody looks, SDL_VIDEODRIVER=offscreen"}
        .at(places.devices.native());
  const auto usable = [](const fs::path& card) { return access(card.c_str(), R_OK | W_OK) == 0; };
  if (std::ranges::none_of(cards, usable))
    return Error{
        Errc::IoFailed,
        "this user may not use the screen: put the user into the groups video, render and input, and log in again"}
        .at(cards.front().native());
  std::vector<fs::path> sockets = cards_in(places.monitors);
  std::erase_if(sockets, [](const fs::path& socket) { return status_of(socket).empty(); });
  if (!sockets.empty() && std::ranges::none_of(sockets, [](const fs::path& socket) {
        return status_of(socket) != "disconnected";
      }))
    return Error{
        Errc::NotFound,
        "no monitor is plugged in: check its cable and its power, or force one with video= on the kernel's command line"}
        .at(sockets.front().native());
  return std::nullopt;
}

}  // namespace relievo::ui
