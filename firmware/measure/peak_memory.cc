// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/peak_memory.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace relievo::firmware::compare {
namespace {

// A line of /proc/self/status: "VmHWM:	  123456 kB".
std::size_t status_bytes(std::string_view key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key)) return std::strtoull(line.c_str() + key.size(), nullptr, 10) * 1024;
  return 0;
}

// The high-water mark falls to what is held now (proc(5)).
bool restart_peak() {
  std::ofstream file("/proc/self/clear_refs");
  return static_cast<bool>(file << "5" << std::flush);
}

}  // namespace

PeakMemory::PeakMemory() : before_(restart_peak() ? status_bytes("VmRSS:") : 0) {}

std::size_t PeakMemory::above_bytes() const {
  const std::size_t peak = status_bytes("VmHWM:");
  return before_ == 0 || peak < before_ ? 0 : peak - before_;
}

}  // namespace relievo::firmware::compare
