// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PortraitProgress: how far the way from the photograph to the portrait is, as one number that never falls.
// Its parts count as long as they took when they were measured (ms in report.json of `relievo reconstruct`);
// within a part, time itself counts, slower and slower towards the part's end, which may be late. Thread:
// one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

#include "firmware/machine/machine.h"
#include "hal/clock.h"
#include "pipeline/model/advice.h"

namespace relievo::firmware {

class PortraitProgress {
 public:
  static constexpr std::size_t kFuse = kStages.size() + pipeline::kSides;

  // A new photograph. A head has the face's stages, its sides and their fusion; a face has the stages alone.
  void begin(bool head = false) {
    share_ = 0;
    head_ = head;
    part_ = kFuse + 1;
  }
  // The stages in their order, then the sides, then kFuse.
  void works_on(std::size_t part, hal::Instant now) {
    if (part != part_) begun_ = now;
    part_ = part;
    const auto all = std::span(kParts).first(head_ ? kParts.size() : kStages.size());
    part = std::min(part, all.size() - 1);
    const float passed = std::chrono::duration<float>(now - begun_).count();
    const float so_far = std::accumulate(all.begin(), all.begin() + std::ptrdiff_t(part), 0.0F) +
                         all[part] * (1 - std::exp(-kEase * passed / all[part]));
    share_ = std::max(share_, std::min(kMost, so_far / std::accumulate(all.begin(), all.end(), 0.0F)));
  }
  void done() { share_ = 1; }
  float share() const { return share_; }

 private:
  static constexpr float kEase = 1.6F, kMost = 0.99F;
  static constexpr float kSideS = 0.9F;  // seconds, as the others
  static constexpr std::array<float, kFuse + 1> kParts{0.58F,  0.04F,  0.37F,  0.15F,  0.12F,
                                                       kSideS, kSideS, kSideS, kSideS, 2.2F};
  float share_ = 0;
  bool head_ = false;
  std::size_t part_ = kFuse + 1;
  hal::Instant begun_{};
};

}  // namespace relievo::firmware
