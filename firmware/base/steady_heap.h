// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The heap of the whole process, our own code's and every library's: taken once, at boot, and bounded.
// Without it the C library gives large blocks back and takes them anew, page by page, in every visit, and a
// program that wants ever more memory gets it until the machine stands still. Thread: main.
#pragma once

#include <cstddef>

#include "hal/base/result.h"

namespace relievo::firmware {

// Before any other thread, and before anything large is taken. One heap for all threads: with one of its own
// for some, a block of the same visit lies now in this one and now in that, and each grows to the largest.
// Large blocks come from it, too, and nothing goes back. Pages that nothing touches cost nothing.
// Errors: OutOfMemory.
Result<void> take_heap(std::size_t bytes);

// From here on all private memory of the process, the heap's growth, stacks and a driver's pages counted,
// grows by at most so many bytes (RLIMIT_DATA, getrlimit(2)): more is refused as if there were none, and
// std::bad_alloc ends what asked for it. Errors: IoFailed.
Result<void> bound_memory(std::size_t more_bytes);

}  // namespace relievo::firmware
