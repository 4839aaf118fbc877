// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The look of every screen, in one place: one type scale, one spacing scale, three palettes.
// Lengths in dp: at 1280 x 800 one dp is one pixel; a screen twice as large has two.
// Contrast: every text colour on its ground has 4.5 : 1 or more (tests/ui/theme_test.cc).
#pragma once

#include "ui/draw/draw_list.h"

namespace relievo::ui {

namespace type {  // sizes of text
inline constexpr float kDisplay = 64, kTitle = 46, kHeading = 30, kButton = 28, kBody = 24, kSmall = 20;

// Lines of text, in sizes of it: how far the first reaches above its baseline and the last below, and how far
// baselines are apart: headings need less than what is read. The middle of a line is that of its capitals, in
// every script.
struct Lines {
  float above, below, apart, apart_bold;
};
inline constexpr Lines kLines{0.969F, 0.242F, 1.33F, 1.14F}, kArabicLines{1.06F, 0.34F, 1.58F, 1.46F},
    kHanLines{0.969F, 0.242F, 1.46F, 1.25F};
}  // namespace type

namespace space {
inline constexpr float kXs = 8, kS = 12, kM = 20, kL = 32, kXl = 48;
}  // namespace space

namespace size {
inline constexpr float kTarget = 80;      // height of a visitor's button: 72 is the least
inline constexpr float kBigTarget = 104;  // of the one that leads on
inline constexpr float kKeyLeast = 72;
inline constexpr float kRadius = 24, kCardRadius = 28, kPillRadius = 40;
inline constexpr float kFocusRing = 4;
}  // namespace size

struct Palette {
  Colour ground, ground_end;  // of the page, from top to bottom
  Colour card, card_border;
  Colour ink, ink_soft;        // text, and quieter text
  Colour accent, accent_ink;   // the button that leads on, and what is written on it
  Colour quiet, quiet_border;  // the other buttons
  Colour link;                 // what is written on them
  Colour good, warn, bad;      // never without a word or a sign beside it
  Colour stage;                // behind pictures and models
  Colour focus;
  Colour veil;   // over the page, under a question
  Colour track;  // where a bar, a dot or a field is not filled with the accent yet
};

inline constexpr Palette kLight{{243, 246, 251, 255}, {233, 238, 247, 255}, {255, 255, 255, 255},
                                {208, 215, 229, 255}, {15, 26, 46, 255},    {70, 84, 108, 255},
                                {0, 98, 177, 255},    {255, 255, 255, 255}, {255, 255, 255, 255},
                                {208, 215, 229, 255}, {0, 94, 170, 255},    {11, 112, 80, 255},
                                {138, 82, 0, 255},    {176, 24, 40, 255},   {27, 37, 52, 255},
                                {255, 149, 0, 255},   {8, 14, 26, 170},     {208, 215, 229, 255}};

inline constexpr Palette kDark{{10, 20, 36, 255},    {21, 43, 78, 255},    {24, 36, 56, 255},
                               {66, 84, 112, 255},   {255, 255, 255, 255}, {199, 210, 228, 255},
                               {0, 98, 177, 255},    {255, 255, 255, 255}, {46, 62, 92, 255},
                               {128, 142, 168, 255}, {255, 255, 255, 255}, {45, 212, 176, 255},
                               {255, 196, 84, 255},  {255, 138, 138, 255}, {18, 26, 40, 255},
                               {255, 190, 60, 255},  {4, 8, 16, 190},      {128, 142, 168, 255}};

inline constexpr Palette kHighContrast{
    {0, 0, 0, 255},       {0, 0, 0, 255},      {0, 0, 0, 255},     {255, 255, 255, 255}, {255, 255, 255, 255},
    {255, 255, 255, 255}, {255, 221, 0, 255},  {0, 0, 0, 255},     {0, 0, 0, 255},       {255, 255, 255, 255},
    {255, 221, 0, 255},   {95, 255, 170, 255}, {255, 221, 0, 255}, {255, 160, 160, 255}, {0, 0, 0, 255},
    {0, 224, 255, 255},   {0, 0, 0, 225},      {96, 96, 96, 255}};

// A box while a finger is on it.
constexpr Colour pressed(Colour fill) {
  const auto darker = [](std::uint8_t v) { return std::uint8_t(v * 21 / 25); };
  return {darker(fill.r), darker(fill.g), darker(fill.b), fill.a};
}

}  // namespace relievo::ui
