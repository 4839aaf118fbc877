// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LiveFeed: the newest small picture of the person, from the capture thread to the screen. Three buffers: one
// is being filled, one is the newest, one is on the screen; nobody waits.
// Thread: fill() and publish() capture, newest() main; wipe() main, and only while no job runs.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "firmware/base/budget.h"
#include "hal/base/image_view.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

class LiveFeed {
 public:
  // `side_px`: the longer side of its pictures at most. Room for budget::kLiveSidePx is taken at once; for
  // more with the first larger picture (bad_alloc); it stays, for the screen may still hold a view of it.
  explicit LiveFeed(int side_px = budget::kLiveSidePx);
  // A copy of the picture, shrunk by a whole number.
  ImageView fill(const ImageView& picture);
  // What fill() made, to draw into before it is published.
  std::uint8_t* filled() { return slots_[filling_].rgb.data(); }
  // With what fill() made.
  void publish(ui::LiveView guidance);
  // Its picture is valid until the next newest(). Number 0: none since the last wipe.
  ui::LiveView newest();
  void wipe();

 private:
  struct Slot {
    std::vector<std::uint8_t> rgb;
    ui::LiveView live;
  };
  int side_px_;
  std::array<Slot, budget::kLiveSlots> slots_;
  std::mutex mutex_;
  std::size_t filling_ = 0, newest_ = 1, shown_ = 2;
  bool fresh_ = false;
  std::uint32_t count_ = 0;
};

}  // namespace relievo::firmware
