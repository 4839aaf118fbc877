// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/firmware/kiosk/ear_visit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

#include "firmware/capture/live_judge.h"
#include "firmware/kiosk/kiosk.h"
#include "tests/support/made_screen.h"
#include "tests/support/manual_clock.h"
#include "tests/support/recording_speaker.h"

namespace relievo::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNeckMm = 95;  // from the axis of the neck to the middle of the face

// Where somebody is told to go. Their right is the picture's left. Way 0: what to change is said, not which
// way; no axis: to stay.
struct Order {
  const char* words;
  double Stance::*axis;
  double way;
};
constexpr std::array kOrders{
    Order{"Move a little to your right", &Stance::right, -1},
    Order{"Move a little to your left", &Stance::right, 1},
    Order{"A little higher, please", &Stance::down, -1},
    Order{"A little lower, please", &Stance::down, 1},
    Order{"Please step back a little", &Stance::away, 1},
    Order{"Please come a little closer", &Stance::away, -1},
    Order{"Turn your head slowly to your right", &Stance::yaw, -1},
    Order{"Turn your head slowly to your left", &Stance::yaw, 1},
    Order{"Please look straight ahead", &Stance::yaw, 0},
    Order{"Raise your chin a little", &Stance::pitch, -1},
    Order{"Lower your chin a little", &Stance::pitch, 1},
    Order{"Lean your head a little to your right", &Stance::roll, -1},
    Order{"Lean your head a little to your left", &Stance::roll, 1},
    Order{"Please hold still", nullptr, 0},
    Order{"Very good. Look straight ahead and hold still", nullptr, 0},
};

bool is_angle(double Stance::*axis) {
  return axis == &Stance::yaw || axis == &Stance::pitch || axis == &Stance::roll;
}

}  // namespace

BlindVisitor::BlindVisitor(std::uint32_t seed)
    : random_(seed), reaction_s_(between(0.3, 0.9)), stride_(between(0.6, 1.5)), haste_(between(0.6, 1.4)) {}

// An order is understood when it is nearly said to its end; one that is cut short before is not.
void BlindVisitor::hear(const std::string& words, double at_s) {
  constexpr double kPerByteS = 0.065, kNearlyAll = 0.8;
  std::size_t last = std::string::npos;
  acts_s_ = 1e9;
  for (const Order& order : kOrders) {
    const std::size_t at = words.rfind(order.words);
    if (at == std::string::npos || (last != std::string::npos && at < last)) continue;
    last = at;
    told_ = order.words;
    acts_s_ =
        at_s +
        kPerByteS * (static_cast<double>(at) + kNearlyAll * static_cast<double>(std::strlen(order.words))) +
        reaction_s_ * between(0.7, 1.3);
  }
  if (last == std::string::npos) {
    told_ = words;
    acts_s_ = at_s + kPerByteS * kNearlyAll * static_cast<double>(words.size()) + reaction_s_;
  }
}

void BlindVisitor::hear_tone(double pitch, double at_s) { tone_s_ = at_s, pitch_ = pitch; }

// "A little" is 3 to 8 cm, or 6 to 14 degrees, to one more and to another less.
void BlindVisitor::step(double Stance::*axis, double way) {
  const bool turns = is_angle(axis);
  axis_ = axis, way_ = way;
  left_ = stride_ * (turns ? between(6, 14) : between(30, 80));
  speed_ = haste_ * (turns ? between(12, 30) : between(60, 160));
  pitch_before_ = pitch_;
  again_s_ = 1e9;
}

void BlindVisitor::obey() {
  left_ = 0;
  for (const Order& order : kOrders) {
    if (told_ != order.words) continue;
    if (order.axis == nullptr) axis_ = nullptr;
    else step(order.axis, order.way != 0 ? order.way : either());
    return;
  }
  // Not seen: anywhere may be better. Whatever else is said, of light or glasses, moves nobody.
  constexpr std::array kAnywhere{&Stance::right, &Stance::down, &Stance::away, &Stance::yaw, &Stance::pitch};
  if (told_.find("do not see your face") != std::string::npos)
    step(kAnywhere[random_() % kAnywhere.size()], either());
}

// While it sounds the place is not reached: after a step another one, shorter where the tone is high. Where
// it has stopped they stop; where it has fallen they wait for words.
void BlindVisitor::follow_tone(double at_s) {
  const bool sounds = at_s - tone_s_ < 0.7;
  if (!sounds) {
    if (pitch_ > 0 && at_s - tone_s_ > 0.5 + reaction_s_) left_ = 0, pitch_ = 0;
    return;
  }
  if (axis_ == nullptr || left_ > 0 || acts_s_ < 1e9) return;
  if (again_s_ > 1e8) again_s_ = at_s + reaction_s_ + between(0, 0.4);
  if (at_s < again_s_ || pitch_ < pitch_before_ - 0.05) return;
  step(axis_, way_);
  left_ *= pitch_ > 1.5 ? 0.4 : 0.8;
}

