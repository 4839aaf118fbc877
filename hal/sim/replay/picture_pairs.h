// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The left and right pictures of a folder, paired by what follows "left" and "right" in their
// names, in name order. Errors: NotFound (no folder, no picture), InvalidInput (no partner).
// Thread: any.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/base/result.h"

namespace relievo::hal {

struct PicturePairFiles {
  std::filesystem::path left, right;
  std::string rest;  // between "left" and the extension: "_000001"
};

Result<std::vector<PicturePairFiles>> find_picture_pairs(const std::filesystem::path& folder);

}  // namespace relievo::hal
