// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// WipedText: a name or a code that leaves no copy of itself in memory when it goes or is replaced. It is
// never moved, only copied: a moved short string stays where it was. Thread: one at a time. Throws
// std::bad_alloc. ShortWipedText: the same of at most N bytes, in place, so that no copy of it can fail.
#pragma once

#include <string.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace relievo {

// wipe_stack(): what the functions that have returned left on this thread's stack goes: names and rows of
// pictures lie there until something else is called as deeply. Thread: any, for its own.
[[gnu::noinline]] inline void wipe_stack() {
  // Deeper than what was seen to be left. NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
  std::array<std::byte, std::size_t{256} << 10> below;
  explicit_bzero(below.data(), below.size());
}

class WipedText {
 public:
  WipedText() = default;
  explicit WipedText(std::string_view text) : text_(text) {}
  WipedText(const WipedText&) = default;
  WipedText& operator=(const WipedText& other) {
    if (this != &other) *this = other.view();
    return *this;
  }
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

template <std::size_t N>
class ShortWipedText {
 public:
  ShortWipedText() = default;
  ShortWipedText(const ShortWipedText&) = default;
  ShortWipedText& operator=(const ShortWipedText&) = default;
  // What is longer than N is cut.
  ShortWipedText& operator=(std::string_view text) {
    wipe();
    length_ = text.copy(bytes_.data(), N);
    return *this;
  }
  ~ShortWipedText() { wipe(); }

  // More of it; false, and nothing, where there is no room.
  bool add(std::string_view text) {
    if (length_ + text.size() > N) return false;
    length_ += text.copy(bytes_.data() + length_, N);
    return true;
  }
  // Nothing from there on.
  void cut(std::size_t at) {
    explicit_bzero(bytes_.data() + at, length_ - at);
    length_ = at;
  }

  std::string_view view() const { return {bytes_.data(), length_}; }
  bool empty() const { return length_ == 0; }
  void wipe() {
    explicit_bzero(bytes_.data(), N);
    length_ = 0;
  }

 private:
  std::array<char, N> bytes_{};
  std::size_t length_ = 0;
};

}  // namespace relievo
