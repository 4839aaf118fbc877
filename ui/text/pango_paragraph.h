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
#include <span>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "ui/text/text_engine.h"

namespace relievo::ui {

struct GlyphCoverage {  // one byte a pixel, 255 where a letter covers it
  const unsigned char* pixels = nullptr;
  int stride = 0;
  const unsigned char* row(int y) const { return pixels + std::size_t(stride) * std::size_t(y); }
};

class PangoParagraph {
 public:
  static std::unique_ptr<PangoParagraph> make();
  virtual ~PangoParagraph() = default;

  virtual Result<void> check_fonts() = 0;
  // No wider than `width` unless a single word is. In no atlas yet.
  virtual const TextLabel& set(std::string_view text, const TextStyle& style, int width) = 0;
  // What was set, w x h pixels from (left, top) on.
  virtual GlyphCoverage draw(int left, int top, int w, int h) = 0;
  // Nothing that was set stays in memory.
  virtual void forget() = 0;
};

// Phrases of a text in Chinese or Japanese, which are written without spaces and may be broken between
// any two letters: a heading torn inside a word ("撮影しま|す") reads badly all the same.
// Chinese: a phrase ends at a punctuation mark. Japanese: there too, and where letters of hiragana
// (endings, particles) are followed by the next word in kanji, katakana, Latin letters or digits; the
// prefixes お and ご and the words もう, 何も and あと belong to what follows, the parts of a verb (撮り直す)
// stay together. UTF-8, as a catalogue holds it. Bytes. Thread: any. Errors: none; where no phrase is seen,
// the whole text is one. Paper: JIS X 4051:2004 says where a line must not break; the phrase is the bunsetsu
// of Hashimoto (1934).

// The bytes at which the phrases after the first begin, in order.
std::vector<std::size_t> phrase_starts(std::string_view text, bool japanese);

// The same of sentences in a script that is written with spaces: behind ". ", "! ", "? " and the Arabic
// question mark.
std::vector<std::size_t> sentence_starts(std::string_view text);

// Phrases as wide as `widths`, on as few lines no wider than `width` as they need: the numbers of those with
// which the lines after the first begin. Evened, the widest line is as narrow as that many lines allow;
// otherwise each is full. A phrase that is wider than `width` has a line of its own.
std::vector<std::size_t> fill_lines(std::span<const float> widths, float width, bool evened);

}  // namespace relievo::ui
