// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who draws: what the current GL context says of its renderer, as "llvmpipe (LLVM 15.0.6, 256 bits)".
#pragma once

#include <string>

namespace relievo::test {

std::string gles_driver();

// As a driver that resets: the context this thread draws with is there no more, and nobody was told.
void lose_gles_context();

}  // namespace relievo::test
