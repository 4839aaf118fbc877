// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/script/visit_figures.h"

#include <time.h>

#include <algorithm>
#include <cstdio>

namespace relievo::firmware {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

constexpr long kSettling = 10;  // frames of a page before it is as it stays

double thread_seconds() {
  timespec at{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
  return double(at.tv_sec) + 1e-9 * double(at.tv_nsec);
}

template <typename... Numbers>
std::string line(const char* words, Numbers... numbers) {
  char text[200];
  std::snprintf(text, sizeof text, words, numbers...);
  return text;
}

}  // namespace

void VisitFigures::begin() {
  taken_before_ = allocations_ ? allocations_() : 0;
  begun_s_ = thread_seconds();
}

void VisitFigures::made() {
  made_s_ = thread_seconds();
  taken_after_ = allocations_ ? allocations_() : 0;
}

void VisitFigures::shown(const Kiosk& kiosk, bool drawn) {
  const auto now = steady_clock::now();
  const double drawn_s = thread_seconds();
  const ui::Step step = kiosk.ui().visit().step;
  PageCost& cost = pages_[std::size_t(step)];
  if (step != last_) cost.waited = 0;
  last_ = step;
  follow(kiosk, now);
  if (++cost.waited <= kSettling) {
    cost.from = cost.frames == 0 ? now : cost.from;
    return;
  }
  ++cost.frames;
  cost.drawn += drawn ? 1 : 0;
  cost.until = now;
  cost.turn_s += made_s_ - begun_s_;
  cost.most_turn_s = std::max(cost.most_turn_s, made_s_ - begun_s_);
  cost.draw_s += drawn_s - made_s_;
  cost.allocations += taken_after_ - taken_before_;
  cost.allocating_frames += taken_after_ > taken_before_ ? 1 : 0;
}

void VisitFigures::follow(const Kiosk& kiosk, steady_clock::time_point now) {
  const ui::Visit& visit = kiosk.ui().visit();
  const ui::ViewState& view = kiosk.view();
  if (visit.step == ui::Step::Consent) still_to_face_s_ = still_to_shot_s_ = std::nullopt;
  if (visit.step == ui::Step::Position && view.screen == ui::Screen::Position) {
    const bool still = view.live.advice == pipeline::Advice::None && view.live.steady_s > 0;
    if (!still) still_at_.reset();
    else if (!still_at_)
      still_at_ =
          now - std::chrono::duration_cast<steady_clock::duration>(duration<float>(view.live.steady_s));
  }
  if (visit.step == ui::Step::Working && still_at_ && !still_to_shot_s_)
    still_to_shot_s_ = duration<double>(now - *still_at_).count();
  const bool face = visit.step == ui::Step::Review && kiosk.ui().draw_list().faces[0].model != nullptr;
  if (face && still_at_) {
    still_to_face_s_ = duration<double>(now - *still_at_).count();
    still_at_.reset();
  }
  if (visit.step == ui::Step::Thanks) touches_ = visit.touches;
}

std::optional<double> VisitFigures::rate(const PageCost& page) {
  const double passed = duration<double>(page.until - page.from).count();
  return page.frames > 1 && passed > 0 ? std::optional<double>(double(page.frames) / passed) : std::nullopt;
}

std::vector<std::string> VisitFigures::lines() const {
  std::vector<std::string> said;
  if (touches_ > 0) said.push_back(line("touches from yes to thanks, without text   %6d    bar 6", touches_));
  if (still_to_face_s_) {
    const double shot = still_to_shot_s_.value_or(0);
    said.push_back(line(
        "standing still to the face on the screen   %6.2f s  bar 4 (%.2f s to the shot, %.2f s from there)",
        *still_to_face_s_, shot, *still_to_face_s_ - shot));
  }
  if (const auto live = live_frames_a_second())
    said.push_back(line("frames a second on the live page           %6.1f    bar 20", *live));
  said.push_back(
      "page       frames  a second  changed  ms of processor a frame: ours  most  drawing with the GL driver  heap blocks taken");
  for (std::size_t i = 0; i < kPages; ++i) {
    const PageCost& p = pages_[i];
    if (p.frames == 0) continue;
    const double n = double(p.frames);
    std::string row = line("%-10s %6ld  %8.1f  %7ld  %29.3f %5.2f  %26.2f  ", ui::kStepNames[i].data(),
                           p.frames, rate(p).value_or(0), p.drawn, 1e3 * p.turn_s / n, 1e3 * p.most_turn_s,
                           1e3 * p.draw_s / double(std::max(1L, p.drawn)));
    row += allocations_ ? line("%ld in %ld frames", p.allocations, p.allocating_frames)
                        : std::string("not counted");
    said.push_back(std::move(row));
  }
  return said;
}

}  // namespace relievo::firmware
