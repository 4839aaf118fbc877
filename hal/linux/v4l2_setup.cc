// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <linux/videodev2.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/linux/v4l2_camera.h"

namespace relievo::hal {
namespace {

constexpr int kMostControls = 512;
constexpr std::int64_t kExposureUnitUs = 100;

const Error kNoExposure{Errc::Unsupported, "this camera's exposure cannot be set"};

bool is_usable(const v4l2_queryctrl& asked) {
  return (asked.flags & (V4L2_CTRL_FLAG_DISABLED | V4L2_CTRL_FLAG_READ_ONLY)) == 0 &&
         asked.maximum > asked.minimum;
}

using Control = std::optional<v4l2_queryctrl>;

// None: there is none, or no further one.
Result<Control> query_control(Kernel& kernel, int file, std::uint32_t id) {
  v4l2_queryctrl asked{};
  asked.id = id;
  const int r = call(kernel, file, VIDIOC_QUERYCTRL, &asked);
  if (r == -EINVAL || r == -ENOTTY) return Control();
  if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not tell its controls"});
  return Control(asked);
}

Result<Control> find_control(Kernel& kernel, int file, std::uint32_t id) {
  RELIEVO_TRY_ASSIGN(const Control asked, query_control(kernel, file, id));
  return asked && is_usable(*asked) ? asked : Control();
}

Result<void> set_control(Kernel& kernel, int file, std::uint32_t id, std::int64_t value) {
  v4l2_control control{};
  control.id = id;
  control.value = std::int32_t(value);
  const int r = call(kernel, file, VIDIOC_S_CTRL, &control);
  if (r == -EBUSY) return Error{Errc::IoFailed, "another program holds this camera's controls: close it"};
  if (r == -ERANGE || r == -EINVAL) return invalid("the camera refuses this value of a control");
  if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not take a control"});
  return {};
}

// Sets a control if there is one; that it is missing, or knows no such value, does no harm.
Result<void> set_if_any(Kernel& kernel, int file, std::uint32_t id, std::int64_t value) {
  const Result<void> set = set_control(kernel, file, id, value);
  if (!set && set.error().code != Errc::InvalidInput && set.error().sys_errno != ENOTTY &&
      set.error().sys_errno != EACCES)
    return set;
  return {};
}

Result<Control> find_gain(Kernel& kernel, int file) {
  RELIEVO_TRY_ASSIGN(const auto analogue, find_control(kernel, file, V4L2_CID_ANALOGUE_GAIN));
  if (analogue) return analogue;
  return find_control(kernel, file, V4L2_CID_GAIN);
}

std::string lower(const unsigned char* text, std::size_t room) {
  std::string name(reinterpret_cast<const char*>(text), room);
  name = name.substr(0, name.find('\0'));
  for (char& c : name) c = char(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

// Of a menu the first entry that names the outside, or "on"; else its second, since the first is "off".
std::int64_t external_of(Kernel& kernel, int file, const v4l2_queryctrl& asked) {
  if (asked.type != V4L2_CTRL_TYPE_MENU) return 1;
  for (std::int64_t i = asked.minimum; i <= asked.maximum; ++i) {
    v4l2_querymenu entry{};
    entry.id = asked.id;
    entry.index = std::uint32_t(i);
    if (call(kernel, file, VIDIOC_QUERYMENU, &entry) < 0) continue;
    const std::string name = lower(entry.name, sizeof entry.name);
    if (name == "on") return i;  // "continuous" has it, too
    for (const std::string_view word : {"external", "hardware", "slave"})
      if (name.find(word) != std::string::npos) return i;
  }
  return asked.minimum + 1;
}

// In the kernel since 6.3; Debian 12's header is older.
constexpr std::uint32_t kY12Packed = v4l2_fourcc('Y', '1', '2', 'P');

constexpr V4l2Format kFormats[] = {
    {V4L2_PIX_FMT_SRGGB8, {RawCoding::Bits8, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG8, {RawCoding::Bits8, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG8, {RawCoding::Bits8, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR8, {RawCoding::Bits8, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_SRGGB10P, {RawCoding::Packed10, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG10P, {RawCoding::Packed10, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG10P, {RawCoding::Packed10, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR10P, {RawCoding::Packed10, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_SRGGB10, {RawCoding::Bits10, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG10, {RawCoding::Bits10, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG10, {RawCoding::Bits10, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR10, {RawCoding::Bits10, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_SRGGB12P, {RawCoding::Packed12, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG12P, {RawCoding::Packed12, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG12P, {RawCoding::Packed12, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR12P, {RawCoding::Packed12, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_SRGGB12, {RawCoding::Bits12, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG12, {RawCoding::Bits12, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG12, {RawCoding::Bits12, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR12, {RawCoding::Bits12, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_RGB24, {RawCoding::Rgb8}},
    {V4L2_PIX_FMT_YUYV, {RawCoding::Yuyv}},
    {V4L2_PIX_FMT_NV12, {RawCoding::Nv12}},
    {V4L2_PIX_FMT_Y12, {RawCoding::Bits12}},
    {kY12Packed, {RawCoding::Packed12}},
    {V4L2_PIX_FMT_Y10, {RawCoding::Bits10}},
    {V4L2_PIX_FMT_Y10P, {RawCoding::Packed10}},
    {V4L2_PIX_FMT_Y16, {RawCoding::Bits16}},
    {V4L2_PIX_FMT_GREY, {RawCoding::Bits8}},
    {V4L2_PIX_FMT_MJPEG, {RawCoding::Mjpeg}},
    {V4L2_PIX_FMT_JPEG, {RawCoding::Mjpeg}},
};

constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;
constexpr std::uint32_t kShortestPerSecond = 60;
constexpr std::uint32_t kMostEntries = 512;  // of a driver's list: one that never ends is not believed

bool has_no_such_call(int result) { return result == -ENOTTY || result == -EINVAL || result == -ENODATA; }

Result<void> check_capabilities(Kernel& kernel, int file) {
  v4l2_capability can{};
  if (const int r = call(kernel, file, VIDIOC_QUERYCAP, &can); r < 0)
    return device_error(r, {Errc::Unsupported, "this is no camera: name a /dev/v4l/by-path/ device"});
  const std::uint32_t caps =
      (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
  if ((caps & V4L2_CAP_VIDEO_CAPTURE) == 0 && (caps & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0)
    return Error{Errc::Unsupported,
                 "this camera gives its pictures in several planes, which is not supported"};
  if ((caps & V4L2_CAP_VIDEO_CAPTURE) == 0)
    return Error{Errc::Unsupported,
                 "this device takes no pictures: name the camera's capture node (often -index0)"};
  if ((caps & V4L2_CAP_STREAMING) == 0) return Error{Errc::Unsupported, "this camera's driver cannot stream"};
  return {};
}

const Error kInterlaced{
    Errc::Unsupported,
    "this camera gives interlaced fields, between which a face moves: set a progressive mode"};

// HDMI and its kin: what the cable carries is what the input must be told.
Result<void> follow_signal(Kernel& kernel, int file) {
  v4l2_dv_timings timings{};
  const int r = call(kernel, file, VIDIOC_QUERY_DV_TIMINGS, &timings);
  if (r == -ENOLINK) return Error{Errc::Timeout, "the camera's input has no signal: check the cable"};
  if (r == -ENOLCK) return Error{Errc::Timeout, "the camera's signal is not steady: check the cable"};
  if (r == -ERANGE) return Error{Errc::Unsupported, "the camera's signal has timings its input cannot take"};
  if (has_no_such_call(r)) return {};  // timings are set from outside
  if (r < 0) return device_error(r, {Errc::IoFailed, "the camera's input does not tell its timings"});
  if (timings.bt.interlaced != V4L2_DV_PROGRESSIVE) return kInterlaced;
  if (const int set = call(kernel, file, VIDIOC_S_DV_TIMINGS, &timings); set < 0)
    return device_error(set, {Errc::IoFailed, "the camera's input does not take its signal's timings"});
  return {};
}

// Inputs have frame intervals, or timings, or neither; which, they say themselves.
Result<bool> has_timings(Kernel& kernel, int file) {
  int index = 0;
  int r = call(kernel, file, VIDIOC_G_INPUT, &index);
  if (has_no_such_call(r)) return false;
  if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not tell its input"});
  v4l2_input input{};
  input.index = std::uint32_t(index);
  r = call(kernel, file, VIDIOC_ENUMINPUT, &input);
  if (has_no_such_call(r)) return false;
  if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not tell its input"});
  if ((input.status & (V4L2_IN_ST_NO_POWER | V4L2_IN_ST_NO_SIGNAL)) != 0)
    return Error{Errc::Timeout, "the camera's input has no signal: check the cable"};
  return (input.capabilities & V4L2_IN_CAP_DV_TIMINGS) != 0;
}

// The shortest interval that the driver takes; without a choice it stays as it is.
Result<void> set_interval(Kernel& kernel, int file) {
  v4l2_streamparm parameters{};
  parameters.type = kCapture;
  int r = call(kernel, file, VIDIOC_G_PARM, &parameters);
  if (has_no_such_call(r) || (r == 0 && (parameters.parm.capture.capability & V4L2_CAP_TIMEPERFRAME) == 0))
    return {};
  if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not tell its frame interval"});
  parameters.parm.capture.timeperframe = {1, kShortestPerSecond};
  r = call(kernel, file, VIDIOC_S_PARM, &parameters);
  if (r < 0 && !has_no_such_call(r))
    return device_error(r, {Errc::IoFailed, "the camera does not take a frame interval"});
  return {};
}

Result<std::vector<std::uint32_t>> formats_of(Kernel& kernel, int file) {
  std::vector<std::uint32_t> formats;
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_fmtdesc format{};
    format.index = i;
    format.type = kCapture;
    const int r = call(kernel, file, VIDIOC_ENUM_FMT, &format);
    if (r == -EINVAL || r == -ENOTTY) break;
    if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not list its formats"});
    formats.push_back(format.pixelformat);
  }
  return formats;
}

// Nothing, where the driver answers with another size or format than it was asked for.
Result<std::optional<V4l2Stream>> try_format(Kernel& kernel, int file, const CaptureMode& mode,
                                             const V4l2Format& wanted) {
  v4l2_format format{};
  format.type = kCapture;
  v4l2_pix_format& pix = format.fmt.pix;
  pix.width = std::uint32_t(mode.width_px);
  pix.height = std::uint32_t(mode.height_px);
  pix.pixelformat = wanted.fourcc;
  pix.field = V4L2_FIELD_NONE;
  const int r = call(kernel, file, VIDIOC_S_FMT, &format);
  if (r == -EINVAL) return std::optional<V4l2Stream>();
  if (r == -EBUSY) return Error{Errc::IoFailed, "another program uses this camera: close it"};
  if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not take a format"});
  if (pix.pixelformat != wanted.fourcc || pix.width != std::uint32_t(mode.width_px) ||
      pix.height != std::uint32_t(mode.height_px))
    return std::optional<V4l2Stream>();
  if (pix.field != V4L2_FIELD_NONE && pix.field != V4L2_FIELD_ANY) return kInterlaced;
  V4l2Stream stream{wanted.raw, mode.width_px, mode.height_px, 0};
  if (wanted.raw.coding != RawCoding::Mjpeg)
    stream.stride_bytes =
        int(std::max<std::size_t>(pix.bytesperline, raw_row_bytes(wanted.raw.coding, mode.width_px)));
  return std::optional<V4l2Stream>(stream);
}

}  // namespace

// The kernel has no number for it: makers name theirs "Trigger Mode", "External Trigger", "Trigger".
Result<void> set_external_trigger(Kernel& kernel, int file) {
  std::uint32_t id = V4L2_CTRL_FLAG_NEXT_CTRL;
  for (int i = 0; i < kMostControls; ++i) {
    RELIEVO_TRY_ASSIGN(const Control asked, query_control(kernel, file, id));
    if (!asked) return {};
    id = asked->id | V4L2_CTRL_FLAG_NEXT_CTRL;
    const bool choice = asked->type == V4L2_CTRL_TYPE_BOOLEAN || asked->type == V4L2_CTRL_TYPE_MENU ||
                        asked->type == V4L2_CTRL_TYPE_INTEGER;
    const std::string name = lower(asked->name, sizeof asked->name);
    const bool named =
        name == "trigger" || name == "trigger mode" || name == "external trigger" || name == "trigger enable";
    if (choice && named && is_usable(*asked))
      return set_control(kernel, file, asked->id, external_of(kernel, file, *asked));
  }
  return {};
}

Result<ExposureLimits> query_exposure(Kernel& kernel, int file) {
  RELIEVO_TRY_ASSIGN(const auto time, find_control(kernel, file, V4L2_CID_EXPOSURE_ABSOLUTE));
  if (!time) return kNoExposure;
  RELIEVO_TRY_ASSIGN(const auto gain, find_gain(kernel, file));
  using std::chrono::microseconds;
  return ExposureLimits{{microseconds(std::max<std::int64_t>(time->minimum, 1) * kExposureUnitUs), 1},
                        {microseconds(time->maximum * kExposureUnitUs), gain ? kGainSpan : 1}};
}

Result<void> apply_exposure(Kernel& kernel, int file, const Exposure& exposure) {
  RELIEVO_TRY_ASSIGN(const ExposureLimits limits, query_exposure(kernel, file));
  if (exposure.time < limits.least.time || exposure.time > limits.most.time ||
      exposure.gain < limits.least.gain || exposure.gain > limits.most.gain)
    return invalid("this exposure is outside what the camera can do");
  RELIEVO_TRY(set_if_any(kernel, file, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL));
  RELIEVO_TRY(set_if_any(kernel, file, V4L2_CID_AUTOGAIN, 0));
  RELIEVO_TRY(set_control(kernel, file, V4L2_CID_EXPOSURE_ABSOLUTE,
                          (exposure.time.count() + kExposureUnitUs / 2) / kExposureUnitUs));
  RELIEVO_TRY_ASSIGN(const auto gain, find_gain(kernel, file));
  if (!gain) return {};
  const double share = (exposure.gain - 1) / (kGainSpan - 1);
  return set_control(kernel, file, gain->id,
                     gain->minimum + std::llround(share * (double(gain->maximum) - gain->minimum)));
}

std::span<const V4l2Format> v4l2_formats() { return kFormats; }

Result<V4l2Stream> set_up_stream(Kernel& kernel, int file, const CaptureMode& mode, std::uint32_t fourcc) {
  RELIEVO_TRY(check_capabilities(kernel, file));
  RELIEVO_TRY_ASSIGN(const bool timings, has_timings(kernel, file));
  if (timings) RELIEVO_TRY(follow_signal(kernel, file));
  RELIEVO_TRY_ASSIGN(const auto offered, formats_of(kernel, file));
  for (const V4l2Format& wanted : v4l2_formats()) {
    if (fourcc != 0 && wanted.fourcc != fourcc) continue;
    if (std::ranges::find(offered, wanted.fourcc) == offered.end()) continue;
    RELIEVO_TRY_ASSIGN(const auto stream, try_format(kernel, file, mode, wanted));
    if (!stream) continue;
    if (!timings) RELIEVO_TRY(set_interval(kernel, file));
    return *stream;
  }
  return Error{Errc::Unsupported,
               "the camera gives no picture of this size in a format that can be read: choose another mode"};
}

}  // namespace relievo::hal
