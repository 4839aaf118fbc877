// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/v4l2_camera.h"

#include <algorithm>
#include <cerrno>

#include <linux/videodev2.h>
#include <poll.h>

#include "hal/base/words.h"

namespace relievo::hal {
namespace {

constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;
const Error kNoMemory{Errc::OutOfMemory,
                      "the camera's driver has no memory for its buffers: choose a smaller mode"};

constexpr Meaning kCannotOpenIt[] = {
    {{ENOENT, ENODEV, ENXIO},
     Errc::NotFound,
     "there is no camera: check its plug, and its name under /dev/v4l/by-path"},
    {{EACCES, EPERM}, Errc::IoFailed, "this camera may not be opened: add the user to the group video"},
    {{EBUSY}, Errc::IoFailed, "another program uses this camera: close it"},
    {{}, Errc::IoFailed, "this camera cannot be opened"}};

v4l2_buffer empty_buffer(std::size_t index) {
  v4l2_buffer buffer{};
  buffer.type = kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = std::uint32_t(index);
  return buffer;
}

}  // namespace

Result<void> V4l2Camera::do_open(const CaptureMode& mode) {
  const int file = open_device(kernel_, options_.device.c_str());
  if (file < 0) return meaning_of(-file, kCannotOpenIt).at(options_.device);
  file_ = file;
  if (const Result<void> ready = set_up(mode); !ready) {
    release();
    return ready.error().where().empty() ? ready.error().at(options_.device) : ready.error();
  }
  return {};
}

Result<void> V4l2Camera::set_up(const CaptureMode& mode) {
  serial_ = kernel_.serial_of(options_.device.c_str());
  if (!options_.serial.empty() && options_.serial != serial_)
    return invalid("another camera is plugged in here than the one calibrated: swap it back, or calibrate");
  RELIEVO_TRY_ASSIGN(stream_, set_up_stream(kernel_, file_, mode, options_.fourcc));
  if (options_.triggered) RELIEVO_TRY(set_external_trigger(kernel_, file_));
  if (mode.exposure.count() > 0) {
    const Result<void> set = apply_exposure(kernel_, file_, {mode.exposure, 1});
    if (!set && set.error().code != Errc::Unsupported && set.error().code != Errc::InvalidInput) return set;
  }
  return map_buffers();
}

Result<void> V4l2Camera::map_buffers() {
  v4l2_requestbuffers wanted{};
  wanted.count = kBuffers;
  wanted.type = kCapture;
  wanted.memory = V4L2_MEMORY_MMAP;
  if (const int r = call(kernel_, file_, VIDIOC_REQBUFS, &wanted); r < 0) {
    if (r == -EBUSY) return Error{Errc::IoFailed, "another program uses this camera: close it", -r};
    if (r == -EINVAL) return Error{Errc::Unsupported, "this camera's driver cannot map its buffers", -r};
    return device_error(r, kNoMemory);
  }
  if (wanted.count < 2) return kNoMemory;
  count_ = std::min<std::size_t>(wanted.count, kBuffers);
  for (std::size_t i = 0; i < count_; ++i) {
    v4l2_buffer buffer = empty_buffer(i);
    if (const int r = call(kernel_, file_, VIDIOC_QUERYBUF, &buffer); r < 0)
      return device_error(r, {Errc::IoFailed, "the camera does not describe its buffers"});
    buffers_[i] = {kernel_.map(file_, buffer.length, buffer.m.offset), buffer.length, false};
    if (buffers_[i].memory == nullptr)
      return Error{Errc::OutOfMemory, "the camera's buffers cannot be mapped"};
  }
  return {};
}

void V4l2Camera::release() {
  if (file_ < 0) return;
  for (Buffer& buffer : buffers_) {
    if (buffer.memory != nullptr) kernel_.unmap(buffer.memory, buffer.bytes);
    buffer = {};
  }
  count_ = 0;
  kernel_.close(file_);  // gives the driver's buffers back too
  file_ = -1;
}

Result<void> V4l2Camera::queue(std::size_t index) {
  v4l2_buffer buffer = empty_buffer(index);
  if (const int r = call(kernel_, file_, VIDIOC_QBUF, &buffer); r < 0)
    return device_error(r, {Errc::IoFailed, "the camera does not take a buffer back"});
  return {};
}

Result<void> V4l2Camera::do_start() {
  Result<void> started;
  for (std::size_t i = 0; i < count_ && started; ++i)
    if (!buffers_[i].lent) started = queue(i);
  std::uint32_t type = kCapture;
  if (started) {
    if (const int r = call(kernel_, file_, VIDIOC_STREAMON, &type); r == -ENOSPC)
      started =
          Error{Errc::IoFailed,
                "the bus has no room for this camera: use another controller, or a smaller mode", ENOSPC};
    else if (r == -ENOLINK)
      started = Error{Errc::Timeout, "the camera's input has no signal: check the cable", ENOLINK};
    else if (r < 0) started = device_error(r, {Errc::IoFailed, "the camera does not start"});
  }
  // What was queued is taken back, so that the next start begins with all of them.
  if (!started) call(kernel_, file_, VIDIOC_STREAMOFF, &type);
  return started ? started : Result<void>(started.error().at(options_.device));
}

void V4l2Camera::do_stop() {
  std::uint32_t type = kCapture;
  call(kernel_, file_, VIDIOC_STREAMOFF, &type);  // of a camera that is gone: nothing left to stop
}

Result<void> V4l2Camera::wait(Instant deadline) {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(deadline - clock_.now());
  const int events = kernel_.poll(file_, int(std::clamp<std::int64_t>(left.count(), 0, 60'000)));
  if (events < 0 && events != -EINTR)
    return device_error(events, {Errc::IoFailed, "the camera cannot be waited for"});
  if (events > 0 && (events & POLLHUP) != 0)
    return device_error(-ENODEV, {Errc::Disconnected, "the camera is gone: check its plug"});
  return {};  // a picture, an error that taking it will tell, or a signal: look again
}

Result<Frame> V4l2Camera::do_next_frame(Instant deadline) {
  if (std::ranges::all_of(std::span(buffers_).first(count_), &Buffer::lent))
    return Error{Errc::Timeout, "every buffer of this camera is lent out; give a frame back"};
  v4l2_buffer buffer = empty_buffer(0);
  for (int r = -EAGAIN; r != 0;) {
    const bool last = clock_.now() >= deadline;  // what came at the last moment is taken
    r = call(kernel_, file_, VIDIOC_DQBUF, &buffer);
    // Whatever poll tells: a driver may announce a picture, or an error, that it does not give.
    if (r == -EAGAIN && last) return Error{Errc::Timeout, "no picture came: check the trigger wire"};
    if (r == -EAGAIN) RELIEVO_TRY(wait(deadline));
    else if (r < 0) return device_error(r, {Errc::IoFailed, "the camera's stream broke off"});
  }
  if (buffer.index >= count_ || buffers_[buffer.index].lent)
    return Error{Errc::IoFailed, "the camera's driver gave a buffer that it does not have"};
  Buffer& lent = buffers_[buffer.index];
  lent.lent = true;
  const RawImage raw{static_cast<const std::byte*>(lent.memory),
                     std::min<std::size_t>(buffer.bytesused, lent.bytes),
                     stream_.width_px,
                     stream_.height_px,
                     stream_.stride_bytes,
                     stream_.format};
  const std::chrono::nanoseconds at =
      std::chrono::seconds(buffer.timestamp.tv_sec) + std::chrono::microseconds(buffer.timestamp.tv_usec);
  // From here on the frame's end gives the buffer back, also when it is refused.
  Frame frame(raw, {Instant(at), buffer.sequence, (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0},
              &V4l2Camera::give_back, this, int(buffer.index));
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN)
    return Error{Errc::Unsupported,
                 "the camera's driver gives no time stamps of the machine's clock: pairs cannot be judged"};
  if (buffer.field != V4L2_FIELD_NONE && buffer.field != V4L2_FIELD_ANY)
    return Error{Errc::Unsupported,
                 "this camera gives interlaced fields, between which a face moves: set a progressive mode"};
  return frame;
}

void V4l2Camera::give_back(void* owner, int slot) {
  auto* camera = static_cast<V4l2Camera*>(owner);
  camera->buffers_[std::size_t(slot)].lent = false;
  // A buffer the driver does not take is queued anew with the next start.
  if (camera->state() == State::Running) (void)camera->queue(std::size_t(slot)).has_value();
}

}  // namespace relievo::hal
