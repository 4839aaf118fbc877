// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <linux/videodev2.h>

#include "hal/linux/v4l2_setup.h"

namespace relievo::hal {
namespace {

constexpr int kMostControls = 512;
constexpr std::int64_t kExposureUnitUs = 100;

const Error kNoExposure{Errc::Unsupported, "this camera's exposure cannot be set"};

struct Control {
  std::uint32_t id = 0;
  std::int64_t least = 0;
  std::int64_t most = 0;
};

bool is_usable(const v4l2_queryctrl& asked) {
  return (asked.flags & (V4L2_CTRL_FLAG_DISABLED | V4L2_CTRL_FLAG_READ_ONLY)) == 0 &&
         asked.maximum > asked.minimum;
}

Result<std::optional<Control>> find_control(Kernel& kernel, int file, std::uint32_t id) {
  v4l2_queryctrl asked{};
  asked.id = id;
  const int r = call(kernel, file, VIDIOC_QUERYCTRL, &asked);
  if (r == -EINVAL || r == -ENOTTY) return std::optional<Control>();
  if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not tell its controls"});
  if (!is_usable(asked)) return std::optional<Control>();
  return std::optional<Control>({id, asked.minimum, asked.maximum});
}

Result<void> set_control(Kernel& kernel, int file, std::uint32_t id, std::int64_t value) {
  v4l2_control control{};
  control.id = id;
  control.value = static_cast<std::int32_t>(value);
  const int r = call(kernel, file, VIDIOC_S_CTRL, &control);
  if (r == -EBUSY) return Error{Errc::IoFailed, "another program holds this camera's controls: close it"};
  if (r == -ERANGE || r == -EINVAL)
    return Error{Errc::InvalidInput, "the camera refuses this value of a control"};
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

Result<std::optional<Control>> find_gain(Kernel& kernel, int file) {
  RELIEVO_TRY_ASSIGN(const auto analogue, find_control(kernel, file, V4L2_CID_ANALOGUE_GAIN));
  if (analogue) return analogue;
  return find_control(kernel, file, V4L2_CID_GAIN);
}

std::string lower(const unsigned char* text, std::size_t room) {
  std::string name(reinterpret_cast<const char*>(text), room);
  name = name.substr(0, name.find('\0'));
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

// Of a menu the first entry that names the outside; else its second, since the first is "off".
std::int64_t external_of(Kernel& kernel, int file, const v4l2_queryctrl& asked) {
  if (asked.type != V4L2_CTRL_TYPE_MENU) return 1;
  for (std::int64_t i = asked.minimum; i <= asked.maximum; ++i) {
    v4l2_querymenu entry{};
    entry.id = asked.id;
    entry.index = static_cast<std::uint32_t>(i);
    if (call(kernel, file, VIDIOC_QUERYMENU, &entry) < 0) continue;
    const std::string name = lower(entry.name, sizeof entry.name);
    for (const std::string_view word : {"external", "hardware", "slave", "on"})
      if (name.find(word) != std::string::npos) return i;
  }
  return asked.minimum + 1;
}

}  // namespace

// The kernel has no number for it: makers name theirs "Trigger Mode", "External Trigger", "Trigger".
Result<bool> set_external_trigger(Kernel& kernel, int file) {
  std::uint32_t id = V4L2_CTRL_FLAG_NEXT_CTRL;
  for (int i = 0; i < kMostControls; ++i) {
    v4l2_queryctrl asked{};
    asked.id = id;
    const int r = call(kernel, file, VIDIOC_QUERYCTRL, &asked);
    if (r == -EINVAL || r == -ENOTTY) return false;
    if (r < 0) return device_error(r, {Errc::IoFailed, "the camera does not tell its controls"});
    id = asked.id | V4L2_CTRL_FLAG_NEXT_CTRL;
    const bool choice = asked.type == V4L2_CTRL_TYPE_BOOLEAN || asked.type == V4L2_CTRL_TYPE_MENU ||
                        asked.type == V4L2_CTRL_TYPE_INTEGER;
    const std::string name = lower(asked.name, sizeof asked.name);
    const bool named =
        name == "trigger" || name == "trigger mode" || name == "external trigger" || name == "trigger enable";
    if (!choice || !named || !is_usable(asked)) continue;
    RELIEVO_TRY(set_control(kernel, file, asked.id, external_of(kernel, file, asked)));
    return true;
  }
  return false;
}

Result<ExposureLimits> query_exposure(Kernel& kernel, int file) {
  RELIEVO_TRY_ASSIGN(const auto time, find_control(kernel, file, V4L2_CID_EXPOSURE_ABSOLUTE));
  if (!time) return kNoExposure;
  RELIEVO_TRY_ASSIGN(const auto gain, find_gain(kernel, file));
  using std::chrono::microseconds;
  return ExposureLimits{{microseconds(std::max<std::int64_t>(time->least, 1) * kExposureUnitUs), 1},
                        {microseconds(time->most * kExposureUnitUs), gain ? kGainSpan : 1}};
}

Result<void> apply_exposure(Kernel& kernel, int file, const Exposure& exposure) {
  RELIEVO_TRY_ASSIGN(const ExposureLimits limits, query_exposure(kernel, file));
  if (exposure.time < limits.least.time || exposure.time > limits.most.time ||
      exposure.gain < limits.least.gain || exposure.gain > limits.most.gain)
    return Error{Errc::InvalidInput, "this exposure is outside what the camera can do"};
  RELIEVO_TRY(set_if_any(kernel, file, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL));
  RELIEVO_TRY(set_if_any(kernel, file, V4L2_CID_AUTOGAIN, 0));
  RELIEVO_TRY(set_control(kernel, file, V4L2_CID_EXPOSURE_ABSOLUTE,
                          (exposure.time.count() + kExposureUnitUs / 2) / kExposureUnitUs));
  RELIEVO_TRY_ASSIGN(const auto gain, find_gain(kernel, file));
  if (!gain) return {};
  const double share = (exposure.gain - 1) / (kGainSpan - 1);
  return set_control(kernel, file, gain->id,
                     gain->least + std::llround(share * static_cast<double>(gain->most - gain->least)));
}

}  // namespace relievo::hal
