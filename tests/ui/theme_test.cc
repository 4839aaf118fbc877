// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/draw/theme.h"

#include <gtest/gtest.h>

#include "tests/support/contrast.h"

namespace relievo::ui {
namespace {

TEST(Theme, ContrastIsAsWcagDefinesIt) {
  EXPECT_NEAR(contrast({0, 0, 0, 255}, {255, 255, 255, 255}), 21.0, 1e-9);
  EXPECT_NEAR(contrast({119, 119, 119, 255}, {255, 255, 255, 255}), 4.48,
              0.01);  // the known border case #777
  EXPECT_NEAR(contrast({200, 10, 10, 255}, {200, 10, 10, 255}), 1.0, 1e-9);
}

void every_text_can_be_read(const Palette& p, const char* name) {
  struct Pair {
    const char* what;
    Colour text, ground;
  };
  const Pair pairs[] = {{"ink", p.ink, p.ground},
                        {"ink below", p.ink, p.ground_end},
                        {"ink on a card", p.ink, p.card},
                        {"soft", p.ink_soft, p.ground},
                        {"soft below", p.ink_soft, p.ground_end},
                        {"soft on a card", p.ink_soft, p.card},
                        {"main button", p.accent_ink, p.accent},
                        {"quiet button", p.link, p.quiet},
                        {"key", p.link, p.card},
                        {"good", p.good, p.ground},
                        {"good below", p.good, p.ground_end},
                        {"warn", p.warn, p.ground},
                        {"bad", p.bad, p.card},
                        {"good on a card", p.good, p.card},
                        {"chosen row", p.accent_ink, p.accent},
                        {"chosen row under a finger", p.accent_ink, pressed(p.accent)},
                        {"row under a finger", p.ink, pressed(p.card)},
                        {"quiet button under a finger", p.link, pressed(p.quiet)}};
  for (const Pair& pair : pairs)
    EXPECT_GE(contrast(pair.text, pair.ground), 4.5) << name << ": " << pair.what;
}

TEST(Theme, EveryTextCanBeRead) {
  every_text_can_be_read(kLight, "light");
  every_text_can_be_read(kDark, "dark");
  every_text_can_be_read(kHighContrast, "high contrast");
}

TEST(Theme, HighContrastIsHigher) {
  EXPECT_GE(contrast(kHighContrast.ink, kHighContrast.ground), 15);
  EXPECT_GE(contrast(kHighContrast.accent_ink, kHighContrast.accent), 12);
  // WCAG 2.2, 1.4.11: what shows a state has 3 : 1 to what is beside it.
  EXPECT_GE(contrast(kHighContrast.accent, kHighContrast.track), 3);
  EXPECT_GE(contrast(kHighContrast.track, kHighContrast.ground), 3);
}

}  // namespace
}  // namespace relievo::ui
