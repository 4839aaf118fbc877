// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The default printer of CUPS, as the system has it (lpadmin -d). What is printed goes to it from memory.
#pragma once

#include <memory>

#include "hal/printer.h"

namespace relievo::hal {

std::unique_ptr<Printer> make_cups_printer();

}  // namespace relievo::hal
