// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The visitor's screens. Each is a function of ViewState and Visit alone: it fills the tree and
// remembers nothing. Thread: main. Errors: none.
#pragma once

#include <optional>

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

// What the pages with the live picture share: a mirror in a bright field, which lights the face, the oval
// with a ring that closes on it as the distance comes right, one advice at a time with a sign that says the
// same, and a head that shows what to do. Thread: main. Errors: none.
struct Said {
  const char* words = nullptr;
  const char* letter = nullptr;
  bool good = false;
  const char* spoken = nullptr;  // to who does not see the sign, where the words need it
};

inline constexpr float kMirrorEdge = 12;  // dp, of the screen: what stands there must not reach into the oval

// How the head that shows what to do is seen now; none where it would show nothing.
std::optional<FaceLook> gesture(const ViewState& view, Step step);
// What stands over the mirror is large already: it grows less, and leaves the face free.
float grown_over(const Page& page);
// Nobody is seen.
Said unseen(const Page& page);
// The page itself, with picture, oval and head; `share` of the oval's line is bright. `notes`: more than the
// advice stands above the oval. Closed by Tree::close().
void begin_mirror(Page& page, const Said& what, float share, bool notes = false);
void advice(Page& page, const Said& what, int countdown = 0);

}  // namespace relievo::ui
