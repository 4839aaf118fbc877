// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How often this thread has taken a block of the heap with operator new, since it began: for the figures
// of a scripted visit. Of the program alone, not of the libraries it is made of. Thread: any.
#pragma once

#include <functional>

namespace relievo::firmware {

// Empty under a sanitizer, which has a heap of its own.
std::function<long()> allocation_count();

}  // namespace relievo::firmware
