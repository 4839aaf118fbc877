// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// code_text(): what a QR code says, if it could be a name or a number: strict UTF-8 of 1 to
// ui::kMostNameBytes bytes, spaces put in order, no control, direction or invisible characters, no web
// address. Else nothing. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace relievo::firmware {

std::optional<std::string> code_text(std::string_view raw);

}  // namespace relievo::firmware
