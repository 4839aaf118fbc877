// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Switches of input devices, as the kernel tells of them: headphones in the jack of a sound card
// (SW_HEADPHONE_INSERT), somebody before a presence sensor (SW_FRONT_PROXIMITY). Their state is asked for, so
// that no event can be missed.
// Thread: one. Errors: none: what cannot be read is off. The program must be in the group input.
#pragma once

#include <memory>

#include "hal/input_switch.h"
#include "hal/linux/kernel.h"

namespace relievo::hal {

// Looked for once, in /dev/input/event0 to event31; on if one of them is. Empty: there is none.
std::unique_ptr<InputSwitch> find_headphone_jack(Kernel& kernel = real_kernel());
std::unique_ptr<InputSwitch> find_presence_sensor(Kernel& kernel = real_kernel());

}  // namespace relievo::hal
