// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keyboard on the screen: the letters of the language, as its speakers know them from their own.
#include <array>
#include <span>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

using Row = std::span<const char* const>;
using Rows = std::array<Row, 3>;

constexpr const char* kDigits[] = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "0"};
constexpr const char* kEn1[] = {"q", "w", "e", "r", "t", "y", "u", "i", "o", "p"};
constexpr const char* kEn2[] = {"a", "s", "d", "f", "g", "h", "j", "k", "l", "-"};
constexpr const char* kEn3[] = {"z", "x", "c", "v", "b", "n", "m", "'", "."};
constexpr const char* kEn1Big[] = {"Q", "W", "E", "R", "T", "Y", "U", "I", "O", "P"};
constexpr const char* kEn2Big[] = {"A", "S", "D", "F", "G", "H", "J", "K", "L", "-"};
constexpr const char* kEn3Big[] = {"Z", "X", "C", "V", "B", "N", "M", "'", "."};
constexpr const char* kDe1[] = {"q", "w", "e", "r", "t", "z", "u", "i", "o", "p", "ü"};
constexpr const char* kDe2[] = {"a", "s", "d", "f", "g", "h", "j", "k", "l", "ö", "ä"};
constexpr const char* kDe3[] = {"y", "x", "c", "v", "b", "n", "m", "ß", "-"};
constexpr const char* kDe1Big[] = {"Q", "W", "E", "R", "T", "Z", "U", "I", "O", "P", "Ü"};
constexpr const char* kDe2Big[] = {"A", "S", "D", "F", "G", "H", "J", "K", "L", "Ö", "Ä"};
constexpr const char* kDe3Big[] = {"Y", "X", "C", "V", "B", "N", "M", "ẞ", "-"};
constexpr const char* kAr1[] = {"ض", "ص", "ث", "ق", "ف", "غ", "ع", "ه", "خ", "ح", "ج", "د"};
constexpr const char* kAr2[] = {"ش", "س", "ي", "ب", "ل", "ا", "ت", "ن", "م", "ك", "ط", "ذ"};
constexpr const char* kAr3[] = {"ئ", "ء", "ؤ", "ر", "ى", "ة", "و", "ز", "ظ", "أ", "إ"};

Rows rows_of(Language language, bool capitals) {
  switch (language) {
    case Language::German: return capitals ? Rows{kDe1Big, kDe2Big, kDe3Big} : Rows{kDe1, kDe2, kDe3};
    case Language::Arabic: return {kAr1, kAr2, kAr3};
    case Language::English:
    case Language::Count: break;
  }
  return capitals ? Rows{kEn1Big, kEn2Big, kEn3Big} : Rows{kEn1, kEn2, kEn3};
}

void key(Page& page, std::string_view id, std::string_view letter, const char* spoken, bool sign, Action action, float grow = 1) {
  Node node = page.text(letter, type::kButton, Weight::Medium, page.palette.link, TextAlign::Centre);
  // Twelve letters abreast have no room to grow on an upright screen.
  const float growth = page.portrait ? 0.15F : 0.6F;
  node.style.size_px = page.px(type::kButton * (1 + (page.text_share - 1) * growth));
  node.style.icon = sign;
  node.id = id;
  if (spoken != nullptr) node.name = spoken;
  node.role = Role::Key;
  node.action = action;
  node.box.grow = grow;
  node.box.min_height = page.px(page.portrait ? size::kTarget : size::kKeyLeast);
  node.box.fill = page.palette.card;
  node.box.border = page.palette.card_border;
  node.box.border_px = page.px(1.5F);
  node.box.radius = page.px(16);
  page.tree.leaf(node);
}

void letters(Page& page, Row row) {
  for (const char* letter : row) {
    const std::string_view id = page.tree.keep("key ");
    const std::string_view rest = page.tree.keep(letter);
    key(page, {id.data(), id.size() + rest.size()}, letter, nullptr, false, {ActionKind::TypeKey, 0});
  }
}

Node row_box(Page& page) {
  Node row = page.box(Flow::Row, 8);
  row.box.left_to_right = page.visit.language != Language::Arabic;
  return row;
}

void last_row(Page& page) {
  page.tree.open(page.box(Flow::Row, 10));
  key(page, "space", page.tr("Space"), nullptr, false, {ActionKind::TypeKey, ' '}, 2);
  page.button("done", page.tr("Done"), icon::kGood, ButtonLook::Main, page.visit.name().empty() ? Action{} : Action{ActionKind::Done, 0}, page.portrait ? 1.5F : 1.0F);
  page.tree.close();
}

}  // namespace

void keyboard(Page& page) {
  Node board = page.grown(page.box(Flow::Column, 8), page.portrait ? 0.0F : 1.0F);
  board.id = "keyboard";
  board.box.along = Along::End;
  page.tree.open(board);
  Node digits = row_box(page);
  digits.box.left_to_right = true;
  page.tree.open(digits);
  letters(page, kDigits);
  page.tree.close();
  const Rows rows = rows_of(page.visit.language, page.visit.capitals);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    page.tree.open(row_box(page));
    const bool last = i == rows.size() - 1;
    if (last && page.visit.language != Language::Arabic) key(page, "shift", icon::kShift, page.tr("Capital letters"), true, {ActionKind::Shift, 0});
    letters(page, rows[i]);
    if (last) key(page, "erase", icon::kErase, page.tr("Erase"), true, {ActionKind::Erase, 0});
    page.tree.close();
  }
  last_row(page);
  page.tree.close();
}

}  // namespace relievo::ui
