// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fault: an error of the engine as the staff's pages show it: its code, which they say in the reader's
// language (ui/screens/service/fault_words.h), and its detail in English, as it was written. Visitors see
// none. Thread: any. Errors: none.
#pragma once

#include <string>
#include <string_view>

#include "hal/base/words.h"

namespace relievo::ui {

struct Fault {
  Errc code = Errc::InvalidState;
  std::string detail;  // where and what; empty: nothing is wrong
  bool empty() const { return detail.empty(); }
};

// The same, kept by somebody else: it costs no memory in every turn.
struct FaultView {
  FaultView() = default;
  FaultView(Errc whose, std::string_view what) : code(whose), detail(what) {}
  FaultView(const Fault& fault) : code(fault.code), detail(fault.detail) {}
  FaultView(Fault&&) = delete;  // it would not outlive this
  Errc code = Errc::InvalidState;
  std::string_view detail;
  bool empty() const { return detail.empty(); }
};

inline Fault fault_of(const Error& error) { return {error.code, detail_of(error)}; }

}  // namespace relievo::ui
