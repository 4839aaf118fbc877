// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text becomes speech, piece by piece, as fast as the processor allows.
// Thread: one for everything, since the library has one voice for the whole process; has_voice_for(): any.
// Memory: the library's own, taken when it opens; its last sentence stays there.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "hal/base/result.h"
#include "hal/speaker.h"

namespace relievo::hal {

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
