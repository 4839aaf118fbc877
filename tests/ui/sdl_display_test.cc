// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fingers, mouse and keypad as SDL reports them, through the real event queue, without a screen.
#include <SDL2/SDL.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/ui/quiet_driver.h"
#include "ui/platform/sdl_display.h"

namespace relievo::ui {
namespace {

class SdlDisplayTest : public testing::Test {
 protected:
  void SetUp() override {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    const auto open = [] {
      const QuietDriver quiet;
      return open_sdl_display({640, 480});
    };
    auto opened = open();
    ASSERT_TRUE(opened.has_value()) << opened.error().where();
    display = std::move(*opened);
    while (display->poll()) {
    }
  }
  static void push_finger(Uint32 type, float x, float y) {
    SDL_Event event{};
    event.type = type;
    event.tfinger.fingerId = 3;
    event.tfinger.x = x;
    event.tfinger.y = y;
    SDL_PushEvent(&event);
  }
  static void push_key(SDL_Keycode key, Uint16 with = 0) {
    SDL_Event event{};
    event.type = SDL_KEYDOWN;
    event.key.keysym.sym = key;
    event.key.keysym.mod = with;
    SDL_PushEvent(&event);
  }
  std::unique_ptr<Display> display;
};

// A kiosk without a mouse must not show an arrow; who moves a mouse has to see it.
TEST_F(SdlDisplayTest, TheArrowIsThereWhileAMouseMovesAndGoesWithAFinger) {
  EXPECT_EQ(SDL_ShowCursor(SDL_QUERY), SDL_DISABLE);
  SDL_Event moved{};
  moved.type = SDL_MOUSEMOTION;
  SDL_PushEvent(&moved);
  EXPECT_FALSE(display->poll().has_value());
  EXPECT_EQ(SDL_ShowCursor(SDL_QUERY), SDL_ENABLE);
  push_finger(SDL_FINGERDOWN, 0.5F, 0.25F);
  EXPECT_TRUE(display->poll().has_value());
  EXPECT_EQ(SDL_ShowCursor(SDL_QUERY), SDL_DISABLE);
}

TEST_F(SdlDisplayTest, AFingerIsToldInPixels) {
  push_finger(SDL_FINGERDOWN, 0.5F, 0.25F);
  push_finger(SDL_FINGERMOTION, 1.0F, 0.5F);
  push_finger(SDL_FINGERUP, 1.0F, 0.5F);
  for (const Input::Kind kind : {Input::Kind::Down, Input::Kind::Move, Input::Kind::Up}) {
    const auto input = display->poll();
    ASSERT_TRUE(input.has_value());
    EXPECT_EQ(input->kind, kind);
    EXPECT_EQ(input->finger, 3);
    EXPECT_FLOAT_EQ(input->x, kind == Input::Kind::Down ? 320 : 640);
    EXPECT_FLOAT_EQ(input->y, kind == Input::Kind::Down ? 120 : 240);
  }
}

TEST_F(SdlDisplayTest, ASyntheticFingerComesBackAsItWas) {
  for (const Input::Kind kind : {Input::Kind::Down, Input::Kind::Move, Input::Kind::Up}) {
    display->push({kind, 5, 96, 240});
    auto input = display->poll();
    if (!input) input = display->poll();  // SDL ends one round of polling before what came after it began
    ASSERT_TRUE(input.has_value());
    EXPECT_EQ(input->kind, kind);
    EXPECT_EQ(input->finger, 5);
    EXPECT_FLOAT_EQ(input->x, 96);
    EXPECT_FLOAT_EQ(input->y, 240);
  }
}

TEST_F(SdlDisplayTest, AKeypadIsEnough) {
  push_key(SDLK_TAB);
  push_key(SDLK_TAB, KMOD_LSHIFT);
  push_key(SDLK_a);  // says nothing
  push_key(SDLK_RETURN);
  push_key(SDLK_ESCAPE);
  for (const Input::Kind kind :
       {Input::Kind::Next, Input::Kind::Previous, Input::Kind::Activate, Input::Kind::Back}) {
    const auto input = display->poll();
    ASSERT_TRUE(input.has_value());
    EXPECT_EQ(input->kind, kind);
  }
  EXPECT_FALSE(display->poll());
}

// A key of the keypad makes a text, too, as a keyboard's does: it says one thing.
TEST_F(SdlDisplayTest, LettersArriveAndAKeypadsDigitIsADigit) {
  const auto text = [](const char* words) {
    SDL_Event event{};
    event.type = SDL_TEXTINPUT;
    SDL_strlcpy(event.text.text, words, sizeof event.text.text);
    SDL_PushEvent(&event);
  };
  const auto is = [this](Input::Kind kind, std::string_view letter) {
    const auto input = display->poll();
    ASSERT_TRUE(input.has_value()) << letter;
    EXPECT_EQ(input->kind, kind);
    EXPECT_EQ(std::string_view(input->letter.data()), letter);
  };
  push_key(SDLK_e);
  text("é");
  SDL_Event keypad{};
  keypad.type = SDL_KEYDOWN;
  keypad.key.keysym = {SDL_SCANCODE_KP_7, SDLK_KP_7, KMOD_NUM, 0};
  SDL_PushEvent(&keypad);
  text("7");
  push_key(SDLK_7);
  text("7");
  push_key(SDLK_BACKSPACE);
  push_key(SDLK_LEFT);
  push_key(SDLK_DOWN);
  is(Input::Kind::Letter, "é");
  is(Input::Kind::Digit, "7");
  is(Input::Kind::Letter, "7");
  is(Input::Kind::Erase, "");
  is(Input::Kind::Left, "");
  is(Input::Kind::Below, "");
  EXPECT_FALSE(display->poll());
}

TEST_F(SdlDisplayTest, WhatIsHeardHasKeys) {
  for (const SDL_Keycode key : {SDLK_F1, SDLK_F2, SDLK_KP_0, SDLK_VOLUMEDOWN, SDLK_KP_MINUS, SDLK_VOLUMEUP,
                                SDLK_KP_PLUS, SDLK_F3, SDLK_KP_MULTIPLY})
    push_key(key);
  using enum Input::Kind;
  const std::pair<Input::Kind, std::string_view> heard[] = {{Speech, ""},  {Repeat, ""},  {Repeat, "0"},
                                                            {Quieter, ""}, {Quieter, ""}, {Louder, ""},
                                                            {Louder, ""},  {Speed, ""},   {Speed, ""}};
  for (const auto& [kind, letter] : heard) {
    const auto input = display->poll();
    ASSERT_TRUE(input.has_value());
    EXPECT_EQ(input->kind, kind);
    EXPECT_EQ(std::string_view(input->letter.data()), letter);
  }
}

TEST_F(SdlDisplayTest, AMouseThatOnlyPassesIsNoFinger) {
  SDL_Event event{};
  event.type = SDL_MOUSEMOTION;
  SDL_PushEvent(&event);
  EXPECT_FALSE(display->poll());
}

}  // namespace
}  // namespace relievo::ui
