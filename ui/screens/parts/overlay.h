// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lies over a page of visitors and staff: help, languages, "leave?", "still there?". Thread: main. Errors:
// none.
#pragma once

#include "ui/screens/parts/page.h"

namespace relievo::ui {

void overlay_screen(Page& page);
// The languages a visitor may choose, each in its own letters, so many abreast.
void language_grid(Page& page, std::size_t columns);

}  // namespace relievo::ui
