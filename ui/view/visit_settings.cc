// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a visit looks and sounds: when it begins, as the staff has set it, and silent but for who brings
// headphones; and what moves by itself.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ui/view/visit.h"

namespace relievo::ui {
namespace {

constexpr float kBirthS = 2.2F, kTurnS = 16, kTurnDeg = 28;  // there and back once
constexpr float kLooksDeg = 27;
constexpr float kLookedAtHz = 30;  // so often the head that invites is drawn anew: it moves all day
constexpr std::chrono::seconds kReads{10};

float seconds(hal::Instant::duration time) { return std::chrono::duration<float>(time).count(); }
// Begins and ends at rest.
float eased(float share) { return share * share * (3 - 2 * share); }

}  // namespace

FaceLook Visit::shown_look(hal::Instant now) const {
  if (step == Step::Attract) return invitation(now);
  if (!by_itself_) return look;
  FaceLook moved = look;
  const float since = seconds(now - entered_), turning = since - kBirthS;
  moved.born = eased(std::clamp(since / kBirthS, 0.0F, 1.0F));
  if (turning > 0)
    moved.yaw_deg =
        kTurnDeg * std::sin(2 * std::numbers::pi_v<float> * turning / kTurnS) * std::min(1.0F, turning / 2);
  return moved;
}

// Nobody is near and nobody was: the page that invites rests.
bool Visit::rests(hal::Instant now) const {
  return step == Step::Attract && !near_ && now - std::max(near_until_, last_touch_) > kReads;
}

// The head that invites sees who comes near, then looks to and fro; it stands still while somebody is at the
// screen and reads.
FaceLook Visit::invitation(hal::Instant now) const {
  FaceLook head{.yaw_deg = -kLooksDeg, .pitch_deg = 9, .zoom = 1.12F, .light_deg = -40};
  if (!settings_.is_on(Setting::Motion) || rests(now)) return head;
  const float seen = seconds(now - came_near_);
  const float since =
      std::floor(std::min(seconds(now - last_touch_ - kReads), seen) * kLookedAtHz) / kLookedAtHz;
  if (since > 0) head.yaw_deg *= std::cos(2 * std::numbers::pi_v<float> * since / kTurnS);
  return head;
}

void Visit::follow_presence(const ViewState& view) {
  if (view.somebody_near) near_until_ = view.now;
  if (std::exchange(near_, view.somebody_near) != view.somebody_near && near_) came_near_ = view.now;
}

void Visit::look_as_set() {
  language = home_;
  const auto size = std::find(kTextPercents.begin(), kTextPercents.end(), settings_.of(Setting::TextPercent));
  text_size = static_cast<std::size_t>(size - kTextPercents.begin()) % kTextPercents.size();
  high_contrast = settings_.is_on(Setting::Contrast);
  reach = Reach::Usual;
  spoken = headphones_;
  volume = kUsualVolume;
  speed = kUsualSpeed;
}

bool Visit::looks_as_set() const {
  return language == home_ && text_percent() == settings_.of(Setting::TextPercent) &&
         high_contrast == settings_.is_on(Setting::Contrast) && reach == Reach::Usual &&
         spoken == headphones_ && volume == kUsualVolume && speed == kUsualSpeed;
}

// Who plugs headphones in is spoken to; who pulls them out is not, lest others hear it.
void Visit::follow_headphones(const ViewState& view) {
  voices_ = (view.languages & view.voices).any();
  const bool heard = view.headphones && voices_;
  if (std::exchange(headphones_, heard) != heard) {
    spoken = heard;
    touched(view.now);
  }
  spoken = spoken && voices_;
}

void Visit::hear(ActionKind kind) {
  if (kind == ActionKind::Speech) spoken = !spoken && voices_;
  if (kind == ActionKind::Quieter && volume > 0) --volume;
  if (kind == ActionKind::Louder) volume = std::min(volume + 1, kVolumePercents.size() - 1);
  if (kind == ActionKind::Speed) speed = (speed + 1) % kSpeedPercents.size();
}

// What the staff has chosen is seen at once where nobody's visit has begun.
void Visit::follow_settings(const ViewState& view) {
  const bool other = settings_ != view.settings;
  settings_ = view.settings;
  if (other && (step == Step::Attract || step == Step::Starting)) look_as_set();
}

}  // namespace relievo::ui
