// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The headphone jack of a sound card, as the kernel tells of it: a switch of an input device
// (SW_HEADPHONE_INSERT). Its state is asked for, so that no event can be missed.
// Thread: one. Errors: none: a jack that cannot be read is not plugged. The program must be in the group
// input.
#pragma once

#include <memory>

#include "hal/linux/kernel.h"
#include "hal/speaker.h"

namespace relievo::hal {

// Looks for such jacks once, in /dev/input/event0 to event31; plugged if one of them is. Empty: there is
// none.
std::unique_ptr<HeadphoneJack> find_headphone_jack(Kernel& kernel = real_kernel());

}  // namespace relievo::hal
