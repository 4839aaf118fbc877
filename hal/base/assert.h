// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RELIEVO_ASSERT: for what only a bug of ours can break. The process dies with one line, is
// restarted by the watchdog and tests itself; it never goes on with a broken promise.
#pragma once

#include <cstdio>
#include <cstdlib>

#define RELIEVO_ASSERT(condition)                                                          \
  do {                                                                                     \
    if (!(condition)) {                                                                    \
      std::fprintf(stderr, "relievo: bug: %s at %s:%d\n", #condition, __FILE__, __LINE__); \
      std::abort();                                                                        \
    }                                                                                      \
  } while (false)
