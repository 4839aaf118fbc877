// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The true surface of a simulated head, also where no camera sees it: head.ply (binary, float x y z,
// triangles) in the left camera's frame, millimetres.
// Errors: NotFound, IoFailed, InvalidInput. Thread: any.
#pragma once

#include <filesystem>
#include <string_view>

#include "firmware/measure/triangle_grid.h"
#include "hal/base/result.h"

namespace relievo::firmware::measure {

Result<Surface> read_true_surface(const std::filesystem::path& file);
// Nothing but this one form of PLY. An error has no place.
Result<Surface> parse_true_surface(std::string_view bytes);

}  // namespace relievo::firmware::measure
