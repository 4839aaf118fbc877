// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The letters of the language, as its speakers know them from their own.
#include "ui/screens/parts/keyboard.h"

#include "ui/screens/parts/keyboard_layouts.h"

namespace relievo::ui {
namespace {

constexpr const char* kDigits[] = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "0"};

void key(Page& page, std::string_view id, std::string_view letter, const char* spoken, bool sign,
         Action action, float grow = 1, bool mirrored = false) {
  Node node = page.text(letter, type::kButton, Weight::Medium, page.palette.link, TextAlign::Centre);
  // Twelve letters abreast have no room to grow on an upright screen.
  const float growth = page.portrait ? 0.15F : 0.6F;
  node.style.size_px = page.px(type::kButton * (1 + (page.text_share - 1) * growth));
  node.style.icon = sign;
  node.mirrored = mirrored;
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

void letters(Page& page, KeyRow row) {
  for (const char* letter : row) {
    const std::string_view id = page.tree.keep("key ");
    const std::string_view rest = page.tree.keep(letter);
    key(page, {id.data(), id.size() + rest.size()}, letter, nullptr, false, {ActionKind::TypeKey, 0});
  }
}

Node row_box(Page& page) {
  Node row = page.box(Flow::Row, 8);
  row.box.left_to_right = true;  // keys lie as on a desk, also where the words run to the left
  return row;
}

void last_row(Page& page, Action done) {
  page.tree.open(page.box(Flow::Row, 10));
  if (has_capitals(page.visit.language)) {
    const char* sign = page.visit.accents ? "abc" : page.visit.capitals ? "ÁÑß" : "áñß";
    key(page, "accents", sign, page.tr("Letters with accents"), false, {ActionKind::Accents, 0}, 0.6F);
  }
  key(page, "space", page.tr("Space"), nullptr, false, {ActionKind::TypeKey, ' '}, 2);
  page.button("done", page.tr("Done"), icon::kGood, ButtonLook::Main,
              done.kind == ActionKind::Done && page.visit.name().empty() ? Action{} : done,
              page.portrait ? 1.5F : 1.0F);
  page.tree.close();
}

}  // namespace

void keyboard(Page& page, Action done) {
  Node board = page.grown(page.box(Flow::Column, 8), page.portrait ? 0.0F : 1.0F);
  board.id = "keyboard";
  board.box.justify = Justify::End;
  page.tree.open(board);
  page.tree.open(row_box(page));
  letters(page, kDigits);
  page.tree.close();
  const bool cased = has_capitals(page.visit.language);
  const KeyRows rows = page.visit.accents && cased ? accent_rows(page.visit.capitals)
                                                   : key_rows(page.visit.language, page.visit.capitals);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    page.tree.open(row_box(page));
    const bool last = i == rows.size() - 1;
    if (last && cased)
      key(page, "shift", icon::kShift, page.tr("Capital letters"), true, {ActionKind::Shift, 0});
    letters(page, rows[i]);
    // Its arrow points to where letters go: the last one of a word that runs to the left is erased to the
    // right.
    if (last)
      key(page, "erase", icon::kErase, page.tr("Erase"), true, {ActionKind::Erase, 0}, 1, page.mirrored());
    page.tree.close();
  }
  last_row(page, done);
  page.tree.close();
}

}  // namespace relievo::ui
