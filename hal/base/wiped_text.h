// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// WipedText: a name or a code that leaves no copy of itself in memory when it goes or is replaced. It is
// never moved, only copied: a moved short string stays where it was. Thread: one at a time. Throws
// std::bad_alloc.
#pragma once

#include <string.h>

#include <string>
#include <string_view>

namespace relievo {

class WipedText {
 public:
  WipedText() = default;
  explicit WipedText(std::string_view text) : text_(text) {}
  WipedText(const WipedText&) = default;
  WipedText& operator=(const WipedText& other) { return *this = other.view(); }
  WipedText& operator=(std::string_view text) {
    std::string held(text);  // it may be a part of this one
    wipe();
    text_ = held;
    explicit_bzero(held.data(), held.size());
    return *this;
  }
  ~WipedText() { wipe(); }

  std::string_view view() const { return text_; }
  bool empty() const { return text_.empty(); }
  void wipe() {
    explicit_bzero(text_.data(), text_.size());
    text_.clear();
  }

 private:
  std::string text_;
};

}  // namespace relievo
