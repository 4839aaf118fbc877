// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// White paper with a QR code in its middle, ten pixels a module; grey.
#pragma once

#include <string>

#include "hal/picture_file.h"

namespace relievo::test {

hal::Picture printed_code(const std::string& text);

}  // namespace relievo::test
