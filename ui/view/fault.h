// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fault: an error of the engine as the staff's pages show it: its code, which they say in the reader's
// language (ui/screens/service/fault_words.h), and its detail in English, as it was written. Visitors see
// none. Thread: any. Errors: none.
#pragma once

#include <string>

#include "hal/base/words.h"

namespace relievo::ui {

struct Fault {
  Errc code = Errc::InvalidState;
  std::string detail;  // where and what; empty: nothing is wrong
  bool empty() const { return detail.empty(); }
};

inline Fault fault_of(const Error& error) { return {error.code, detail_of(error)}; }

}  // namespace relievo::ui
