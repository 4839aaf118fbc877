// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// stand_behind_the_page(): from now on the calling thread, and whatever threads it begins, get the processor
// when the main thread and the GL driver's leave it: a face that takes a moment longer is not noticed, a
// button that does not answer a finger is. Linux has this per thread. Thread: any; nothing on main.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

namespace relievo::firmware {

inline void stand_behind_the_page() {
#ifndef RELIEVO_SANITIZED  // there a page is always busy, and what stands behind it would outlast a visitor
  constexpr int kBehind = 10;
  if (gettid() == getpid()) return;
  (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, static_cast<id_t>(getpid())) + kBehind);
#endif
}

}  // namespace relievo::firmware
