// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Portable float map, one channel ("Pf", width height, scale whose sign is the byte order, rows from the
// bottom up): how Middlebury 2014 and others store disparities. Infinite or NaN is "none", both ways.
// Errors: NotFound, IoFailed, InvalidInput (not such a file, of another length), each with the file.
#pragma once

#include <filesystem>
#include <vector>

#include "firmware/measure/disparity_map.h"
#include "hal/base/result.h"

namespace relievo::firmware::compare {

Result<DisparityMap> read_pfm(const std::filesystem::path& file);
std::vector<std::byte> pfm_of(const DisparityMap& map);  // little-endian

}  // namespace relievo::firmware::compare
