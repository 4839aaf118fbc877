// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Screenshots: every screen in every language, size and text size, for people to look at; and one
// contact sheet for each of these. What is shown is real: the simulated rig is enrolled once.
// Files: DIR/SIZE_TEXT_LANGUAGE/NN_screen.png, beside it NN_screen.json (its nodes: role, name, place), and
// DIR/sheet_SIZE_TEXT_LANGUAGE.png; with `--showpiece`, the head for the page that invites.
// Thread: main, with a current GL context. Errors: IoFailed, MediaFull; what the enrolment says.
#pragma once

#include "firmware/kiosk/kiosk.h"

namespace relievo::firmware {

Result<void> take_screenshots(const KioskArgs& args, Kiosk& kiosk, Console& console);

}  // namespace relievo::firmware
