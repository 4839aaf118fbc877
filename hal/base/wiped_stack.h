// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// wipe_stack(): what the functions that have returned left on this thread's stack goes: names and rows of
// pictures lie there until something else is called as deeply. Thread: any, for its own.
#pragma once

#include <string.h>

#include <array>
#include <cstddef>

namespace relievo {

[[gnu::noinline]] inline void wipe_stack() {
  std::array<std::byte, std::size_t{256} << 10> below;  // deeper than what was seen to be left
  explicit_bzero(below.data(), below.size());
}

}  // namespace relievo
