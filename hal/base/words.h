// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// English sentences with values in them, for reports, logs and technicians. Thread: any. Errors: those of
// memory.
#pragma once

#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "hal/base/result.h"

namespace relievo {

// A dash where there is no number.
std::string decimal(double number, int decimals, bool with_sign = false);

// What printf(3) prints; 511 bytes at most.
[[gnu::format(printf, 1, 2)]] std::string printed(const char* format, ...);

// `pattern` with the values in its places {}, in their order.
std::string filled(std::string_view pattern, std::initializer_list<std::string_view> values);

// A name that somebody else gave, as a person may see it: on one line, in its own direction. What steers a
// line, and bytes that are no UTF-8, become '?'.
std::string shown_name(std::string_view name);

// What a library's or the system's number means to a person: as the first row says that names it; one that
// names none is for all others. Without a place.
struct Meaning {
  std::array<int, 3> numbers{};
  Errc code{};
  Literal what;
};
Error meaning_of(int number, std::span<const Meaning> rows);

// "where: what (what the system said)" on one line, whatever a file is called, as shown_name().
std::string detail_of(const Error& error);

}  // namespace relievo
