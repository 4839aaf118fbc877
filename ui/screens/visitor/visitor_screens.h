// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The visitor's screens. Each is a function of ViewState and Visit alone: it fills the tree and
// remembers nothing. Thread: main. Errors: none.
#pragma once

#include "ui/screens/parts/keyboard.h"
#include "ui/screens/parts/page.h"

namespace relievo::ui {

// The screen of this moment, with what lies over it. Returns its palette.
const Palette& build_visitor_screen(Tree& tree, const ViewState& view, const Visit& visit,
                                    const Rect& screen);
// The pictures and the model that it shows.
void fill_pictures(DrawList& list, const ViewState& view, const Visit& visit);

void attract_screen(Page& page);
void consent_screen(Page& page);
void name_screen(Page& page);
void known_screen(Page& page);
void position_screen(Page& page);
void turn_screen(Page& page);
void working_screen(Page& page);
void review_screen(Page& page);
void thanks_screen(Page& page);
void declined_screen(Page& page);
void trouble_screen(Page& page);
void starting_screen(Page& page);

}  // namespace relievo::ui
