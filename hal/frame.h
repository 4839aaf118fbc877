// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frame: a borrowed sensor buffer. Returning it (by destruction) queues it again, so holding every
// Frame of a camera stops that camera. Thread: capture.
#pragma once

#include <cstdint>
#include <utility>

#include "hal/base/image_view.h"
#include "hal/clock.h"
#include "hal/raw/raw_image.h"

namespace relievo::hal {

class Frame {
 public:
  using Release = void (*)(void* owner, int slot);
  // exposed_at: when the sensor was exposed, as the driver's hardware time stamp says, on the machine's
  // own clock. sequence: counts exposures, also those the driver had to drop. damaged: the driver says
  // that bytes were lost on the way.
  struct Stamp {
    Instant exposed_at;
    std::uint32_t sequence = 0;
    bool damaged = false;
  };
  Frame(const RawImage& raw, const Stamp& stamp, Release release, void* owner, int slot)
      : raw_(raw), stamp_(stamp), release_(release), owner_(owner), slot_(slot) {}
  Frame(Frame&& other) noexcept
      : raw_(other.raw_),
        stamp_(other.stamp_),
        release_(std::exchange(other.release_, nullptr)),
        owner_(other.owner_),
        slot_(other.slot_) {}
  Frame& operator=(Frame&&) = delete;
  ~Frame() {
    if (release_ != nullptr) release_(owner_, slot_);
  }

  const RawImage& raw() const { return raw_; }
  // Without developing: empty for a format that needs it.
  ImageView image() const { return plain_view(raw_); }
  Instant exposed_at() const { return stamp_.exposed_at; }
  std::uint32_t sequence() const { return stamp_.sequence; }
  bool damaged() const { return stamp_.damaged; }

 private:
  RawImage raw_;
  Stamp stamp_;
  Release release_;
  void* owner_;
  int slot_;
};

}  // namespace relievo::hal
