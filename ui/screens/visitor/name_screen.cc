// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

constexpr float kAsked = 38;  // the size of the question above the field

}  // namespace

void name_screen(Page& page) {
  const auto& tr = page.tr;
  page.begin(true);
  // Large letters leave no room above the keys: then question and answer stand side by side.
  const bool abreast = !page.portrait && page.text_share > 1.1F;
  if (abreast) {
    Node row = page.box(Flow::Row, space::kM);
    row.box.align = Align::Centre;
    page.tree.open(row);
  }
  const char* const asked = page.visit.quotes_code() ? tr("Type your code") : tr("Your name or your number");
  page.heading("title", asked, abreast ? type::kBody : kAsked);
  Node field = page.box(Flow::Row, 3, 26, 14);
  field.box.grow = abreast ? 1.0F : 0.0F;
  field.id = "name";
  field.role = Role::Field;
  field.name = asked;
  field.value = page.visit.name();
  field.secret = true;
  field.box.min_height = page.px(72);
  field.box.align = Align::Centre;
  field.box.fill = page.palette.card;
  field.box.border = page.palette.accent;
  field.box.border_px = page.px(3);
  field.box.radius = page.px(size::kRadius);
  page.tree.open(field);
  const std::string_view name = page.visit.name();
  Node typed =
      page.text(name.empty() ? std::string_view(tr("Type here or show a QR code")) : name, type::kButton,
                Weight::Medium, name.empty() ? page.palette.ink_soft : page.palette.ink);
  typed.id = "typed";
  if (!name.empty()) page.tree.leaf(typed);
  Node caret = page.sized(page.box(Flow::Column), 3, 36);
  caret.box.fill = page.palette.accent;
  page.tree.leaf(caret);
  if (name.empty()) page.tree.leaf(typed);
  page.tree.close();
  if (abreast) page.tree.close();
  if (page.view.known == Known::NoSuchCode && !name.empty()) {  // below the field, which stays where it is
    Node note = page.text(tr("No record has this code. Please check it, or ask the staff."), type::kSmall,
                          Weight::Bold, page.palette.bad);
    note.id = "wrong_code";
    note.role = Role::Alert;
    page.tree.leaf(note);
  }
  if (page.portrait) page.space(1);
  keyboard(page);
  page.end();
}

}  // namespace relievo::ui
