// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// V4l2Camera: a camera of Linux's video interface, its buffers mapped into the process and never copied.
// Name it by a path that survives a reboot: /dev/v4l/by-path/… for the socket, /dev/v4l/by-id/… for the
// device. With a serial number it is the very camera of the calibration, or refused.
//
// Errors: open(): NotFound (nothing at the path), Unsupported (set_up_stream()), InvalidInput (another
// camera), IoFailed (not allowed, in use), OutOfMemory. start(): IoFailed (the bus has no room for it).
// next_frame(): Timeout, Disconnected (unplugged), IoFailed (the driver's stream broke: restart it),
// Unsupported (no time stamps of the machine's clock, interlaced). Frames go back before close().
// Thread: capture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "hal/base/result.h"
#include "hal/camera.h"
#include "hal/linux/kernel.h"
#include "hal/raw/raw_image.h"

namespace relievo::hal {

// What is asked of a device before it streams, and its controls (v4l2_setup.cc). Plain data goes in and out,
// so that only v4l2_*.cc know the kernel's structures. Errors: Unsupported (not a camera, no such size or
// format, interlaced, no control), Timeout (nothing is plugged into its input), Disconnected, IoFailed.

// V4L2's four-letter names of pixel formats, and ours. Thread: any.
struct V4l2Format {
  std::uint32_t fourcc = 0;
  RawFormat raw;
};
// Every format that can be developed, the best first: a face is to have its colour; samples before YUV;
// of a mosaic 8 bit, which is what it is developed to; of a grey sensor all its bits; JPEG last.
std::span<const V4l2Format> v4l2_formats();

struct V4l2Stream {
  RawFormat format;
  int width_px = 0;
  int height_px = 0;
  int stride_bytes = 0;
};

// A device that streams progressive pictures of one plane. fourcc 0: the best both sides know.
// An input with timings (HDMI) is set to the timings of its signal; one with frame intervals to the
// shortest that is at least 1/60 s.
Result<V4l2Stream> set_up_stream(Kernel& kernel, int file, const CaptureMode& mode, std::uint32_t fourcc);

// Exposes at the external trigger, where the driver has a control for it.
Result<void> set_external_trigger(Kernel& kernel, int file);

// Exposure in V4L2's units of 0.1 ms; gain 1 to kGainSpan over the control's whole range, since its unit
// is the maker's: the same number means the same on two cameras of one kind. Turns the automatics off.
inline constexpr double kGainSpan = 16;
Result<ExposureLimits> query_exposure(Kernel& kernel, int file);
Result<void> apply_exposure(Kernel& kernel, int file, const Exposure& exposure);

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
  ~V4l2Camera() override { close(); }
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
  void release();
  static void give_back(void* owner, int slot);

  V4l2CameraOptions options_;
  Kernel& kernel_;
  const Clock& clock_;
  int file_ = -1;
  std::string serial_;
  V4l2Stream stream_;
  std::size_t count_ = 0;
  std::array<Buffer, kBuffers> buffers_;
};

}  // namespace relievo::hal
