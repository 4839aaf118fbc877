// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/script/script_player.h"

#include <strings.h>

#include <array>
#include <chrono>

namespace relievo::firmware {
namespace {

using Kind = ScriptAction::Kind;
using std::chrono::duration;

constexpr double kOnTheScreenS = 20;  // an id is waited for
constexpr int kDragSteps = 8;
constexpr std::array<const char*, 3> kKeysToTry{"shift", "accents", "shift"};

bool same(std::string_view a, std::string_view b) {
  return a.size() == b.size() && strncasecmp(a.data(), b.data(), a.size()) == 0;
}

bool is_there(std::string_view state, const Kiosk& kiosk) {
  return same(state, ui::name_of(kiosk.ui().visit().step)) || same(state, name_of(kiosk.appliance().state()));
}

// Where a finger would go, if it can.
const ui::Node* touchable(const Kiosk& kiosk, std::string_view id) {
  const ui::Node* node = kiosk.ui().tree().find(id);
  if (node == nullptr) return nullptr;
  const ui::Node* const met =
      kiosk.ui().tree().at(node->rect.x + node->rect.w / 2, node->rect.y + node->rect.h / 2);
  return met != nullptr && met->id == node->id ? node : nullptr;
}

std::size_t letter_bytes(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

}  // namespace

Result<bool> ScriptPlayer::turn(const Kiosk& kiosk, hal::Instant now) {
  if (next_ == script_.size()) return false;
  if (!since_) since_ = now;
  RELIEVO_TRY_ASSIGN(const bool done, act(script_[next_], kiosk, now));
  if (!done) return true;
  ++next_;
  since_.reset();
  typed_ = 0;
  return true;
}

Result<bool> ScriptPlayer::act(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now) {
  const double passed = duration<double>(now - *since_).count();
  switch (action.kind) {
    case Kind::Wait:
      if (is_there(action.word, kiosk)) return true;
      if (passed > action.seconds)
        return Error{Errc::Timeout, "the state was not reached in time"}.at(action.where);
      return false;
    case Kind::Tap:
    case Kind::Hold:
    case Kind::Drag:
      return touch(action, kiosk, now);
    case Kind::Type:
      return type(action, kiosk, now);
    case Kind::Pause:
      return passed >= action.seconds;
    case Kind::Screenshot:
      screenshot_ = action.word;
      return true;
    case Kind::Plug:
    case Kind::Unplug:
      if (!hands_.plug)
        return Error{Errc::Unsupported, "these cameras have no stick that a script could plug"}.at(
            action.where);
      RELIEVO_TRY(hands_.plug(action.word));
      return true;
  }
  return true;
}

// A frame with the finger down, one without: as the screen sees a person.
Result<bool> ScriptPlayer::touch(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now) {
  if (!down_at_) {
    const ui::Node* const node = touchable(kiosk, action.word);
    if (node == nullptr) {
      if (duration<double>(now - *since_).count() > kOnTheScreenS)
        return Error{Errc::Timeout, "is not on the screen, or lies under something"}.at(action.where + ": " +
                                                                                        action.word);
      return false;
    }
    x_ = node->rect.x + node->rect.w / 2;
    y_ = node->rect.y + node->rect.h / 2;
    finger(ui::Input::Kind::Down);
    down_at_ = now;
    moved_ = 0;
    return false;
  }
  if (action.kind == Kind::Drag && moved_ < kDragSteps) {
    ++moved_;
    x_ += action.dx_px / kDragSteps;
    y_ += action.dy_px / kDragSteps;
    finger(ui::Input::Kind::Move);
    return false;
  }
  if (action.kind == Kind::Hold && duration<double>(now - *down_at_).count() < action.seconds) return false;
  finger(ui::Input::Kind::Up);
  down_at_.reset();
  return true;
}

// Letter by letter; for one that is not on the keyboard the other sets of keys are tried.
Result<bool> ScriptPlayer::type(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now) {
  const std::string letter = action.word.substr(typed_, letter_bytes(action.word[typed_]));
  const std::string own = letter == " " ? "space" : "key " + letter;
  if (!down_at_) {
    const ui::Tree& tree = kiosk.ui().tree();
    const bool there = tree.find(own) != nullptr || tree.find("keyboard") == nullptr;
    if (!there && turned_ == kKeysToTry.size())
      return Error{Errc::InvalidInput, "no key of this keyboard has this letter"}.at(action.where + ": " +
                                                                                     letter);
    key_ = there ? own : kKeysToTry[turned_++];
  }
  RELIEVO_TRY_ASSIGN(const bool tapped, touch({Kind::Tap, key_, 0, 0, 0, action.where}, kiosk, now));
  if (!tapped || key_ != own) return false;
  typed_ += letter.size();
  turned_ = 0;
  since_ = now;
  return typed_ >= action.word.size();
}

}  // namespace relievo::firmware
