// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RELIEVO_SIMD: compile the function that follows once for the plain machine and once for wide
// vectors, chosen when the program starts. The loops are written so that the compiler vectorises
// them (independent lanes, no branches); on arm64 NEON is always there. A vector library would say the
// same in more words: what these loops need of one is the choice at start, and that is this line.
// A level of the instruction set is named, not a processor: "arch=haswell" is chosen on no other maker's machine.
// Sanitizers and clang 14 get the plain version: the start-up resolver runs before a sanitizer is ready.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(RELIEVO_SANITIZED)
#define RELIEVO_SIMD __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define RELIEVO_SIMD
#endif
