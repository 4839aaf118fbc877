// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The display by SDL 2: a window on a desktop, KMS on a device, nothing at all to be seen under
// SDL_VIDEODRIVER=offscreen. A mouse is a finger.
// Thread: main. Errors: LibraryFailed with SDL's words.
#pragma once

#include <memory>

#include "ui/display.h"

namespace relievo::ui {

Result<std::unique_ptr<Display>> open_sdl_display(const DisplayOptions& options);

}  // namespace relievo::ui
