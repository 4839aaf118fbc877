// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's pages for the gallery: each with figures that somebody made up, and nobody's face but
// the one that is lent. Thread: main. Errors: none.
#pragma once

#include <vector>

#include "firmware/demo/gallery.h"

namespace relievo::firmware {

// `idle`: the view behind them; what they borrow lives for ever.
void add_staff_exhibits(std::vector<Exhibit>& exhibits, const ui::ViewState& idle, const ui::Visit& visit);

}  // namespace relievo::firmware
