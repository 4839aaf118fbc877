// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/touch_trial.h"

#include <cmath>

namespace relievo::firmware {
namespace {

using ui::TouchStep;
using ui::TouchVerdict;

constexpr float kMet = 0.04F;  // of the screen, either way: half a button

}  // namespace

Result<void> TouchTrial::look() {
  RELIEVO_TRY_ASSIGN(const std::string kept, store_.setting(kTouchSetting));
  map_ = {};
  if (!kept.empty()) {
    if (const auto map = ui::parse_touch_map(kept)) map_ = *map;
    else log_.fault(map.error());
  }
  saved_ = map_;
  view_.corrected = !map_.is_plain();
  return {};
}

ui::Input TouchTrial::placed(ui::Input input, int width_px, int height_px) const {
  if (map_.is_plain()) return input;
  const auto w = float(width_px), h = float(height_px);
  const ui::TouchPoint at = map_({input.x / w, input.y / h});
  input.x = at.x * w;
  input.y = at.y * h;
  return input;
}

void TouchTrial::begin() {
  crosses_.clear();
  view_ = {};
  view_.step = TouchStep::Cross;
  view_.corrected = !map_.is_plain();
  wait();
}

void TouchTrial::end(TouchVerdict verdict) {
  view_.step = TouchStep::Rest;
  view_.cross = 0;
  view_.verdict = verdict;
  view_.corrected = !map_.is_plain();
}

void TouchTrial::touched(ui::TouchPoint at, ui::TouchPoint cross) {
  wait();
  if (view_.step == TouchStep::Cross) {
    crosses_.push_back({at, cross});
    if (++view_.cross == ui::kTouchFitted) fit();
    return;
  }
  if (view_.step != TouchStep::Test) return;
  const ui::TouchPoint met = view_.fit->map(at);
  if (std::abs(met.x - cross.x) > kMet || std::abs(met.y - cross.y) > kMet) return end(TouchVerdict::Missed);
  keep(view_.fit->map, TouchVerdict::Kept);
}

void TouchTrial::fit() {
  const auto found = ui::fit_touch_map(crosses_);
  if (!found) return end(TouchVerdict::Misfit);
  view_.fit = *found;
  view_.step = TouchStep::Test;
}

void TouchTrial::take_plain() {
  if (takes_fingers()) return;
  view_.fit.reset();
  keep({}, TouchVerdict::Plain);
}

// It holds at once; what cannot be written does not hold.
void TouchTrial::keep(const ui::TouchMap& map, TouchVerdict verdict) {
  map_ = map;
  end(verdict);
  side_tasks_.send(
      JobLane::Keeper,
      [this, text = text_of(map)](JobControl&) { return store_.set_setting(kTouchSetting, text); },
      [this, map](const std::optional<Error>& error) {
        --writes_;
        if (!error) {
          saved_ = map;
          return log_.say(map.is_plain() ? ui::LogEvent::TouchPlain : ui::LogEvent::TouchCorrected);
        }
        log_.fault(*error);
        if (writes_ > 0) return;  // a newer one decides
        map_ = saved_;
        if (!takes_fingers()) end(TouchVerdict::NotSaved);  // else another trial is under way
      },
      SideTasks::Whose::Device);
  ++writes_;
}

void TouchTrial::turn() {
  if (!takes_fingers()) return;
  const auto left = std::chrono::ceil<std::chrono::seconds>(until_ - clock_.now()).count();
  view_.seconds_left = int(std::max<std::int64_t>(0, left));
  if (left <= 0) end(TouchVerdict::NobodyTouched);
}

}  // namespace relievo::firmware
