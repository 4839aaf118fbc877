// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/platform/sdl_display.h"

#include <SDL2/SDL.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
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

struct Key {
  SDL_Keycode sym;
  Input::Kind kind;
};
constexpr Key kKeys[] = {{SDLK_TAB, Input::Kind::Next},           {SDLK_RIGHT, Input::Kind::Right},
                         {SDLK_DOWN, Input::Kind::Below},         {SDLK_LEFT, Input::Kind::Left},
                         {SDLK_UP, Input::Kind::Above},           {SDLK_BACKSPACE, Input::Kind::Erase},
                         {SDLK_DELETE, Input::Kind::Erase},       {SDLK_KP_PERIOD, Input::Kind::Erase},
                         {SDLK_KP_COMMA, Input::Kind::Erase},     {SDLK_RETURN, Input::Kind::Activate},
                         {SDLK_KP_ENTER, Input::Kind::Activate},  {SDLK_F1, Input::Kind::Speech},
                         {SDLK_F2, Input::Kind::Repeat},          {SDLK_KP_0, Input::Kind::Repeat},
                         {SDLK_VOLUMEDOWN, Input::Kind::Quieter}, {SDLK_KP_MINUS, Input::Kind::Quieter},
                         {SDLK_VOLUMEUP, Input::Kind::Louder},    {SDLK_KP_PLUS, Input::Kind::Louder},
                         {SDLK_F3, Input::Kind::Speed},           {SDLK_KP_MULTIPLY, Input::Kind::Speed},
                         {SDLK_ESCAPE, Input::Kind::Back},        {SDLK_AC_BACK, Input::Kind::Back}};

class SdlDisplay final : public Display {
 public:
  ~SdlDisplay() override {
    if (context_ != nullptr) SDL_GL_DeleteContext(context_);
    if (window_ != nullptr) SDL_DestroyWindow(window_);
    SDL_QuitSubSystem(SDL_INIT_VIDEO);  // a speaker may go on
  }

