// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/speech/utterance.h"

#include <algorithm>
#include <functional>
#include <initializer_list>

namespace relievo::ui {
namespace {

bool is_one_of(std::string_view letter, std::initializer_list<std::string_view> letters) {
  return std::ranges::find(letters, letter) != letters.end();
}

bool steers_the_eye(std::string_view letter) {
  return is_one_of(letter, {"\u00ad", "\u200e", "\u200f", "\u2066", "\u2067", "\u2068", "\u2069"});
}

std::string_view as_spoken(std::string_view letter) {
  if (steers_the_eye(letter)) return {};
  if (is_one_of(letter, {"\u00a0", "\u202f"})) return " ";
  return letter == "\u2011" ? "-" : letter;
}

std::size_t length_of_letter(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

bool ends_a_sentence(std::string_view text) {
  constexpr std::string_view kEnds[] = {".", "!", "?", ":", "。", "！", "？", "：", "؟"};
  return std::ranges::any_of(kEnds, [text](std::string_view end) { return text.ends_with(end); });
}

// Said when it has the focus.
bool is_touched(const Node& node) { return node.role == Role::Button || node.role == Role::Key; }

void say_children(const Tree& tree, const Node& node, const Listener& to, Utterance& said) {
  for (std::int32_t i = node.first_child; i >= 0; i = tree.nodes()[static_cast<std::size_t>(i)].next) {
    const Node& child = tree.nodes()[static_cast<std::size_t>(i)];
    if (!is_touched(child)) say_node(tree, child, to, said);
  }
}

}  // namespace

void Utterance::add(std::string_view letters) {
  if (size_ + letters.size() > text_.size()) return;
  size_ += letters.copy(text_.data() + size_, letters.size());
}

void Utterance::say(std::string_view words) {
  if (words.empty() || text().substr(last_) == words) return;
  if (!empty()) add(ends_a_sentence(text()) ? " " : ". ");
  last_ = size_;
  for (std::size_t at = 0; at < words.size();) {
    const std::string_view letter = words.substr(at, length_of_letter(words[at]));
    add(as_spoken(letter));
    at += letter.size();
  }
}

std::size_t print_of(std::string_view text) { return std::hash<std::string_view>{}(text); }

void say_node(const Tree& tree, const Node& node, const Listener& to, Utterance& said) {
  if (node.role == Role::Icon) return;
  const bool types = node.action.kind == ActionKind::TypeKey, told = to.alone || !(node.secret || types);
  const auto own = [&](std::string_view words) {
    if (!words.empty()) said.say(told ? words : to.tr("Only said into headphones"));
  };
  if (node.name.empty() || types) own(node.name.empty() ? node.text : node.name);
  else said.say(node.name);
  own(node.value);
  if (node.name.empty() && node.text.empty()) say_children(tree, node, to, said);
}

void say_page(const Tree& tree, const Listener& to, Utterance& said) { say_node(tree, tree.top(), to, said); }

void say_focus(const Tree& tree, const Node& node, const Listener& to, Utterance& said) {
  say_node(tree, node, to, said);
  // A button with words of its own is a language, named in itself.
  if (node.role == Role::Button && node.text.empty()) said.say(to.tr("Button"));
}

}  // namespace relievo::ui
