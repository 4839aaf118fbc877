// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cerrno>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "hal/linux/kernel.h"

namespace relievo::hal {
namespace {

int or_errno(int result) { return result < 0 ? -errno : result; }

class RealKernel final : public Kernel {
 public:
  int open(const char* path) override { return or_errno(::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC)); }
  int close(int file) override { return or_errno(::close(file)); }
  int ioctl(int file, unsigned long request, void* argument) override {
    return or_errno(::ioctl(file, request, argument));
  }
  void* map(int file, std::size_t bytes, std::uint32_t offset) override {
    void* const memory =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, static_cast<off_t>(offset));
    return memory == MAP_FAILED ? nullptr : memory;
  }
  void unmap(void* memory, std::size_t bytes) override { ::munmap(memory, bytes); }
  int poll(int file, int wait_ms) override {
    pollfd asked{file, POLLIN, 0};
    const int ready = ::poll(&asked, 1, wait_ms);
    return ready > 0 ? asked.revents : or_errno(ready);
  }
  // The device node's interface hangs below the USB device, which has the number.
  std::string serial_of(const char* path) override {
    std::error_code failed;
    const auto node = std::filesystem::canonical(path, failed);
    if (failed) return {};
    const auto interface =
        std::filesystem::canonical("/sys/class/video4linux" / node.filename() / "device", failed);
    if (failed) return {};
    std::string serial;
    std::ifstream file(interface.parent_path() / "serial");
    std::getline(file, serial);
    return serial;
  }
};

}  // namespace

Kernel& real_kernel() {
  static RealKernel kernel;
  return kernel;
}

int open_device(Kernel& kernel, const char* path) {
  int file = -EINTR;
  while (file == -EINTR) file = kernel.open(path);
  return file;
}

int call(Kernel& kernel, int file, unsigned long request, void* argument) {
  int result = -EINTR;
  while (result == -EINTR) result = kernel.ioctl(file, request, argument);
  return result;
}

Error device_error(int negative_errno, const Error& otherwise) {
  Error error = otherwise;
  error.sys_errno = -negative_errno;
  if (negative_errno != -ENODEV && negative_errno != -ENXIO && negative_errno != -ESHUTDOWN) return error;
  error.code = Errc::Disconnected;
  error.what = "the camera is gone: check its plug";
  return error;
}

}  // namespace relievo::hal