  Result<void> open(const DisplayOptions& options) {
    SDL_SetHint(SDL_HINT_TOUCH_MOUSE_EVENTS, "0");  // a finger is a finger, a mouse a mouse
    SDL_SetHint(SDL_HINT_MOUSE_TOUCH_EVENTS, "0");
    // Without a desktop SDL need not look for one. Its signal handlers stay: they give the console's keyboard
    // back when we crash. Signals that ask us to end are the firmware's, which takes them afterwards.
    if (without_desktop()) SDL_SetHint(SDL_HINT_VIDEODRIVER, "kmsdrm");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) return failed();
    SDL_ShowCursor(
        SDL_DISABLE);  // KMS shows an arrow from the start where a mouse could be; ours comes when one moves
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
    for (const SDL_GLattr channel : {SDL_GL_RED_SIZE, SDL_GL_GREEN_SIZE, SDL_GL_BLUE_SIZE})
      SDL_GL_SetAttribute(channel, 8);
    SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
    const bool whole = options.width_px <= 0 || options.height_px <= 0;
    Uint32 flags = SDL_WINDOW_OPENGL;
    if (whole) flags |= SDL_WINDOW_FULLSCREEN_DESKTOP;
    window_ = SDL_CreateWindow("Relievo", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                               whole ? 1280 : options.width_px, whole ? 800 : options.height_px, flags);
    if (window_ == nullptr) return failed();
    return renew();
  }

  // A driver that is asked to says that its context is lost, and not only that all fails; not every driver
  // can be asked.
  Result<void> renew() override {
    if (context_ != nullptr) SDL_GL_DeleteContext(context_);
    for (const int lets_know : {SDL_GL_CONTEXT_RESET_LOSE_CONTEXT, SDL_GL_CONTEXT_RESET_NO_NOTIFICATION}) {
      SDL_GL_SetAttribute(SDL_GL_CONTEXT_RESET_NOTIFICATION, lets_know);
      context_ = SDL_GL_CreateContext(window_);
      if (context_ != nullptr) break;
    }
    if (context_ == nullptr) return failed();
    SDL_GL_SetSwapInterval(1);
    SDL_StartTextInput();
    return {};
  }

  int width_px() const override { return size().first; }
  int height_px() const override { return size().second; }
  void show() override { SDL_GL_SwapWindow(window_); }

  void push(const Input& finger) override {
    const auto [w, h] = size();
    SDL_Event event{};
    event.type = finger.kind == Input::Kind::Down ? SDL_FINGERDOWN
                 : finger.kind == Input::Kind::Up ? SDL_FINGERUP
                                                  : SDL_FINGERMOTION;
    event.tfinger.fingerId = finger.finger;
    event.tfinger.x = finger.x / float(w);
    event.tfinger.y = finger.y / float(h);
    SDL_PushEvent(&event);
  }

  std::optional<Input> poll() override {
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) {
      if (auto input = input_of(event)) return input;
    }
    return std::nullopt;
  }

 private:
  // A whole screen, and no desktop to ask for it: the machine itself says more than SDL.
  static bool without_desktop() {
    const char* const driver = std::getenv("SDL_VIDEODRIVER");
    if (driver != nullptr) return std::string_view(driver) == "kmsdrm";
    return std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr;
  }

  static Error failed() {
    if (without_desktop()) {
      if (auto why = why_no_screen()) return *why;
    }
    return Error{Errc::LibraryFailed,
                 "no screen can be opened: check SDL_VIDEODRIVER and the graphics driver"}
        .at(SDL_GetError());
  }

  std::pair<int, int> size() const {
    int w = 0, h = 0;
    SDL_GL_GetDrawableSize(window_, &w, &h);
    return {w, h};
  }

  std::optional<Input> finger(Input::Kind kind, const SDL_TouchFingerEvent& touch) const {
    SDL_ShowCursor(SDL_DISABLE);
    const auto [w, h] = size();
    return Input{kind, touch.fingerId, touch.x * float(w), touch.y * float(h)};
  }

  static std::optional<Input> key(const SDL_KeyboardEvent& key) {
    const SDL_Keycode sym = key.keysym.sym;
    const bool digit = sym >= SDLK_KP_1 && sym <= SDLK_KP_9;
    const auto known = std::ranges::find(kKeys, sym, &Key::sym);
    if (!digit && known == std::end(kKeys)) return std::nullopt;
    const bool zero = sym == SDLK_KP_0;
    // A key that is kept down is one press.
    if (key.repeat != 0 && (digit || zero || known->kind == Input::Kind::Activate)) return std::nullopt;
    if (digit) return Input{.kind = Input::Kind::Digit, .letter = {char('1' + (sym - SDLK_KP_1))}};
    const bool backwards = sym == SDLK_TAB && (key.keysym.mod & KMOD_SHIFT) != 0;
    Input input{backwards ? Input::Kind::Previous : known->kind};
    if (zero) input.letter = {'0'};
    return input;
  }

  // What a key of the keypad is for, its key says; the text it makes beside says nothing.
  std::optional<Input> letter(const SDL_TextInputEvent& text) const {
    const std::string_view typed(text.text);
    Input input{Input::Kind::Letter};
    if (from_keypad_ || typed.empty() || typed.size() >= input.letter.size()) return std::nullopt;
    typed.copy(input.letter.data(), typed.size());
    return input;
  }

  std::optional<Input> input_of(const SDL_Event& event) {
    switch (event.type) {
      case SDL_QUIT: return Input{Input::Kind::Quit};
      case SDL_FINGERDOWN: return finger(Input::Kind::Down, event.tfinger);
      case SDL_FINGERMOTION: return finger(Input::Kind::Move, event.tfinger);
      case SDL_FINGERUP: return finger(Input::Kind::Up, event.tfinger);
      case SDL_KEYDOWN:
        from_keypad_ = (event.key.keysym.mod & KMOD_NUM) != 0 &&
                       event.key.keysym.scancode >= SDL_SCANCODE_KP_DIVIDE &&
                       event.key.keysym.scancode <= SDL_SCANCODE_KP_PERIOD;
        return key(event.key);
      case SDL_TEXTINPUT: return letter(event.text);
      case SDL_MOUSEBUTTONDOWN:
      case SDL_MOUSEBUTTONUP:
        if (event.button.button != SDL_BUTTON_LEFT) return std::nullopt;
        held_ = event.type == SDL_MOUSEBUTTONDOWN;
        return Input{held_ ? Input::Kind::Down : Input::Kind::Up, kMouse, float(event.button.x),
                     float(event.button.y)};
      case SDL_MOUSEMOTION:
        SDL_ShowCursor(SDL_ENABLE);
        if (!held_) return std::nullopt;
        return Input{Input::Kind::Move, kMouse, float(event.motion.x), float(event.motion.y)};
      default: return std::nullopt;
    }
  }

  SDL_Window* window_ = nullptr;
  SDL_GLContext context_ = nullptr;
  bool held_ = false;
  bool from_keypad_ = false;  // the key whose text comes next
};

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

Result<std::unique_ptr<Display>> open_sdl_display(const DisplayOptions& options) {
  auto display = std::make_unique<SdlDisplay>();
  RELIEVO_TRY(display->open(options));
  return std::unique_ptr<Display>(std::move(display));
}

}  // namespace relievo::ui
