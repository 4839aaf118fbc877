// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// VisitFigures: what a visit cost, frame by frame: touches from "yes" to "thanks", seconds from standing
// still to the face on the screen, frames a second, processor time and memory taken a frame.
//
//   begin() ... the kiosk's turn ... made() ... the renderer ... shown(kiosk)     once a frame
//
// Processor time is the calling thread's. Of the kiosk's turn it is all ours; of the drawing most is the
// GL driver's, which is why the two are told apart. Thread: main. Errors: none.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware/kiosk/kiosk.h"
#include "hal/base/result.h"

namespace relievo::firmware {

class VisitFigures {
 public:
  // How often this thread has taken memory from the heap until now; empty: it is not counted.
  explicit VisitFigures(std::function<long()> allocations = {}) : allocations_(std::move(allocations)) {}

  void begin();
  void made();
  void shown(const Kiosk& kiosk, bool drawn);  // drawn: something had changed

  // Lines for a person, with the bars they are held against.
  std::vector<std::string> lines() const;

 private:
  struct PageCost {
    long frames = 0, drawn = 0;  // without the first ones, which lay out words and fill the atlas
    long waited = 0;
    double turn_s = 0, draw_s = 0, most_turn_s = 0;
    long allocations = 0, allocating_frames = 0;
    std::chrono::steady_clock::time_point from{}, until{};
  };
  static constexpr std::size_t kPages = ui::kSteps.size();
  static std::optional<double> rate(const PageCost& page);
  void follow(const Kiosk& kiosk, std::chrono::steady_clock::time_point now);

  std::function<long()> allocations_;
  std::array<PageCost, kPages> pages_{};
  double begun_s_ = 0, made_s_ = 0;
  long taken_before_ = 0, taken_after_ = 0;
  ui::Step last_ = ui::Step::Starting;
  std::optional<hal::Instant> still_at_, turns_at_;
  std::optional<double> still_to_face_s_;
  std::optional<double> still_to_shot_s_;
  int touches_ = 0;  // until Thanks; 0: it was not reached
};

// Script: what synthetic fingers are to do, read from a file (README.md has its words).
// Thread: main. Errors: NotFound, IoFailed, InvalidInput (with file and line).
struct ScriptAction {
  enum class Kind : std::uint8_t { Wait, Tap, Hold, Drag, Type, Pause, Screenshot, Plug, Unplug };
  Kind kind = Kind::Wait;
  std::string word;    // a state, an id, a text, a name, a folder
  double seconds = 0;  // Wait: at most; Hold, Pause: so long
  float dx_px = 0, dy_px = 0;
  std::string where;  // file and line, for errors
};

Result<std::vector<ScriptAction>> read_script(const std::filesystem::path& file);
// One line; nothing in it is no action.
Result<std::optional<ScriptAction>> read_script_line(const std::string& line, const std::string& where);

// ScriptPlayer: synthetic fingers before a kiosk. Once a frame it does the next thing of its script: it
// finds what is to be touched by its id, as it lies on the screen now, and puts the finger there.
//   while (turn(kiosk, now) is true) { the loop's own work }
// Pixels. Thread: main. Errors of turn(): Timeout (a state was not reached, an id did not come to the
// screen, or lies under something else), InvalidInput (no key for a letter), those of plug.
class ScriptPlayer {
 public:
  struct Hands {
    std::function<void(const ui::Input&)> touch;
    std::function<Result<void>(const std::string& folder)> plug{};  // no name: the stick is pulled
  };
  ScriptPlayer(std::vector<ScriptAction> script, Hands hands)
      : script_(std::move(script)), hands_(std::move(hands)) {}

  // False: the script has ended.
  Result<bool> turn(const Kiosk& kiosk, hal::Instant now);
  // The frame that is drawn next is to be kept under this name.
  std::optional<std::string> take_screenshot() { return std::exchange(screenshot_, std::nullopt); }

 private:
  Result<bool> act(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now);
  Result<bool> touch(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now);
  Result<bool> type(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now);
  void finger(ui::Input::Kind kind) { hands_.touch({kind, 1, x_, y_}); }

  std::vector<ScriptAction> script_;
  Hands hands_;
  std::size_t next_ = 0;
  std::optional<hal::Instant> since_;    // the present action began
  std::optional<hal::Instant> down_at_;  // the finger lies on the glass since
  float x_ = 0, y_ = 0;
  int moved_ = 0;           // steps of a drag
  std::size_t typed_ = 0;   // bytes of the text that are done
  std::size_t turned_ = 0;  // keys tried for one letter that is not on the keyboard
  std::string key_;         // under the finger
  std::optional<std::string> screenshot_;
};

}  // namespace relievo::firmware
