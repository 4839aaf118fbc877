// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a screen sees of the appliance at this moment. Valid until the appliance's next step().
// Thread: main.
#pragma once

#include "firmware/appliance/appliance.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

ui::ViewState view_of(Appliance& appliance);

}  // namespace relievo::firmware
