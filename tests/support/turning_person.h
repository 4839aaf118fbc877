// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Somebody who turns their head as they are told, a moment later, at a speed and with a tremor of their own,
// and with the manners of their kind. Thread: one at a time. Errors: none.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "pipeline/model/advice.h"
#include "pipeline/model/vector3.h"

namespace relievo::test {

class TurningPerson {
 public:
  enum class Kind : std::uint8_t {
    Willing,
    Hasty,         // 60 to 120 degrees a second
    BackAndForth,  // shakes the head for a while before listening, and looks about now and then
    WrongWay,      // for three seconds
    Accompanied,   // a second face looks in from behind for a while
    OneSide,       // turns to the picture's left alone
    Leaves,
    Count
  };
  static constexpr bool is_willing(Kind kind) { return kind != Kind::OneSide && kind != Kind::Leaves; }

  TurningPerson(Kind kind, std::uint32_t seed)
      : kind_(kind),
        random_(seed),
        speed_deg_s_(between(12, 45)),
        reaction_s_(between(0.25, 0.8)),
        sway_mm_s_(between(1, 6)) {
    if (kind == Kind::Hasty) speed_deg_s_ = between(60, 120);
    if (kind == Kind::BackAndForth) deaf_s_ = between(3, 8), speed_deg_s_ = between(40, 90);
    friend_goes_s_ = between(4, 20);
  }
  Kind kind() const { return kind_; }
  bool is_gone() const { return kind_ == Kind::Leaves && at_s_ > 6; }
  bool has_company() const { return kind_ == Kind::Accompanied && at_s_ > 1.5 && at_s_ < friend_goes_s_; }
  double yaw_deg() const { return yaw_deg_; }
  const pipeline::Vec3d& shift_mm() const { return shift_mm_; }

  // `seconds` pass while this is on the page.
  void hear(pipeline::TurnAdvice advice, double seconds) {
    using pipeline::TurnAdvice;
    at_s_ += seconds;
    if (advice != heard_) {
      // Who has to come back goes slower.
      const bool turns_round = (advice == TurnAdvice::ToLeft && goal_deg_s_ > 0) ||
                               (advice == TurnAdvice::ToRight && goal_deg_s_ < 0);
      if (turns_round) speed_deg_s_ = std::max(8.0, 0.6 * speed_deg_s_);
      heard_ = advice, heard_s_ = 0;
    }
    heard_s_ += seconds;
    if (at_s_ < deaf_s_) {
      if (std::abs(yaw_deg_) > 40 || goal_deg_s_ == 0)
        goal_deg_s_ = yaw_deg_ > 0 ? -speed_deg_s_ : speed_deg_s_;
    } else {
      if (kind_ == Kind::BackAndForth && at_s_ - whim_s_ > 4) whim_s_ = at_s_, heard_s_ = -0.7;
      if (heard_s_ > reaction_s_) obey(heard_);
    }
    if (kind_ == Kind::OneSide) goal_deg_s_ = std::min(goal_deg_s_, yaw_deg_ > -1 ? 0.0 : goal_deg_s_);
    rate_deg_s_ += std::clamp(goal_deg_s_ - rate_deg_s_, -250 * seconds, 250 * seconds);
    yaw_deg_ = std::clamp(yaw_deg_ + rate_deg_s_ * seconds, -70.0, 70.0);
    for (double* axis : {&shift_mm_.x, &shift_mm_.y, &shift_mm_.z})
      *axis += between(-1, 1) * sway_mm_s_ * seconds;
  }
  double between(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

 private:
  void obey(pipeline::TurnAdvice advice) {
    using pipeline::TurnAdvice;
    const double way = kind_ == Kind::WrongWay && at_s_ < 3 ? -1 : 1;
    if (advice == TurnAdvice::ToLeft) goal_deg_s_ = -way * speed_deg_s_;
    if (advice == TurnAdvice::ToRight) goal_deg_s_ = way * speed_deg_s_;
    if (advice == TurnAdvice::Slower) goal_deg_s_ *= 0.5;
    if (advice == TurnAdvice::Hold || advice == TurnAdvice::Done) goal_deg_s_ = 0;
  }

  Kind kind_;
  std::mt19937 random_;
  double speed_deg_s_, reaction_s_, sway_mm_s_, friend_goes_s_ = 0, deaf_s_ = 0;
  pipeline::TurnAdvice heard_ = pipeline::TurnAdvice::Done;
  double at_s_ = 0, heard_s_ = 0, whim_s_ = 0;
  double yaw_deg_ = 0, rate_deg_s_ = 0, goal_deg_s_ = 0;
  pipeline::Vec3d shift_mm_{};
};

}  // namespace relievo::test
