// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The system's sound card by SDL 2, espeak-ng's voices. A thread speaks; it starts the library, so that the
// caller never waits for it. Errors: Unsupported (there is no sound card), LibraryFailed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "hal/base/result.h"
#include "hal/device.h"
#include "hal/speaker.h"

namespace relievo::hal {

// `jack` may be empty: then nothing is known of headphones, and all is heard by everybody.
Result<std::unique_ptr<Speaker>> open_sdl_speaker(std::unique_ptr<InputSwitch> jack);

// Text becomes speech, piece by piece, as fast as the processor allows.
// Thread: one for everything, since the library has one voice for the whole process; has_voice_for(): any.
// Memory: the library's own, taken when it opens; its last sentence stays there.

// BCP 47. Languages whose voice reads them as they are written: see ui/speech/README.md for those it does
// not.
bool has_voice_for(std::string_view language);

// Before the first word. Errors: LibraryFailed (its data is missing: install espeak-ng-data).
Result<void> open_synthesizer();

// Mono, kSamplesPerSecond (mixer.h). False: no more is wanted.
using SpeechSink = std::function<bool(std::span<const std::int16_t>)>;
// Returns when all was handed over or no more was wanted. Errors: NotFound (no voice), LibraryFailed.
Result<void> synthesize(const Speech& speech, const SpeechSink& sink);

}  // namespace relievo::hal
