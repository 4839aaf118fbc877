// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "storage/record.h"

namespace relievo::firmware {

// "2026-03-14 09:26 UTC"
std::string text_of(storage::WallTime time);

}  // namespace relievo::firmware
