// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The technician's picture pages for the gallery: with the pictures and the model of the view that is lent,
// the algorithms there are, and figures that somebody made up. Thread: main. Errors: none.
#pragma once

#include <vector>

#include "firmware/demo/gallery.h"

namespace relievo::firmware {

// `review`: the view that lends, which must outlive the exhibits; what else they borrow lives until the next
// call.
void add_technician_exhibits(std::vector<Exhibit>& exhibits, const ui::ViewState& review,
                             const ui::ViewState& idle, const ui::Visit& visit);

}  // namespace relievo::firmware
