// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kernel: the system calls a camera needs. The seam at which tests put a device that fails in every way
// a driver can. Each call gives what the system call of its name gives, but a negative errno for -1.
// Thread: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "hal/base/result.h"

namespace relievo::hal {

class Kernel {
 public:
  virtual ~Kernel() = default;
  virtual int open(const char* path) = 0;  // to read and write, never blocking
  virtual int close(int file) = 0;
  virtual int ioctl(int file, unsigned long request, void* argument) = 0;
  virtual void* map(int file, std::size_t bytes, std::uint32_t offset) = 0;  // nullptr: refused
  virtual void unmap(void* memory, std::size_t bytes) = 0;
  // Waits for a picture; the events seen, 0 when the time is over.
  virtual int poll(int file, int wait_ms) = 0;
  // What tells this device from all others of its kind (of USB: iSerial); empty where it has none.
  virtual std::string serial_of(const char* path) = 0;
};

Kernel& real_kernel();

// What a signal interrupted is done once more.
int open_device(Kernel& kernel, const char* path);
int call(Kernel& kernel, int file, unsigned long request, void* argument);
// A device that is gone says so by any of several numbers; then `otherwise` becomes Disconnected.
Error device_error(int negative_errno, const Error& otherwise);

}  // namespace relievo::hal
