// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The system's sound card by SDL 2, espeak-ng's voices. A thread speaks; it starts the library, so that the
// caller never waits for it. Errors: Unsupported (there is no sound card), LibraryFailed.
#pragma once

#include <memory>

#include "hal/base/result.h"
#include "hal/device.h"
#include "hal/speaker.h"

namespace relievo::hal {

// `jack` may be empty: then nothing is known of headphones, and all is heard by everybody.
Result<std::unique_ptr<Speaker>> open_sdl_speaker(std::unique_ptr<InputSwitch> jack);

}  // namespace relievo::hal
