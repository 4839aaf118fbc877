// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A heap that keeps what it was given: what a visit has used the next one uses again, and nothing goes back
// to the system in between. Without it the C library gives large blocks back and takes them anew, page by
// page, in every visit. Called when what is taken once is taken: the one block of base/boot_memory.h. Thread:
// main.
#pragma once

#include <malloc.h>

namespace relievo::firmware {

inline void keep_heap_steady() {
  mallopt(M_MMAP_MAX, 0);         // large blocks from the heap, too
  mallopt(M_TRIM_THRESHOLD, -1);  // its end stays
  mallopt(M_TOP_PAD, 8 << 20);    // it grows by so much, in few steps
  mallopt(M_ARENA_MAX, 2);        // threads share: what one gave back another may use
}

}  // namespace relievo::firmware
