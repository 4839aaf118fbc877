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
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware/kiosk/kiosk.h"

namespace relievo::firmware {

class VisitFigures {
 public:
  // How often this thread has taken memory from the heap until now; empty: it is not counted.
  explicit VisitFigures(std::function<long()> allocations = {}) : allocations_(std::move(allocations)) {}

  void begin();
  void made();
  void shown(const Kiosk& kiosk, bool drawn);  // drawn: something had changed

  int touches() const { return touches_; }  // until Thanks; 0: it was not reached
  std::optional<double> still_to_face_s() const { return still_to_face_s_; }
  std::optional<double> live_frames_a_second() const { return rate(page(ui::Step::Position)); }
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
  static constexpr std::size_t kPages = ui::kStepNames.size();
  const PageCost& page(ui::Step step) const { return pages_[std::size_t(step)]; }
  static std::optional<double> rate(const PageCost& page);
  void follow(const Kiosk& kiosk, std::chrono::steady_clock::time_point now);

  std::function<long()> allocations_;
  std::array<PageCost, kPages> pages_{};
  double begun_s_ = 0, made_s_ = 0;
  long taken_before_ = 0, taken_after_ = 0;
  ui::Step last_ = ui::Step::Starting;
  std::optional<hal::Instant> still_at_;
  std::optional<double> still_to_face_s_;
  std::optional<double> still_to_shot_s_;
  int touches_ = 0;
};

}  // namespace relievo::firmware
