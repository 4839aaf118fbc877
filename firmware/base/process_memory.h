// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory of the whole process, our own code's and every library's. No picture of it on any disk: people's
// faces and keys are in it. The heap is taken once, at boot, and bounded: else the C library gives large
// blocks back and takes them anew, page by page, in every visit, and a program that wants ever more memory
// gets it until the machine stands still. Thread: main.
#pragma once

#include <cstddef>
#include <functional>

#include "hal/base/result.h"

namespace relievo::firmware {

// To be called first of all. No core file (RLIMIT_CORE, also for what it starts), none through a handler, no
// reading by others of the same user (prctl(2), PR_SET_DUMPABLE). `measures_itself`: no core file, but
// dumpable: only then the system lets it restart the count of its peak of memory (proc(5), clear_refs).
// IoFailed: the system would not have it.
Result<void> forbid_core_dumps(bool measures_itself = false);

// Every page this process touches from now on stays in memory (mlockall(2)); what it has only reserved costs
// nothing. Where there is no swap nothing has to be done. IoFailed: there is swap, and this user may not lock
// as much as is needed. Called again it does nothing.
Result<void> keep_out_of_swap();

// Before any other thread, and before anything large is taken. One heap for all threads: with one of its own
// for some, a block of the same visit lies now in this one and now in that, and each grows to the largest.
// Large blocks come from it, too, and nothing goes back. Pages that nothing touches cost nothing.
// Errors: OutOfMemory.
Result<void> take_heap(std::size_t bytes);

// From here on all private memory of the process, the heap's growth, stacks and a driver's pages counted,
// grows by at most so many bytes (RLIMIT_DATA, getrlimit(2)): more is refused as if there were none, and
// std::bad_alloc ends what asked for it. Errors: IoFailed.
Result<void> bound_memory(std::size_t more_bytes);

// How often this thread has taken a block of the heap with operator new, since it began: for the figures
// of a scripted visit. Of the program alone, not of the libraries it is made of. Thread: any.
// Empty under a sanitizer, which has a heap of its own.
std::function<long()> allocation_count();

}  // namespace relievo::firmware
