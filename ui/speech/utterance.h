// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What nodes say: the words of a page in reading order, of one node, of a button that has the focus. Pure
// functions of the tree. What is a person's own (Node::secret) is told to headphones alone; a loudspeaker
// says that there is something. Thread: main. Errors: none: what does not fit is not said.
#pragma once

#include <string.h>

#include <array>
#include <cstddef>
#include <string_view>

#include "ui/language/language.h"
#include "ui/tree/tree.h"

namespace relievo::ui {

// Sentences to be spoken, UTF-8 without what only steers the eye (isolates, soft hyphens). In memory of its
// own that is wiped.
class Utterance {
 public:
  Utterance() = default;
  Utterance(const Utterance&) = delete;
  Utterance& operator=(const Utterance&) = delete;
  ~Utterance() { clear(); }

  void clear() {
    explicit_bzero(text_.data(), size_);
    size_ = last_ = 0;
  }
  // As a sentence of its own, where there are any; not the same one twice.
  void say(std::string_view words);
  std::string_view text() const { return {text_.data(), size_}; }
  bool empty() const { return size_ == 0; }
  std::string_view language;  // BCP 47

 private:
  void add(std::string_view letters);
  static constexpr std::size_t kMost = 24 * 1024;  // an operator's consent text has 20,000 bytes
  std::array<char, kMost> text_{};
  std::size_t size_ = 0, last_ = 0;  // last_: where the last sentence begins
};

struct Listener {
  Words tr{Language::English};
  bool alone = false;  // with headphones
};

// All that the page says of itself, or what lies over it: not its buttons.
void say_page(const Tree& tree, const Listener& to, Utterance& said);
// One node: its name and value, or the words in it.
void say_node(const Tree& tree, const Node& node, const Listener& to, Utterance& said);
// The node that has the focus; a button says that it is one.
void say_focus(const Tree& tree, const Node& node, const Listener& to, Utterance& said);

// Of a text, as far as it matters whether it was said already.
std::size_t print_of(std::string_view text);

}  // namespace relievo::ui