Stance BlindVisitor::move(double until_s, const Stance& from) {
  Stance at = from;
  const double seconds = until_s - now_s_;
  now_s_ = until_s;
  if (acts_s_ <= until_s) acts_s_ = 1e9, obey();
  follow_tone(until_s);
  if (axis_ != nullptr && left_ > 0) {
    // The last of a step is slower; it goes on a little past where it should have ended, or ends before.
    const double go = std::min(left_, seconds * std::min(speed_, 0.25 * speed_ + 2.5 * left_));
    at.*axis_ += way_ * go * between(0.8, 1.25);
    left_ -= go;
    if (left_ < 0.02 * speed_) left_ = 0;
  }
  const auto sway = [&](double Stance::*axis, double deviation, double slow_s) {
    const double share = std::min(1.0, seconds / slow_s), was = sway_.*axis;
    sway_.*axis += -share * was + deviation * std::sqrt(2 * share) * std::normal_distribution<>()(random_);
    at.*axis += sway_.*axis - was;
  };
  sway(&Stance::right, 4, 2), sway(&Stance::away, 5, 2), sway(&Stance::down, 2, 2);
  sway(&Stance::yaw, 0.8, 1.2), sway(&Stance::pitch, 0.8, 1.2), sway(&Stance::roll, 0.5, 1.2);
  const double breath = 2 * std::numbers::pi * 0.25;
  at.down += 1.5 * (std::sin(breath * until_s) - std::sin(breath * (until_s - seconds)));
  return at;
}

namespace {

Stance wrong_stance(std::mt19937& random) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  Stance s;
  s.away = between(340, 900);
  // The middle of the face is in the picture, if only just.
  s.right = between(-0.28, 0.28) * s.away, s.down = between(-0.17, 0.17) * s.away;
  const auto facing = standing(s.away, s.right, s.down);
  s.yaw = facing.yaw_deg + between(-35, 35), s.pitch = facing.pitch_deg + between(-25, 25);
  s.roll = between(-25, 25);
  return s;
}

// A stance is where the face was, had it not turned: it turns about the neck.
hal::sim::HeadPose pose_of(const Stance& s) {
  hal::sim::HeadPose pose = standing(s.away, s.right, s.down);
  const double yaw = s.yaw * kDegree, pitch = s.pitch * kDegree;
  pose.right_mm += kNeckMm * std::sin(yaw);
  pose.down_mm += kNeckMm * std::sin(pitch);
  pose.distance_mm += kNeckMm * (1 - std::cos(yaw) * std::cos(pitch));
  pose.yaw_deg = s.yaw, pose.pitch_deg = s.pitch, pose.roll_deg = s.roll;
  return pose;
}

// The kiosk's page and its voice, without camera and store.
struct Page {
  hal::ManualClock clock;
  hal::RecordingSpeaker* speaker = new hal::RecordingSpeaker(clock, {"en"});
  std::unique_ptr<ui::Ui> screen = make_screen();
  firmware::Voice voice{std::unique_ptr<hal::Speaker>(speaker)};
  ui::ViewState view;

  Page() {
    speaker->plug(true);
    show(ui::Screen::Idle);
    show(ui::Screen::Position);
  }
  // True: the picture is to be taken.
  bool show(ui::Screen now) {
    view.screen = now;
    view.now = clock.now();
    voice.look(view);
    screen->frame(view);
    if (voice.turn(*screen, view)) screen->visit().listens(view.now);
    bool taken = false;
    while (const auto intent = screen->take_intent()) taken = taken || *intent == ui::Intent::Begin;
    return taken;
  }
};

}  // namespace

std::string print(const Stance& s) {
  char text[120];
  std::snprintf(text, sizeof text, "right %.0f down %.0f away %.0f mm, yaw %.0f pitch %.0f roll %.0f",
                s.right, s.down, s.away, s.yaw, s.pitch, s.roll);
  return text;
}

EarVisit visit_by_ear(std::uint32_t seed, Album& album, GateFixture& gate) {
  using namespace std::chrono_literals;
  constexpr auto kLook = 240ms;
  std::mt19937 random(seed * 7919 + 1);
  EarVisit made;
  made.first = made.last = wrong_stance(random);
  BlindVisitor visitor(seed);
  Page page;
  pipeline::GateHistory history;
  const hal::Instant begin = page.clock.now();
  const auto seconds = [&](hal::Instant at) { return std::chrono::duration<double>(at - begin).count(); };
  std::size_t told = 0;
  while (made.seconds < kEarVisitS && !made.captured) {
    Developing how;
    how.noise_seed = random();
    const Shot shot = album.photograph(301 + seed % 5, pose_of(made.last));
    const auto taken = page.clock.now();
    const auto look = gate.look(album, shot, how, taken.time_since_epoch(), history);
    ui::LiveView live = firmware::guidance_of(look.answer, album.calibration(), look.relief);
    live.number = page.view.live.number + 1;
    for (int frame = 0; frame < 3 && !made.captured; ++frame) {
      page.clock.advance(kLook / 3);
      page.view.live = live;
      made.captured = page.show(ui::Screen::Position);
    }
    for (const auto& heard = page.speaker->heard(); told < heard.size(); ++told) {
      const auto& one = heard[told];
      if (one.text.empty() && one.sound == hal::Sound::Guide) visitor.hear_tone(one.pitch, seconds(one.at));
      if (one.text.empty()) continue;
      visitor.hear(one.text, seconds(one.at));
      char line[400];
      std::snprintf(line, sizeof line, "%5.1f s  %.200s  [%s]\n", seconds(one.at), one.text.c_str(),
                    print(made.last).c_str());
      made.heard += line;
    }
    made.seconds = seconds(page.clock.now());
    made.last = visitor.move(made.seconds, made.last);
  }
  return made;
}

}  // namespace relievo::test
