// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is asked of a V4L2 device before it streams, and its controls. Plain data goes in and out, so that
// only v4l2_*.cc know the kernel's structures.
// Errors: Unsupported (not a camera, no such size or format, interlaced, no control), Timeout (nothing is
// plugged into its input), Disconnected, IoFailed. Thread: capture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.h"
#include "hal/camera.h"
#include "hal/linux/kernel.h"
#include "hal/raw/raw_image.h"

namespace relievo::hal {

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

// Exposes at the external trigger, where the driver has a control for it; false where it has none.
Result<bool> set_external_trigger(Kernel& kernel, int file);

// Exposure in V4L2's units of 0.1 ms; gain 1 to kGainSpan over the control's whole range, since its unit
// is the maker's: the same number means the same on two cameras of one kind. Turns the automatics off.
inline constexpr double kGainSpan = 16;
Result<ExposureLimits> query_exposure(Kernel& kernel, int file);
Result<void> apply_exposure(Kernel& kernel, int file, const Exposure& exposure);

}  // namespace relievo::hal
