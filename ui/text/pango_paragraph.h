// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PangoParagraph: one paragraph at a time, set out by Pango: shaped, in the right order, broken into lines of
// even length, each as high as the page's script has it (theme.h). Pixels from the top left corner of the
// paragraph's box. Thread: the one that made it. It owns what it hands out, until the next set() or draw().
// Errors of check_fonts(): NotFound names the font package that is missing. Source: Unicode 15 UAX 9
// (direction) and UAX 14 (where lines may end), as Pango 1.50 has them.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "hal/base/result.h"
#include "ui/text/text_engine.h"

namespace relievo::ui {

struct SetText {
  float width_px = 0, height_px = 0;
  float left = 0, top = 0, right = 0, bottom = 0;  // of its ink
  int lines = 0;
  int missing = 0;  // letters no font has
  int torn = 0;     // words that end on one line and go on the next without a hyphen
};

struct GlyphCoverage {  // one byte a pixel, 255 where a letter covers it
  const unsigned char* pixels = nullptr;
  int stride = 0;
  const unsigned char* row(int y) const { return pixels + std::size_t(stride) * std::size_t(y); }
};

class PangoParagraph {
 public:
  PangoParagraph();
  ~PangoParagraph();
  PangoParagraph(const PangoParagraph&) = delete;
  PangoParagraph& operator=(const PangoParagraph&) = delete;

  Result<void> check_fonts();
  // No wider than `width` unless a single word is.
  const SetText& set(std::string_view text, const TextStyle& style, int width);
  // What was set, w x h pixels from (left, top) on.
  GlyphCoverage draw(int left, int top, int w, int h);
  // Nothing that was set stays in memory.
  void forget();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace relievo::ui
