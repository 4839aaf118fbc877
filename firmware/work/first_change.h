// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a reconstruction has to begin again when its algorithms change. Thread: any. Errors: none.
#pragma once

#include "firmware/machine/transition.h"
#include "pipeline/algorithms.h"

namespace relievo::firmware {

// The first stage that one of the differing choices has a part in; Review: none differs.
State first_change(const pipeline::AlgorithmSet& before, const pipeline::AlgorithmSet& after);

}  // namespace relievo::firmware
