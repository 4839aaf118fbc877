// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PeakMemory: the most memory the process held resident since this was made, above what it held then: arenas
// and every library's heap together. Linux counts it; elsewhere, or where /proc may not be written, 0.
// Thread: any, one at a time.
#pragma once

#include <cstddef>

namespace relievo::firmware::compare {

class PeakMemory {
 public:
  PeakMemory();
  std::size_t above_bytes() const;

 private:
  std::size_t before_ = 0;
};

}  // namespace relievo::firmware::compare
