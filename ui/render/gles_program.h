// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One GLES program. Names of GL objects are plain numbers here, so that no
// GL header is needed. Thread: main, with a current context.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "hal/base/result.h"

namespace relievo::ui {

// Errors: LibraryFailed with the driver's words.
Result<std::uint32_t> compile_program(const char* vertex, const char* fragment);

// Says what lies in the buffer that is bound, from its item `first` on: so many floats, or a colour, an
// attribute; those that follow are off.
inline constexpr int kFourBytes = 0;  // a colour: each byte a share of 255
void point_at(std::initializer_list<int> attributes, std::size_t first = 0, bool each_instance = false);

// The texture that is bound: linear, its edge repeated.
void smooth_texture();

}  // namespace relievo::ui
