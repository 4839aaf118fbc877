// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SpoiledPairs: pairs of a board for a live calibration, in place of which other things come as the test
// says. Thread: whoever calibrates.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <utility>

#include "firmware/calibrate/calibrate_command.h"

namespace relievo::firmware {

class SpoiledPairs final : public LivePairs {
 public:
  // What comes in place of the next pair: an error; true: one of another size; false: nothing.
  using Spoils = std::function<Result<bool>(const pipeline::LiveState& state)>;
  SpoiledPairs(std::unique_ptr<LivePairs> pairs, Spoils spoils)
      : pairs_(std::move(pairs)), spoils_(std::move(spoils)) {}
  Result<std::optional<LivePair>> next(const pipeline::LiveState& state) override {
    if (!spoils_) return pairs_->next(state);
    RELIEVO_TRY_ASSIGN(const bool another_size, spoils_(state));
    if (!another_size) return pairs_->next(state);
    const ImageView view{bytes_.data(), kSidePx, kSidePx, kSidePx, PixelFormat::Grey8};
    return std::optional<LivePair>({view, view, std::chrono::hours(1)});
  }

 private:
  static constexpr int kSidePx = 64;
  std::unique_ptr<LivePairs> pairs_;
  Spoils spoils_;
  std::array<std::byte, std::size_t{kSidePx} * kSidePx> bytes_{};
};

}  // namespace relievo::firmware
