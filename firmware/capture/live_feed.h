// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LiveFeed: the newest small picture of the person, from the capture thread to the screen. Three
// buffers of fixed size: one is being filled, one is the newest, one is on the screen; nobody waits.
// Thread: fill() and publish() capture, newest() main; wipe() main, and only while no job runs.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "firmware/capture/position_guide.h"
#include "hal/base/image_view.h"

namespace relievo::firmware {

struct LivePicture {
  ImageView picture;   // Rgb8; valid until the next newest()
  Guidance guidance;
  std::uint32_t number = 0;  // 0: none since the last wipe
};

class LiveFeed {
 public:
  LiveFeed();
  // A copy of the picture, its longer side kLiveSidePx or less.
  ImageView fill(const ImageView& picture);
  void publish(const Guidance& guidance);
  LivePicture newest();
  void wipe();

 private:
  struct Slot {
    std::vector<std::uint8_t> rgb;
    LivePicture live;
  };
  std::array<Slot, 3> slots_;
  std::mutex mutex_;
  std::size_t filling_ = 0, newest_ = 1, shown_ = 2;
  bool fresh_ = false;
  std::uint32_t count_ = 0;
};

}  // namespace relievo::firmware
