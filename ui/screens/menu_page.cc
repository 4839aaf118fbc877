// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pages a role may open, as tiles. It is made from kStaffPages: a new page appears by its row.
#include "ui/screens/staff_screens.h"

namespace relievo::ui {
namespace {

void tile(StaffFrame& page, const StaffPageInfo& info) {
  Node node = page.grown(page.box(Flow::Column, space::kS, page.portrait ? 6 : 12, 16));
  const char* title = page.tr(info.title);
  node.id = info.id;
  node.name = title;
  node.role = Role::Button;
  node.action = {ActionKind::StaffOpen, static_cast<int>(info.page)};
  node.box.justify = Justify::Centre;
  node.box.align = Align::Centre;
  node.box.min_height = page.px(148);
  node.box.fill = page.palette.card;
  node.box.border = page.palette.card_border;
  node.box.border_px = page.px(2);
  node.box.radius = page.px(size::kCardRadius);
  page.tree.open(node);
  page.sign(info.letter, 44 / page.text_share, page.palette.accent);
  page.tree.leaf(page.text(title, 22, Weight::Medium, page.palette.ink, TextAlign::Centre));
  page.tree.close();
}

}  // namespace

void menu_page(StaffFrame& page) {
  page.begin(page.staff.role == StaffRole::Operator ? page.tr("Operator") : page.tr("Technician"), nullptr);
  Node list = page.grown(page.box(Flow::Column, space::kM));
  list.id = "menu";
  list.box.scroll = true;
  list.box.row_stretch = page.portrait ? 1.35F : 1;
  page.tree.open(list);
  // Where letters are large, a long word must not be torn: fewer and wider tiles.
  const bool large = page.text_share > 1.2F;
  const int across = page.portrait ? large ? 2 : 3 : page.text_share > 1.3F ? 3 : 4;
  int column = 0;
  for (const StaffPageInfo& info : staff_pages()) {
    if (!may_open(page.staff.role, info)) continue;
    if (info.page == StaffPage::Recovery && !page.staff.access.words_due) continue;  // shown once
    if (column == 0) page.tree.open(page.box(Flow::Row, space::kM));
    tile(page, info);
    column = (column + 1) % across;
    if (column == 0) page.tree.close();
  }
  if (column != 0) {
    for (; column < across; ++column) page.space(1);
    page.tree.close();
  }
  page.tree.close();
  page.end();
}

}  // namespace relievo::ui
