// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/kernel/v4l2_fake_kernel.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <linux/videodev2.h>
#include <poll.h>

namespace relievo::hal {
namespace {

constexpr int kFile = 7;
constexpr std::uint32_t kTriggerId = V4L2_CID_USER_BASE + 0x1010;

KernelCall call_of(unsigned long request) {
  switch (request) {
    case VIDIOC_QUERYCAP: return KernelCall::QueryCap;
    case VIDIOC_G_INPUT: return KernelCall::GetInput;
    case VIDIOC_ENUMINPUT: return KernelCall::EnumInput;
    case VIDIOC_QUERY_DV_TIMINGS: return KernelCall::QueryTimings;
    case VIDIOC_S_DV_TIMINGS: return KernelCall::SetTimings;
    case VIDIOC_ENUM_FMT: return KernelCall::EnumFormats;
    case VIDIOC_S_FMT: return KernelCall::SetFormat;
    case VIDIOC_G_PARM: return KernelCall::GetInterval;
    case VIDIOC_S_PARM: return KernelCall::SetInterval;
    case VIDIOC_QUERYCTRL: return KernelCall::QueryControl;
    case VIDIOC_S_CTRL: return KernelCall::SetControl;
    case VIDIOC_REQBUFS: return KernelCall::RequestBuffers;
    case VIDIOC_QUERYBUF: return KernelCall::QueryBuffer;
    case VIDIOC_QBUF: return KernelCall::Queue;
    case VIDIOC_STREAMON: return KernelCall::StreamOn;
    case VIDIOC_DQBUF: return KernelCall::Dequeue;
    case VIDIOC_STREAMOFF: return KernelCall::StreamOff;
    default: return KernelCall::Count;
  }
}

template <typename T>
T& as(void* argument) {
  return *static_cast<T*>(argument);
}

}  // namespace

FakeKernel::FakeKernel() : formats{V4L2_PIX_FMT_GREY}, stamp_flags(V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {}

int FakeKernel::failure(KernelCall call) {
  ++calls_[call];
  const auto found = failures_.find(call);
  if (found == failures_.end()) return 0;
  if (found->second.after-- > 0) return 0;
  const int error = found->second.error;
  failures_.erase(found);
  return -error;
}

int FakeKernel::calls(KernelCall call) const {
  const auto found = calls_.find(call);
  return found == calls_.end() ? 0 : found->second;
}

std::size_t FakeKernel::picture_bytes() const {
  return static_cast<std::size_t>(width_px + padding_bytes) * static_cast<std::size_t>(height_px);
}

void FakeKernel::expose(const Exposed& exposed) {
  ++sequence_;
  if (!streaming || queue_.empty()) return;
  const std::uint32_t index = queue_.front();
  queue_.pop_front();
  std::memset(memory_[index].data(), exposed.value, memory_[index].size());
  filled_.push_back({index, exposed, clock.now(), sequence_ - 1});
}

int FakeKernel::open(const char*) {
  if (const int f = failure(KernelCall::Open)) return f;
  if (!plugged_) return -ENOENT;
  if (open_files > 0) return -EBUSY;
  ++open_files;
  gone_for_file_ = false;
  return kFile;
}

int FakeKernel::close(int) {
  if (mapped > 0) complain("closed with its buffers mapped");
  --open_files;
  streaming = false;
  queue_.clear();
  filled_.clear();
  memory_.clear();
  return 0;
}

void* FakeKernel::map(int, std::size_t bytes, std::uint32_t offset) {
  if (failure(KernelCall::Map) != 0) return nullptr;
  if (offset >= memory_.size() || bytes != memory_[offset].size()) complain("mapped what is no buffer");
  ++mapped;
  return memory_[offset].data();
}

void FakeKernel::unmap(void*, std::size_t) { --mapped; }

int FakeKernel::poll(int, int wait_ms) {
  if (const int f = failure(KernelCall::Poll)) return f;
  if (!plugged_) gone_for_file_ = true;
  if (gone_for_file_) return POLLERR | POLLHUP;
  if (!filled_.empty()) return POLLIN;
  if (announced != 0) {
    clock.now_at += std::chrono::milliseconds(1);
    return ++announced_in_vain_ < 1000 ? announced : -EIO;
  }
  clock.now_at += std::chrono::milliseconds(wait_ms);
  return 0;
}

int FakeKernel::ioctl(int file, unsigned long request, void* argument) {
  if (file != kFile || open_files != 1) complain("asked a file that is not open");
  if (const int f = failure(call_of(request))) return f;
  if (!plugged_) gone_for_file_ = true;
  if (gone_for_file_) return -ENODEV;
  return answer(request, argument);
}

int FakeKernel::set_format(void* argument) const {
  auto& pix = as<v4l2_format>(argument).fmt.pix;
  if (std::find(formats.begin(), formats.end(), pix.pixelformat) == formats.end()) return -EINVAL;
  pix.width = static_cast<std::uint32_t>(width_px);
  pix.height = static_cast<std::uint32_t>(height_px);
  pix.field = interlaced ? V4L2_FIELD_INTERLACED : V4L2_FIELD_NONE;
  pix.bytesperline = static_cast<std::uint32_t>(width_px + padding_bytes);
  pix.sizeimage = static_cast<std::uint32_t>(picture_bytes());
  return 0;
}

int FakeKernel::answer(unsigned long request, void* argument) {
  switch (request) {
    case VIDIOC_QUERYCAP: {
      auto& can = as<v4l2_capability>(argument);
      can.capabilities = V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
      can.device_caps = (!is_camera       ? V4L2_CAP_META_CAPTURE
                         : several_planes ? V4L2_CAP_VIDEO_CAPTURE_MPLANE
                                          : V4L2_CAP_VIDEO_CAPTURE) |
                        (streams ? V4L2_CAP_STREAMING : 0U);
      return 0;
    }
    case VIDIOC_G_INPUT: as<int>(argument) = 0; return 0;
    case VIDIOC_ENUMINPUT:
      as<v4l2_input>(argument).status = no_signal ? V4L2_IN_ST_NO_SIGNAL : 0;
      as<v4l2_input>(argument).capabilities = has_timings ? V4L2_IN_CAP_DV_TIMINGS : 0;
      return 0;
    case VIDIOC_QUERY_DV_TIMINGS:
      as<v4l2_dv_timings>(argument).bt.interlaced =
          interlaced_signal ? V4L2_DV_INTERLACED : V4L2_DV_PROGRESSIVE;
      return 0;
    case VIDIOC_S_DV_TIMINGS: return 0;
    case VIDIOC_ENUM_FMT: {
      auto& format = as<v4l2_fmtdesc>(argument);
      if (format.index >= formats.size()) return -EINVAL;
      format.pixelformat = formats[format.index];
      return 0;
    }
    case VIDIOC_S_FMT: return set_format(argument);
    case VIDIOC_G_PARM:
      if (has_timings) return -ENOTTY;
      as<v4l2_streamparm>(argument).parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
      return 0;
    case VIDIOC_S_PARM: return has_timings ? -ENOTTY : 0;
    case VIDIOC_QUERYCTRL:
    case VIDIOC_QUERYMENU:
    case VIDIOC_S_CTRL: return answer_control(request, argument);
    default: return answer_buffer(request, argument);
  }
}

int FakeKernel::answer_control(unsigned long request, void* argument) {
  if (request == VIDIOC_S_CTRL) {
    const auto& control = as<v4l2_control>(argument);
    set_controls[control.id] = control.value;
    return 0;
  }
  if (request == VIDIOC_QUERYMENU) {
    auto& entry = as<v4l2_querymenu>(argument);
    if (entry.index >= trigger_menu.size() || trigger_menu[entry.index].empty()) return -EINVAL;
    trigger_menu[entry.index].copy(reinterpret_cast<char*>(entry.name), sizeof entry.name - 1);
    return 0;
  }
  auto& asked = as<v4l2_queryctrl>(argument);
  const std::uint32_t id = asked.id;
  asked.minimum = 1;
  if ((id & V4L2_CTRL_FLAG_NEXT_CTRL) != 0) {
    if (trigger_control.empty() || (id & ~static_cast<std::uint32_t>(V4L2_CTRL_FLAG_NEXT_CTRL)) >= kTriggerId)
      return -EINVAL;
    asked.id = kTriggerId;
    asked.type = trigger_menu.empty() ? V4L2_CTRL_TYPE_BOOLEAN : V4L2_CTRL_TYPE_MENU;
    asked.minimum = 0;
    asked.maximum = trigger_menu.empty() ? 1 : std::int32_t(trigger_menu.size()) - 1;
    std::memcpy(asked.name, trigger_control.data(), std::min(trigger_control.size(), sizeof asked.name - 1));
    return 0;
  }
  if (!has_exposure) return -EINVAL;
  asked.maximum = id == V4L2_CID_EXPOSURE_ABSOLUTE ? 5000 : 255;
  return id == V4L2_CID_EXPOSURE_ABSOLUTE || id == V4L2_CID_GAIN ? 0 : -EINVAL;
}

int FakeKernel::answer_buffer(unsigned long request, void* argument) {
  switch (request) {
    case VIDIOC_REQBUFS: {
      auto& wanted = as<v4l2_requestbuffers>(argument);
      wanted.count = std::min(wanted.count, most_buffers);
      memory_.assign(wanted.count, std::vector<std::byte>(picture_bytes()));
      return 0;
    }
    case VIDIOC_QUERYBUF: {
      auto& buffer = as<v4l2_buffer>(argument);
      if (buffer.index >= memory_.size()) return -EINVAL;
      buffer.length = static_cast<std::uint32_t>(memory_[buffer.index].size());
      buffer.m.offset = buffer.index;
      return 0;
    }
    case VIDIOC_QBUF: {
      const std::uint32_t index = as<v4l2_buffer>(argument).index;
      const bool filled =
          std::any_of(filled_.begin(), filled_.end(), [&](const Filled& f) { return f.index == index; });
      if (filled || std::find(queue_.begin(), queue_.end(), index) != queue_.end())
        complain("queued a buffer twice");
      queue_.push_back(index);
      return 0;
    }
    case VIDIOC_STREAMON:
      if (queue_.empty()) complain("streams without a buffer");
      streaming = true;
      return 0;
    case VIDIOC_STREAMOFF:
      streaming = false;
      queue_.clear();
      filled_.clear();
      return 0;
    case VIDIOC_DQBUF: {
      if (!streaming) return -EINVAL;
      if (filled_.empty()) return -EAGAIN;
      const Filled first = filled_.front();
      filled_.pop_front();
      auto& buffer = as<v4l2_buffer>(argument);
      buffer.index = first.index;
      buffer.sequence = first.sequence;
      buffer.bytesused =
          first.exposed.bytes != 0 ? first.exposed.bytes : static_cast<std::uint32_t>(picture_bytes());
      buffer.field = interlaced ? V4L2_FIELD_INTERLACED : V4L2_FIELD_NONE;
      buffer.flags = stamp_flags | (first.exposed.damaged ? V4L2_BUF_FLAG_ERROR : 0);
      const auto since =
          std::chrono::duration_cast<std::chrono::microseconds>(first.at.time_since_epoch()).count();
      buffer.timestamp.tv_sec = since / 1'000'000;
      buffer.timestamp.tv_usec = since % 1'000'000;
      return 0;
    }
    default: return -ENOTTY;
  }
}

}  // namespace relievo::hal
