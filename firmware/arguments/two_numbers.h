// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two whole numbers in one word of a command: "1280x800", "-16:256". Thread: any.
#pragma once

#include <optional>
#include <string_view>

namespace relievo::firmware {

struct TwoNumbers {
  int first = 0, second = 0;
};

// Nothing where `text` is anything but two numbers that an int holds, with `between` between them.
std::optional<TwoNumbers> two_numbers(std::string_view text, char between);

}  // namespace relievo::firmware
