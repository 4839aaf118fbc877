// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Service: where a member of staff is on their side of the screen, and what they have typed.
// The sibling of Visit. It decides nothing: what is to be done goes out as StaffRequest, who may come in
// the appliance says (ServiceView::role).
//
//   closed --StaffEnter--> Pin (or FirstStart) --role--> Menu <--> pages --role None--> closed
//
// What is typed lives in fixed memory and is wiped on every change of page.
// Thread: main. Errors: none: what does not fit is not typed.
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "hal/base/wiped_text.h"
#include "hal/clock.h"
#include "pipeline/model/geometry.h"
#include "ui/view/action.h"
#include "ui/view/service_view.h"

namespace relievo::ui {

// FaceRuler: a scale and the distance of two touched points on a model that fills a page. Ui sets the points
// and where they are seen (ui/render/face_geometry.h), the page draws them. Thread: main. Errors: none.
struct FaceRuler {
  bool on = false;                             // touches set points
  std::array<pipeline::Vec3f, 2> points_mm{};  // on the surface, frame of face_geometry.h
  std::size_t count = 0;
  // Of the newest frame: where they are, shares of the model's picture; its size and a millimetre, pixels.
  std::array<pipeline::Vec2f, 2> seen{};
  float width_px = 0, height_px = 0, px_per_mm = 0;

  float distance_mm() const {
    const auto &a = points_mm[0], &b = points_mm[1];
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  }
  // Is it seen in the same places?
  bool stands_as(const FaceRuler& other) const {
    const auto far = [](float a, float b) { return std::abs(a - b) > 1e-4F; };
    bool same = count == other.count && !far(width_px, other.width_px) && !far(height_px, other.height_px) &&
                !far(px_per_mm, other.px_per_mm);
    for (std::size_t i = 0; i < count; ++i)
      same = same && !far(seen[i].x, other.seen[i].x) && !far(seen[i].y, other.seen[i].y);
    return same;
  }
  // A third point begins anew.
  void set(const pipeline::Vec3f& point) {
    if (count == points_mm.size()) count = 0;
    points_mm[count++] = point;
  }
};

struct ViewState;

// Whoever is on such a page has signed in.
constexpr bool needs_role(StaffPage page) { return page != StaffPage::Pin && page != StaffPage::FirstStart; }

inline constexpr std::string_view kBarsEnd = "sign out";  // the last button above what a page is about
inline constexpr std::size_t kMostPinDigits = 8, kLeastPinDigits = 4;
inline constexpr std::chrono::seconds kPinPatience{30};
inline constexpr std::chrono::seconds kHold{3};  // a finger on the way in

class Service {
 public:
  bool open = false;
  StaffPage page = StaffPage::Pin;
  int mode = 0;     // the page's own: a question, a step; 0 when the page is opened
  FaceRuler ruler;  // of the page's model

  std::string_view typed() const { return typed_.view(); }
  bool takes(ActionKind kind) const;
  void act(const Action& action, const ViewState& view);
  void type(std::string_view letter);
  void touched(hal::Instant now) { last_touch_ = now; }
  // Follows the appliance, and the time.
  void follow(const ViewState& view);
  // What is to be asked of the appliance; nothing when there is no more.
  std::optional<StaffRequest> take_request();
  // For screenshots and tests: the page, as if somebody had walked there.
  void show(StaffPage which, int in_mode = 0);
  void close();

 private:
  static constexpr std::size_t kRequests = 8;
  void go(StaffPage to);
  void request(const StaffAsk& ask);
  void enter(const ViewState& view);
  void leave();
  void back(bool inner);
  bool digits_only() const {
    return page == StaffPage::Pin || page == StaffPage::FirstStart || page == StaffPage::Pins;
  }

  ShortWipedText<kStaffTextBytes> typed_;
  std::array<StaffRequest, kRequests> requests_{};
  std::size_t request_count_ = 0;
  hal::Instant last_touch_{};
};

}  // namespace relievo::ui
