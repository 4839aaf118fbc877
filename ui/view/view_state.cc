// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/view/view_state.h"

namespace relievo::ui {

std::string_view name_of(Screen screen) {
  switch (screen) {
    case Screen::SelfTest:
      return "SelfTest";
    case Screen::Idle:
      return "Idle";
    case Screen::Calibrate:
      return "Calibrate";
    case Screen::Position:
      return "Position";
    case Screen::Capture:
      return "Capture";
    case Screen::Turn:
      return "Turn";
    case Screen::Match:
      return "Match";
    case Screen::Reconstruct:
      return "Reconstruct";
    case Screen::Mesh:
      return "Mesh";
    case Screen::Texture:
      return "Texture";
    case Screen::Fuse:
      return "Fuse";
    case Screen::Review:
      return "Review";
    case Screen::Store:
      return "Store";
    case Screen::Export:
      return "Export";
    case Screen::Staff:
      return "Staff";
    case Screen::Fault:
      return "Fault";
  }
  return "?";
}

}  // namespace relievo::ui
