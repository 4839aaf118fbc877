// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <SDL2/SDL.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "hal/base/mailbox.h"
#include "hal/base/wiped_text.h"
#include "hal/sound/mixer.h"
#include "hal/sound/speaker.h"

namespace relievo::hal {
namespace {

using namespace std::chrono_literals;

struct Wanted {
  Mixer::Number number = 0;
  WipedText text;
  std::string language;
  int volume_percent = 100, speed_percent = 100;
};

class SdlSpeaker final : public Speaker {
 public:
  explicit SdlSpeaker(std::unique_ptr<InputSwitch> jack) : jack_(std::move(jack)) {}
  ~SdlSpeaker() override {
    ending_ = true;
    mixer_.cut();
    if (voice_.joinable()) voice_.join();
    if (card_ != 0) SDL_CloseAudioDevice(card_);
    if (begun_) SDL_QuitSubSystem(SDL_INIT_AUDIO);
  }

  Result<void> open() {
    begun_ = SDL_InitSubSystem(SDL_INIT_AUDIO) == 0;
    // Asked before it is opened: ALSA would write a page about a card that is not there.
    if (!begun_ || SDL_GetNumAudioDevices(0) == 0)
      return Error{Errc::Unsupported, "there is no sound card: nothing is heard"};
    SDL_AudioSpec wanted{};
    wanted.freq = kSamplesPerSecond;
    wanted.format = AUDIO_S16SYS;
    wanted.channels = 1;
    wanted.samples = 512;  // 23 ms: what is cut is not heard for longer
    wanted.callback = [](void* mixer, Uint8* bytes, int size) {
      static_cast<Mixer*>(mixer)->fill(
          {reinterpret_cast<std::int16_t*>(bytes), std::size_t(size) / sizeof(std::int16_t)});
    };
    wanted.userdata = &mixer_;
    card_ = SDL_OpenAudioDevice(nullptr, 0, &wanted, nullptr, 0);
    if (card_ == 0)
      return Error{Errc::LibraryFailed, "the sound card does not open: nothing is heard"}.at(SDL_GetError());
    SDL_PauseAudioDevice(card_, 0);
    voice_ = std::thread([this] { run(); });
    return {};
  }

  bool has_voice(std::string_view language) const override { return !mute_ && has_voice_for(language); }
  bool has_headphones() override {
    const bool plugged = jack_ != nullptr && jack_->is_on();
    if (was_plugged_ && !plugged) mixer_.cut();
    return was_plugged_ = plugged;
  }
  void say(const Speech& speech) override {
    if (speech.text.empty()) return hush();
    // The newest counts.
    wanted_.put({mixer_.begin(), WipedText(speech.text), std::string(speech.language), speech.volume_percent,
                 speech.speed_percent});
  }
  void hush() override { mixer_.cut(); }
  bool is_speaking() const override { return !mute_ && mixer_.is_speaking(); }
  void play(Sound sound, float pitch) override { mixer_.play(sound, pitch); }

 private:
  void run() {
    mute_ = !open_synthesizer();
    while (!mute_ && !ending_) {
      if (auto wanted = wanted_.take_for(50ms)) speak(*wanted);
    }
  }
  // As far ahead of what is played as there is room, and no further.
  template <typename Put>
  bool wait_to(Mixer::Number number, const Put& put) {
    while (mixer_.is_wanted(number)) {
      if (put()) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }
  void speak(const Wanted& wanted) {
    const auto sink = [&](std::span<const std::int16_t> samples) {
      while (!samples.empty()) {
        const auto piece = samples.first(std::min(samples.size(), Mixer::kPiece));
        if (!wait_to(wanted.number, [&] { return mixer_.put(wanted.number, piece); })) return false;
        samples = samples.subspan(piece.size());
      }
      return true;
    };
    (void)synthesize({wanted.text.view(), wanted.language, wanted.volume_percent, wanted.speed_percent},
                     sink);
    (void)wait_to(wanted.number, [&] { return mixer_.finish(wanted.number); });
  }

  std::unique_ptr<InputSwitch> jack_;
  bool was_plugged_ = false, begun_ = false;
  Mixer mixer_;
  Mailbox<Wanted> wanted_;
  std::atomic<bool> ending_{false}, mute_{false};
  SDL_AudioDeviceID card_ = 0;
  std::thread voice_;
};

}  // namespace

Result<std::unique_ptr<Speaker>> open_sdl_speaker(std::unique_ptr<InputSwitch> jack) {
  auto speaker = std::make_unique<SdlSpeaker>(std::move(jack));
  RELIEVO_TRY(speaker->open());
  return std::unique_ptr<Speaker>(std::move(speaker));
}

}  // namespace relievo::hal
