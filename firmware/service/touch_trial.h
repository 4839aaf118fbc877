// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TouchTrial: the touch screen's correction that is in force, and the way to another one. While crosses are
// to be touched every finger belongs to the trial, so that a wrong one presses nothing; keypad and mouse go
// on. A new correction is in force only after a finger has met a cross by it; a trial that nobody goes on
// with ends by itself and changes nothing.
//
//   Rest --begin--> Cross x 4 --fits--> Test --met--> kept        15 s without a touch, a misfit, a miss -->
//   Rest
//
// Thread: main; it is written on the keeper. Errors of look(): the store's.
#pragma once

#include <vector>

#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "storage/store.h"
#include "ui/device/touch_map.h"
#include "ui/display.h"

namespace relievo::firmware {

inline constexpr const char* kTouchSetting = "touch";
inline constexpr std::chrono::seconds kTouchPatience{15};  // for each cross

class TouchTrial {
 public:
  TouchTrial(storage::Store& store, SideTasks& side_tasks, EventLog& log, const hal::Clock& clock)
      : store_(store), side_tasks_(side_tasks), log_(log), clock_(clock) {}

  // Before any thread uses the store. A correction that cannot be read is told in the log; the panel is then
  // taken as it is.
  Result<void> look();
  // Where on the screen a finger was, by the correction in force.
  ui::Input placed(ui::Input input, int width_px, int height_px) const;
  bool takes_fingers() const { return view_.step != ui::TouchStep::Rest; }
  // As the panel tells it, while takes_fingers(); the middle of the cross that is shown. Shares of the
  // screen.
  void touched(ui::TouchPoint at, ui::TouchPoint cross);

  void begin();
  void take_plain();
  void abandon() { end(ui::TouchVerdict::None); }
  void turn();
  const ui::TouchView& view() const { return view_; }

 private:
  void wait() { until_ = clock_.now() + kTouchPatience; }
  void end(ui::TouchVerdict verdict);
  void fit();
  void keep(const ui::TouchMap& map, ui::TouchVerdict verdict);

  storage::Store& store_;
  SideTasks& side_tasks_;
  EventLog& log_;
  const hal::Clock& clock_;
  ui::TouchMap map_, saved_;
  int writes_ = 0;  // on their way
  std::vector<ui::TouchedCross> crosses_;
  hal::Instant until_{};
  ui::TouchView view_;
};

}  // namespace relievo::firmware
