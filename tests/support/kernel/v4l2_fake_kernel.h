// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FakeKernel: one V4L2 device, as a driver shows it, that fails when and how a test wants. It keeps the
// rules real drivers keep: a buffer is queued once, nothing streams without buffers, a mapping ends with
// its file; a broken rule is a word in `complaints`. Time moves when somebody waits.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "hal/clock.h"
#include "hal/linux/kernel.h"

namespace relievo::hal {

// The calls a test may let fail, in the order in which a camera makes them.
enum class KernelCall : std::uint8_t {
  Open,
  QueryCap,
  GetInput,
  EnumInput,
  QueryTimings,
  SetTimings,
  EnumFormats,
  SetFormat,
  GetInterval,
  SetInterval,
  QueryControl,
  SetControl,
  RequestBuffers,
  QueryBuffer,
  Map,
  Queue,
  StreamOn,
  Poll,
  Dequeue,
  StreamOff,
  Count
};

class FakeKernel final : public Kernel {
 public:
  class Time final : public Clock {
   public:
    Instant now_at = Instant{} + std::chrono::seconds(50);
    Instant now() const override { return now_at; }
    std::chrono::system_clock::time_point wall_now() const override { return {}; }
  };

  // The device.
  bool is_camera = true, several_planes = false, streams = true;
  bool has_timings = false, interlaced_signal = false, no_signal = false;
  bool interlaced = false;
  bool has_exposure = true;
  std::string trigger_control = "Trigger Mode";  // empty: none
  std::vector<std::string> trigger_menu;         // its entries; empty: it is on or off, no menu
  std::vector<std::uint32_t> formats;            // default: GREY
  int width_px = 64, height_px = 48;             // the only size
  int padding_bytes = 16;
  std::string serial = "A1";
  unsigned most_buffers = 8;
  std::uint32_t stamp_flags;  // default: monotonic

  // What it was told.
  std::map<std::uint32_t, std::int32_t> set_controls;
  std::vector<std::string> complaints;
  short announced = 0;  // what poll tells at once, though there is no picture
  bool streaming = false;
  int open_files = 0, mapped = 0;
  int queued() const { return static_cast<int>(queue_.size()); }

  // The next of such calls fails with this errno; 0 counts down how many still succeed.
  void fail(KernelCall call, int error, int after = 0) { failures_[call] = {error, after}; }
  int calls(KernelCall call) const;
  // A picture exposed now; every byte has this value. Lost where no buffer is queued.
  struct Exposed {
    std::uint8_t value = 0;
    bool damaged = false;
    std::uint32_t bytes = 0;  // 0: the whole picture
  };
  void expose(const Exposed& exposed);
  void unplug() { plugged_ = false; }
  void plug_in() { plugged_ = true; }

  FakeKernel();
  Time clock;

  int open(const char* path) override;
  int close(int file) override;
  int ioctl(int file, unsigned long request, void* argument) override;
  void* map(int file, std::size_t bytes, std::uint32_t offset) override;
  void unmap(void* memory, std::size_t bytes) override;
  int poll(int file, int wait_ms) override;
  std::string serial_of(const char*) override { return serial; }

 private:
  struct Failure {
    int error = 0;
    int after = 0;
  };
  struct Filled {
    std::uint32_t index;
    Exposed exposed;
    Instant at;
    std::uint32_t sequence;
  };
  int failure(KernelCall call);
  int answer(unsigned long request, void* argument);
  int answer_control(unsigned long request, void* argument);
  int answer_buffer(unsigned long request, void* argument);
  int set_format(void* argument) const;
  std::size_t picture_bytes() const;
  void complain(const char* what) { complaints.emplace_back(what); }

  std::map<KernelCall, Failure> failures_;
  std::map<KernelCall, int> calls_;
  std::vector<std::vector<std::byte>> memory_;
  std::deque<std::uint32_t> queue_;
  std::deque<Filled> filled_;
  std::uint32_t sequence_ = 0;
  bool plugged_ = true;
  int announced_in_vain_ = 0;
  bool gone_for_file_ = false;  // unplugged while open: the file stays dead
};

}  // namespace relievo::hal
