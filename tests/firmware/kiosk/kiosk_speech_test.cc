// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole visits of somebody who sees nothing: with a keypad's three keys and headphones, from the plug to the
// code, in every language that has a voice. What they do follows from what was said, and from nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/records/receipt.h"
#include "hal/clock.h"
#include "hal/sim/device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/firmware/kiosk/kiosk_hands.h"
#include "tests/support/recording_speaker.h"
#include "tests/support/small_rig.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

class KioskSpeechTest : public KioskHands {
 protected:
  KioskSpeechTest() {
    lend_small_rig(services, args, folder.path(), clock, test::small_device(0.5));
    services.open_speaker = [this] {
      auto made = std::make_unique<hal::RecordingSpeaker>(
          clock, std::vector<std::string>{"en", "de", "fr", "es", "zh-Hans"});
      speaker = made.get();
      return made;
    };
    open(args, services);
    EXPECT_TRUE(reach(ui::Step::Attract));
  }

  const std::vector<hal::RecordingSpeaker::Heard>& heard() const { return speaker->heard(); }
  std::string last_heard() const {
    for (std::size_t i = heard().size(); i-- > 0;) {
      if (!heard()[i].text.empty()) return heard()[i].text;
    }
    return {};
  }
  void press(ui::Input::Kind key) {
    pressed_at = heard().size();
    kiosk->feed({key});
    kiosk->turn();
  }
  // On from one to the next until it is said, as one who does not see where it is.
  void find_by_ear(const std::string& words) {
    for (int i = 0; i < 90; ++i) {
      press(ui::Input::Kind::Next);
      if (last_heard().starts_with(as_spoken(words))) return;
    }
    FAIL() << "never heard: " << words << "; last: " << last_heard();
  }
  void choose(const std::string& words) {
    find_by_ear(words);
    press(ui::Input::Kind::Activate);
    kiosk->turn();
  }
  // Without what only steers the eye.
  static std::string as_spoken(const std::string& words) {
    ui::Utterance spoken;
    spoken.say(words);
    return std::string(spoken.text());
  }
  // Whatever else was said meanwhile; not what was said before the last key. Minutes are "never".
  testing::AssertionResult hears(const std::string& words) {
    const auto never = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    for (std::size_t from = pressed_at; std::chrono::steady_clock::now() < never; kiosk->turn()) {
      nothing_shown_falls();
      for (; from < heard().size(); ++from)
        if (heard()[from].text.find(as_spoken(words)) != std::string::npos)
          return testing::AssertionSuccess();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return testing::AssertionFailure() << "never heard: " << words << "; last: " << last_heard();
  }
  // Of what the page shows of how far it is: its dots, and the bar of the portrait.
  void nothing_shown_falls() {
    const ui::Node* steps = find("steps");
    const std::pair now{steps != nullptr ? digits_of(steps->value) : shown.first,
                        find("progress") != nullptr ? kiosk->view().progress : shown.second};
    EXPECT_GE(now.first, shown.first);
    EXPECT_GE(now.second, shown.second);
    shown = now;
  }
  // And of what was said of it since: "2 of 4", "75 %".
  void nothing_said_falls(std::size_t since, const std::string& how_far) {
    std::string step;
    int percent = 0, said = 0;
    for (std::size_t i = since; i < heard().size(); ++i) {
      const std::string& text = heard()[i].text;
      for (std::size_t at = text.find(how_far); at != std::string::npos; at = text.find(how_far, at + 1)) {
        const std::string value = text.substr(at + how_far.size(), 12);
        if (value.find('%') == std::string::npos) {
          const std::string now = digits_of(value);
          EXPECT_GE(now, step) << text;
          step = now;
        } else {
          const int now = std::stoi(digits_of(value.substr(0, value.find('%'))));
          EXPECT_GE(now, percent) << text;
          percent = now;
        }
        ++said;
      }
    }
    EXPECT_GT(said, 4) << "each page, and the bar";
  }
  static bool is_own_name(const hal::RecordingSpeaker::Heard& one) {
    for (std::size_t i = 0; i < ui::kLanguages; ++i) {
      const ui::LanguageInfo& info = ui::info_of(static_cast<ui::Language>(i));
      if (one.language == info.code && one.text == info.own_name) return true;
    }
    return false;
  }
  // Of the texts since, all in this language and in headphones, each once after the other.
  void all_in(const char* language, std::size_t since) {
    for (std::size_t i = since; i < heard().size(); ++i) {
      if (heard()[i].text.empty()) continue;
      EXPECT_TRUE(heard()[i].language == language || is_own_name(heard()[i])) << heard()[i].text;
      EXPECT_TRUE(heard()[i].alone) << heard()[i].text;
    }
  }

  void visit(ui::Language language, const std::vector<std::string>& name) {
    const ui::Words tr(language);
    const ui::LanguageInfo& info = ui::info_of(language);
    SCOPED_TRACE(info.code);
    pressed_at = heard().size();
    speaker->plug(true);
    kiosk->turn();
    ASSERT_TRUE(hears("Your face in three dimensions"));
    if (language != ui::Language::English) {
      ASSERT_NO_FATAL_FAILURE(choose(info.own_name));
      ASSERT_TRUE(hears(tr("Your face in three dimensions")));
    }
    const std::size_t since = heard().size() - 1;
    shown = {};
    ASSERT_NO_FATAL_FAILURE(choose(tr("Start")));
    ASSERT_TRUE(hears(tr("What happens here")));
    EXPECT_TRUE(
        hears(tr("You get a code. Quote it to the staff at any time and everything about you is erased.")))
        << "what one agrees to, to its end";
    ASSERT_NO_FATAL_FAILURE(choose(tr("I agree")));
    ASSERT_TRUE(hears(tr("Your name or your number")));
    for (const std::string& letter : name) choose(letter);
    press(ui::Input::Kind::Repeat);
    std::string whole;
    for (const std::string& letter : name) whole += letter;
    ASSERT_TRUE(hears(whole)) << "the whole name, before it is handed in";
    ASSERT_NO_FATAL_FAILURE(choose(tr("Done")));
    ASSERT_TRUE(hears(tr("Very good. Look straight ahead and hold still"))) << "advice " << last_heard();
    ASSERT_TRUE(hears(tr("Your 3D portrait is being made")));
    ASSERT_TRUE(hears(tr("Is this you?")));
    const std::size_t accepted = heard().size();
    ASSERT_NO_FATAL_FAILURE(choose(tr("Yes, keep it")));
    ASSERT_TRUE(hears(tr("Thank you. Your portrait is stored")));
    for (std::size_t i = accepted; i < heard().size(); ++i)
      EXPECT_EQ(heard()[i].text.find(tr("The cameras are on")), std::string::npos) << heard()[i].text;
    code_is_heard();
    all_in(info.code, since);
    nothing_said_falls(since, tr("How far it is"));
    for (const hal::Sound sound : {hal::Sound::Shutter, hal::Sound::Done})
      EXPECT_EQ(std::count_if(heard().begin() + static_cast<std::ptrdiff_t>(since), heard().end(),
                              [&](const auto& one) { return one.text.empty() && one.sound == sound; }),
                1);
    ASSERT_NO_FATAL_FAILURE(choose(tr("Done")));
    ASSERT_TRUE(hears("Your face in three dimensions")) << "and the next visitor's language";
    speaker->plug(false);
    kiosk->turn();
    EXPECT_FALSE(speaker->is_speaking());
  }

  static std::string digits_of(std::string_view text) {
    std::string digits;
    for (const char c : text)
      if (c >= '0' && c <= '9') digits += c;
    return digits;
  }
  // The digits that were said are the code by which the record is found.
  void code_is_heard() {
    const std::string code = digits_of(kiosk->view().receipt);
    EXPECT_GT(code.size(), 8U);
    EXPECT_NE(digits_of(last_heard()).find(code), std::string::npos) << last_heard();
    auto store = storage::open_sqlite_store(args.store, clock, {.mode = storage::OpenMode::ReadOnly});
    ASSERT_TRUE(store.has_value());
    EXPECT_TRUE(find_by_receipt(**store, std::string(kiosk->view().receipt)).has_value());
  }

  // Who asks for it without headphones, types by sight and is overheard.
  void visit_aloud() {
    const std::size_t since = heard().size();
    EXPECT_FALSE(speaker->is_speaking()) << "not without being asked";
    tap("speech");
    ASSERT_TRUE(hears("Your face in three dimensions"));
    tap("start");
    tap("agree");
    for (const char* key : {"key Q", "key u", "key x"}) tap(key);
    for (int i = 0; i < 60; ++i) press(ui::Input::Kind::Next);
    press(ui::Input::Kind::Repeat);
    tap("done");
    ASSERT_TRUE(reach(ui::Step::Review));
    ASSERT_TRUE(hears("Is this you?"));
    tap("accept");
    ASSERT_TRUE(reach(ui::Step::Thanks));
    ASSERT_TRUE(hears("Thank you."));
    EXPECT_NE(last_heard().find("Only said into headphones"), std::string::npos);
    const std::string code = digits_of(kiosk->view().receipt);
    EXPECT_GT(code.size(), 8U);
    std::size_t texts = 0;
    for (std::size_t i = since; i < heard().size(); ++i) {
      const std::string& text = heard()[i].text;
      EXPECT_FALSE(heard()[i].alone);
      EXPECT_EQ(text.find("Qux"), std::string::npos) << text;
      EXPECT_EQ(digits_of(text).find(code.substr(0, 4)), std::string::npos) << text;
      EXPECT_TRUE(text.empty() || text.size() > 3) << "a letter that was typed: " << text;
      texts += text.empty() ? 0 : 1;
    }
    EXPECT_GT(texts, 10U);
    tap("finish");
    kiosk->turn();
    EXPECT_FALSE(kiosk->ui().visit().spoken) << "it ends with the visit";
    const std::size_t then = heard().size();
    tap("start");
    EXPECT_EQ(heard().size(), then);
    tap("leave");
    tap("answer_quiet");
  }

  void the_plug_is_pulled_in_the_middle() {
    speaker->plug(true);
    kiosk->turn();
    ASSERT_NO_FATAL_FAILURE(choose("Start"));
    EXPECT_TRUE(speaker->is_speaking());
    speaker->plug(false);
    EXPECT_TRUE(heard().back().cut);
    const std::size_t then = heard().size();
    for (int i = 0; i < 5; ++i) press(ui::Input::Kind::Next);
    EXPECT_EQ(heard().size(), then) << "nothing goes on from the loudspeaker";
    speaker->plug(true);
    kiosk->turn();
    ASSERT_TRUE(hears("What happens here"));
    press(ui::Input::Kind::Speech);
    EXPECT_FALSE(speaker->is_speaking());
    press(ui::Input::Kind::Speech);
    press(ui::Input::Kind::Louder);
    EXPECT_GT(heard().back().volume_percent, 50) << "and what is heard is heard at once";
    speaker->plug(false);
    kiosk->turn();
    tap("leave");
    tap("answer_quiet");
  }

  test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  KioskArgs args;
  hal::RecordingSpeaker* speaker = nullptr;
  std::pair<std::string, float> shown;  // of the visit's way, and of its portrait's
  std::size_t pressed_at = 0;           // so much had been heard
};

// One test for all, since building the simulated person takes longest.
TEST_F(KioskSpeechTest, FromThePlugToTheCodeByEarAlone) {
  the_plug_is_pulled_in_the_middle();
  ASSERT_NO_FATAL_FAILURE(visit(ui::Language::English, {"A", "d", "a"}));
  ASSERT_NO_FATAL_FAILURE(visit(ui::Language::German, {"Ü", "b", "e"}));
  ASSERT_NO_FATAL_FAILURE(visit(ui::Language::French, {"É", "v", "a"}));
  ASSERT_NO_FATAL_FAILURE(visit(ui::Language::Spanish, {"Ñ", "a", "x"}));
  ASSERT_NO_FATAL_FAILURE(visit(ui::Language::Chinese, {"L", "i", "u"}));
  visit_aloud();
}

}  // namespace
}  // namespace relievo::firmware
