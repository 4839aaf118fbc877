// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// No picture of this process's memory on any disk: people's faces and keys are in it. To be called first of
// all. Thread: main.
#pragma once

#include "hal/base/result.h"

namespace relievo::firmware {

// No core file (RLIMIT_CORE, also for what it starts), none through a handler, no reading by others of the
// same user (prctl(2), PR_SET_DUMPABLE). `measures_itself`: no core file, but dumpable: only then the system
// lets it restart the count of its peak of memory (proc(5), clear_refs). IoFailed: the system would not have
// it.
Result<void> forbid_core_dumps(bool measures_itself = false);

// Every page this process touches from now on stays in memory (mlockall(2)); what it has only reserved costs
// nothing. Where there is no swap nothing has to be done. IoFailed: there is swap, and this user may not lock
// as much as is needed. Called again it does nothing.
Result<void> keep_out_of_swap();

}  // namespace relievo::firmware
