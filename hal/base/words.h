// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// English sentences with values in them, for reports, logs and technicians. Thread: any. Errors: those of
// memory.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "hal/base/result.h"

namespace relievo {

// A dash where there is no number.
std::string decimal(double number, int decimals, bool with_sign = false);

// `pattern` with the values in its places {}, in their order.
std::string filled(std::string_view pattern, std::initializer_list<std::string_view> values);

// A name that somebody else gave, as a person may see it: on one line, in its own direction. What steers a
// line, and bytes that are no UTF-8, become '?'.
std::string shown_name(std::string_view name);

// "where: what (what the system said)" on one line, whatever a file is called, as shown_name().
std::string detail_of(const Error& error);

}  // namespace relievo
