// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <espeak-ng/espeak_ng.h>

#include <algorithm>
#include <array>
#include <string>

#include "hal/base/wiped_text.h"
#include "hal/sound/mixer.h"
#include "hal/sound/speaker.h"

namespace relievo::hal {
namespace {

struct Voice {
  std::string_view language;
  const char* name;
};
constexpr std::array kVoices{Voice{"en", "en-gb"}, Voice{"de", "de"}, Voice{"fr", "fr-fr"}, Voice{"es", "es"},
                             // The other Mandarin voice reads the tones it has looked up as English words.
                             Voice{"zh-Hans", "cmn-latn-pinyin"}};
constexpr int kWordsPerMinute = 165;
constexpr int kPieceMs = 40;

const Voice* voice_for(std::string_view language) {
  const auto found = std::ranges::find(kVoices, language, &Voice::language);
  return found == kVoices.end() ? nullptr : &*found;
}

struct Receiver {
  const SpeechSink* sink = nullptr;
  int volume_percent = 100;
};

// The library's own thread is this one: it speaks only while somebody waits for it.
int receive(short* samples, int count, espeak_EVENT* events) {
  if (samples == nullptr || count <= 0 || events == nullptr) return 0;
  const auto* receiver = static_cast<const Receiver*>(events->user_data);
  if (receiver == nullptr) return 0;
  const std::span<short> made(samples, std::size_t(count));
  for (short& sample : made) sample = static_cast<short>(sample * receiver->volume_percent / 100);
  return (*receiver->sink)(made) ? 0 : 1;
}

Error failed(espeak_ng_STATUS status) {
  std::array<char, 200> said{};
  espeak_ng_GetStatusCodeMessage(status, said.data(), said.size());
  return Error{Errc::LibraryFailed, "no speech can be made: install espeak-ng-data"}.at(said.data());
}

// Once for the process and to its end: ending it waits for a thread of the library's that may be past hearing
// of it, for ever (espeak-ng 1.51).
Result<void> begin_library() {
  espeak_ng_InitializePath(nullptr);
  if (const auto status = espeak_ng_Initialize(nullptr); status != ENS_OK) return failed(status);
  if (const auto status = espeak_ng_InitializeOutput(ENOUTPUT_MODE_SYNCHRONOUS, kPieceMs, nullptr);
      status != ENS_OK)
    return failed(status);
  if (espeak_ng_GetSampleRate() != kSamplesPerSecond)
    return Error{Errc::LibraryFailed, "espeak-ng speaks at another sample rate"};
  espeak_SetSynthCallback(receive);
  return {};
}

}  // namespace

bool has_voice_for(std::string_view language) { return voice_for(language) != nullptr; }

Result<void> open_synthesizer() {
  static const Result<void> begun = begin_library();
  return begun;
}

Result<void> synthesize(const Speech& speech, const SpeechSink& sink) {
  const Voice* voice = voice_for(speech.language);
  if (voice == nullptr) return Error{Errc::NotFound, "has no voice"}.at(std::string(speech.language));
  espeak_VOICE asked{};
  asked.languages = voice->name;
  if (const auto status = espeak_ng_SetVoiceByProperties(&asked); status != ENS_OK) return failed(status);
  espeak_ng_SetParameter(espeakRATE, kWordsPerMinute * speech.speed_percent / 100, 0);
  const WipedText text(speech.text);
  Receiver receiver{&sink, std::clamp(speech.volume_percent, 0, 100)};
  const auto status = espeak_ng_Synthesize(text.view().data(), text.view().size() + 1, 0, POS_CHARACTER, 0,
                                           espeakCHARS_UTF8, nullptr, &receiver);
  if (status != ENS_OK && status != ENS_SPEECH_STOPPED) return failed(status);
  return {};
}

}  // namespace relievo::hal
