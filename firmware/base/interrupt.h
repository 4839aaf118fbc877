// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Interrupt: Ctrl-C, SIGTERM and SIGHUP set a flag that every job asks; the command then ends cleanly, with
// nothing half-written. A second Ctrl-C ends the process at once. Under nohup SIGHUP does nothing. One per
// process.
#pragma once

#include <atomic>

namespace relievo::firmware {

// Installs the handlers on first use.
const std::atomic<bool>& interrupted();

}  // namespace relievo::firmware
