// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace relievo::firmware {

// Threads for a stage, the worker counted: as many as the machine has, at most budget's limit.
int pool_size();

}  // namespace relievo::firmware
