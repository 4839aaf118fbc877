// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// QR codes, made and read. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hal/picture_file.h"

namespace relievo::firmware {

// Grey8, black on white with the margin readers want. An empty picture: the text has no room in a code.
inline constexpr int kCodeModulePx = 8;
hal::Picture code_picture(std::string_view text);

// The text of a code in a picture, Grey8 or Rgb8, as the camera has it, not mirrored. What cannot be read is
// not there.
std::optional<std::string> read_code(const ImageView& picture);

}  // namespace relievo::firmware
