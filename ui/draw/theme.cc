// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/draw/theme.h"

namespace relievo::ui {

Colour pressed(Colour fill) {
  const auto darker = [](std::uint8_t v) { return std::uint8_t(v * 21 / 25); };
  return {darker(fill.r), darker(fill.g), darker(fill.b), fill.a};
}

}  // namespace relievo::ui
