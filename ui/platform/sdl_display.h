// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why no whole screen could be opened, in words of what to do: SDL says "no available video device" of a
// driver that is missing, of a file this user may not open, and of a monitor that is not plugged in. Thread:
// any. Errors: none.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "hal/base/result.h"
#include "ui/display.h"

namespace relievo::ui {

struct ScreenPlaces {
  std::filesystem::path devices = "/dev/dri";         // card0, card1, ... : what draws
  std::filesystem::path monitors = "/sys/class/drm";  // card0-HDMI-A-1/status ...: what shows it
};

// None: cards can be opened and a monitor is there, it is something else.
std::optional<Error> why_no_screen(const ScreenPlaces& places = {});

// The display by SDL 2: a window on a desktop, KMS on a device, nothing at all to be seen under
// SDL_VIDEODRIVER=offscreen. A mouse is a finger.
// Thread: main. Errors: LibraryFailed with SDL's words.

Result<std::unique_ptr<Display>> open_sdl_display(const DisplayOptions& options);

}  // namespace relievo::ui
