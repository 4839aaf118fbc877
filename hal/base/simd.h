// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RELIEVO_SIMD: compile the function that follows once for the plain machine and once for wide vectors,
// chosen when the program starts. The loops are written so that the compiler vectorises them (independent
// lanes, no branches); on arm64 NEON is always there. A vector library would say the same in more words: what
// these loops need of one is the choice at start, and that is this line. "avx2" and no level of the
// instruction set: x86-64-v3 fuses products and sums into one rounding, and then a processor without gives
// another face. Nor a processor: "arch=haswell" is chosen on no other maker's machine. Sanitizers and clang
// 14 get the plain version: the start-up resolver runs before a sanitizer is ready.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(RELIEVO_SANITIZED)
#define RELIEVO_SIMD __attribute__((target_clones("avx2", "default")))
#else
#define RELIEVO_SIMD
#endif
