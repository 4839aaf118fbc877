// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SideBySide: one device whose pictures hold both views, the left one left, as two Cameras. Each picture
// is handed out twice without copying; the device has its buffer back when both halves are given back.
//
//   device ──► picture ──┬──► left()   left half, the same stamp and number
//                        └──► right()  right half
//
// A side that is asked less often than the other finds the newest picture it has not seen. Modes are those
// of one view; the device is opened at twice the width.
// Errors: as the device's; Unsupported: motion JPEG, which cannot be halved before it is decoded, and
// views that a colour filter or shared colour would cut (odd widths). Thread: capture.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "hal/camera.h"

namespace relievo::hal {

class SideBySide {
 public:
  // The device lives longer.
  explicit SideBySide(Camera& device) : device_(device) {}
  SideBySide(const SideBySide&) = delete;
  SideBySide& operator=(const SideBySide&) = delete;

  Camera& left() { return left_; }
  Camera& right() { return right_; }

 private:
  static constexpr std::size_t kPictures = 3;
  static constexpr std::size_t kSides = 2;

  class Side final : public Camera {
   public:
    Side(SideBySide& both, std::size_t side) : both_(both), side_(side) {}
    std::string_view serial() const override { return both_.device_.serial(); }
    std::string_view socket() const override { return both_.device_.socket(); }

   private:
    Result<void> do_open(const CaptureMode& mode) override { return both_.open(mode); }
    Result<void> do_start() override { return both_.start(); }
    Result<Frame> do_next_frame(Instant deadline) override { return both_.next(side_, deadline); }
    void do_stop() override { both_.stop(side_); }
    void do_close() override { both_.close(side_); }
    Result<void> do_set_exposure(const Exposure& exposure) override {
      return both_.device_.set_exposure(exposure);
    }
    Result<ExposureLimits> do_exposure_limits() const override { return both_.device_.exposure_limits(); }
    SideBySide& both_;
    std::size_t side_;
  };
  // One picture of the device while a half is lent out or still waits to be asked for.
  struct Shared {
    std::optional<Frame> frame;
    std::array<bool, kSides> lent{};
    std::array<bool, kSides> waits{};
  };

  Result<void> open(const CaptureMode& mode);
  Result<void> start();
  void stop(std::size_t side);
  void close(std::size_t side);
  Result<Frame> next(std::size_t side, Instant deadline);
  Result<Frame> lend(Shared& shared, std::size_t side);
  void tidy();
  const Camera& beside(std::size_t side) const { return side == 0 ? right_ : left_; }
  static void give_back(void* owner, int slot);

  Camera& device_;
  bool dead_ = false;  // the device has vanished: the first side that closes, closes it
  std::array<Shared, kPictures> pictures_;
  Side left_{*this, 0};
  Side right_{*this, 1};
};

}  // namespace relievo::hal
