// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A text as a QR code: Grey8, black on white with the margin readers want, kCodeModulePx pixels a module.
// Thread: any. Errors: an empty picture, where a text has no room in a code.
#pragma once

#include <string_view>

#include "hal/picture_file.h"

namespace relievo::firmware {

inline constexpr int kCodeModulePx = 8;
hal::Picture code_picture(std::string_view text);

}  // namespace relievo::firmware
