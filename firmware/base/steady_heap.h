// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A heap that keeps what it was given: what a visit has used the next one uses again, and nothing goes back
// to the system in between. Without it the C library gives large blocks back and takes them anew, page by
// page, in every visit. Thread: main.
#pragma once

#include <malloc.h>

namespace relievo::firmware {

// Before any other thread: with a heap of its own for some threads, a block of the same visit lies now in
// this one and now in that, and each grows to the largest.
inline void share_one_heap() { mallopt(M_ARENA_MAX, 1); }

// When what is taken once is taken: the one block of base/boot_memory.h.
inline void keep_heap_steady() {
  mallopt(M_MMAP_MAX, 0);         // large blocks from the heap, too
  mallopt(M_TRIM_THRESHOLD, -1);  // its end stays
  mallopt(M_TOP_PAD, 8 << 20);    // it grows by so much, in few steps
}

}  // namespace relievo::firmware
