// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// V4l2Camera: a camera of Linux's video interface, its buffers mapped into the process and never copied.
// Name it by a path that survives a reboot: /dev/v4l/by-path/… for the socket, /dev/v4l/by-id/… for the
// device. With a serial number it is the very camera of the calibration, or refused.
//
// Errors: open(): NotFound (nothing at the path), Unsupported (v4l2_setup.h), InvalidInput (another
// camera), IoFailed (not allowed, in use), OutOfMemory. start(): IoFailed (the bus has no room for it).
// next_frame(): Timeout, Disconnected (unplugged), IoFailed (the driver's stream broke: restart it),
// Unsupported (no time stamps of the machine's clock, interlaced). Frames go back before close().
// Thread: capture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "hal/camera.h"
#include "hal/linux/kernel.h"
#include "hal/linux/v4l2_setup.h"

namespace relievo::hal {

struct V4l2CameraOptions {
  std::string device;
  std::string serial;        // of the calibrated camera; empty: whichever is plugged in
  std::uint32_t fourcc = 0;  // 0: the best format both sides know
  bool triggered = true;     // expose at the external trigger, where the driver has the control
};

class V4l2Camera final : public Camera {
 public:
  // The kernel and the clock live longer than the camera.
  V4l2Camera(V4l2CameraOptions options, Kernel& kernel, const Clock& clock)
      : options_(std::move(options)), kernel_(kernel), clock_(clock) {}
  ~V4l2Camera() override;
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  std::string_view serial() const override { return serial_; }
  // /dev/video0 is another camera after another start: only names under /dev/v4l say something.
  std::string_view socket() const override {
    return options_.device.starts_with("/dev/v4l/") ? std::string_view(options_.device) : std::string_view();
  }

 private:
  static constexpr std::size_t kBuffers = 4;
  struct Buffer {
    void* memory = nullptr;
    std::size_t bytes = 0;
    bool lent = false;
  };
  Result<void> do_open(const CaptureMode& mode) override;
  Result<void> do_start() override;
  Result<Frame> do_next_frame(Instant deadline) override;
  void do_stop() override;
  void do_close() override { release(); }
  Result<void> do_set_exposure(const Exposure& exposure) override {
    return apply_exposure(kernel_, file_, exposure);
  }
  Result<ExposureLimits> do_exposure_limits() const override { return query_exposure(kernel_, file_); }

  Result<void> set_up(const CaptureMode& mode);
  Result<void> map_buffers();
  Result<void> queue(std::size_t index);
  Result<void> wait(Instant deadline);
  bool all_lent() const;
  void release();
  static void give_back(void* owner, int slot);

  V4l2CameraOptions options_;
  Kernel& kernel_;
  const Clock& clock_;
  int file_ = -1;
  bool streaming_ = false;
  std::string serial_;
  V4l2Stream stream_;
  std::size_t count_ = 0;
  std::array<Buffer, kBuffers> buffers_;
};

}  // namespace relievo::hal
