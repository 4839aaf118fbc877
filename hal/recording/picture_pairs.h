// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/base/result.h"

namespace relievo::hal {

struct PicturePairFiles {
  std::string name;  // what follows "left" and "right", without _ or - before it; nothing does: "left/right"
  std::filesystem::path left, right;
};

// The left* and right* pictures (png, jpg) of a folder, paired by what follows in their names, in the order
// of their names. Errors: NotFound (no folder, no picture), InvalidInput (no partner, two of one name),
// IoFailed. Thread: any.
Result<std::vector<PicturePairFiles>> find_picture_pairs(const std::filesystem::path& folder);

}  // namespace relievo::hal
