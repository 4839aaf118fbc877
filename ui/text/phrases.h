// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Phrases of a text in Chinese or Japanese, which are written without spaces and may be broken between
// any two letters: a heading torn inside a word ("撮影しま|す") reads badly all the same.
// Chinese: a phrase ends at a punctuation mark. Japanese: there too, and where letters of hiragana
// (endings, particles) are followed by the next word in kanji, katakana, Latin letters or digits; the
// prefixes お and ご and the words もう, 何も and あと belong to what follows, the parts of a verb (撮り直す)
// stay together. UTF-8, as a catalogue holds it. Bytes. Thread: any. Errors: none; where no phrase is seen,
// the whole text is one. Paper: JIS X 4051:2004 says where a line must not break; the phrase is the bunsetsu
// of Hashimoto (1934).
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace relievo::ui {

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
