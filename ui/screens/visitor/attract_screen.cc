// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

void face(Page& page) {
  Node node = page.grown(page.box(Flow::Column), 1.0F);
  node.id = "showpiece";
  node.name = page.tr("A simulated head, as this device measures one");
  node.role = Role::Picture;
  node.mark = Mark::Face;
  if (page.view.showpiece == nullptr) node.mark = Mark::Shape;
  page.tree.leaf(node);
}

void language_row(Page& page) {
  page.tree.open(page.box(Flow::Row, space::kS));
  for (std::size_t i = 0; i < kLanguages; ++i) {
    const auto language = static_cast<Language>(i);
    if (language == page.visit.language) continue;
    page.button(info_of(language).code, info_of(language).own_name, nullptr, ButtonLook::Quiet, {ActionKind::ChooseLanguage, static_cast<int>(i)}, 1);
  }
  page.square_button("bigger", page.tr("Bigger text"), icon::kText, {ActionKind::BiggerText, 0});
  page.square_button("help", page.tr("Help"), icon::kHelp, {ActionKind::ShowHelp, 0});
  page.tree.close();
}

void words(Page& page) {
  Node column = page.box(Flow::Column, space::kM);
  column.box.grow = page.portrait ? 0 : 1.1F;
  column.box.along = Along::Centre;
  page.tree.open(column);
  const bool tight = !page.portrait && page.text_share > 1.3F;
  if (!tight) page.tree.leaf(page.text(page.tr("3D portrait"), type::kSmall, Weight::Bold, page.palette.good));
  page.heading("title", page.tr("Your face in three dimensions"), tight ? 38 : page.portrait || page.text_share < 1.2F ? type::kDisplay : 50);
  page.body("what", page.tr("Two cameras look at you for a moment. You see your 3D portrait, and you decide whether it is kept."));
  page.tree.leaf(page.sized(page.box(Flow::Column), 1, 4));
  page.button("start", page.tr("Start"), page.onward(), ButtonLook::Main, {ActionKind::Start, 0});
  language_row(page);
  page.tree.close();
}

}  // namespace

void attract_screen(Page& page) {
  Node root = page.portrait ? page.box(Flow::Column, space::kL, 56, 56) : page.box(Flow::Row, space::kXl, 72, 32);
  root.id = "page";
  root.box.fill = page.palette.ground;
  root.box.fill_end = page.palette.ground_end;
  page.tree.open(root);
  if (page.portrait) face(page);
  words(page);
  if (!page.portrait) face(page);
  page.tree.close();
}

}  // namespace relievo::ui
