// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Somebody with this name, or the record of this code, is there already. To a name nothing is said but
// that; renew and add are for who quotes the code.
#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

// One of two ways on: what it is called, what it means.
void way(Page& page, std::string_view id, const char* label, const char* letter, const char* words,
         Action action) {
  page.tree.open(page.grown(page.box(Flow::Column, space::kS)));
  page.button(id, label, letter, ButtonLook::Main, action);
  page.tree.leaf(page.text(words, 22, Weight::Regular, page.palette.ink_soft, TextAlign::Centre));
  page.tree.close();
}

void two_ways(Page& page) {
  const auto& tr = page.tr;
  page.tree.open(page.box(page.portrait || page.text_share > 1.3F ? Flow::Column : Flow::Row,
                          page.portrait ? space::kL : space::kM));
  way(page, "renew", tr("Renew it"), icon::kAgain,
      tr("The old portrait is erased the moment the new one is stored."), {ActionKind::Renew, 0});
  way(page, "add", tr("Add another one"), icon::kShape, tr("The old portrait is kept beside the new one."),
      {ActionKind::AddAnother, 0});
  page.tree.close();
}

void name_ways(Page& page) {
  const auto& tr = page.tr;
  page.tree.open(page.box(page.portrait || page.text_share > 1.3F ? Flow::Column : Flow::Row, space::kM));
  const float grow = page.portrait || page.text_share > 1.3F ? 0.0F : 1.0F;
  page.button("somebody_else", tr("I am somebody else"), icon::kPerson, ButtonLook::Quiet,
              {ActionKind::SomebodyElse, 0}, grow);
  page.button("have_code", tr("I have my code"), icon::kLock, ButtonLook::Main, {ActionKind::HaveCode, 0},
              grow);
  page.tree.close();
  page.button("lost_code", tr("I lost my code"), icon::kHelp, ButtonLook::Plain, {ActionKind::LostCode, 0});
}

}  // namespace

void known_screen(Page& page) {
  const auto& tr = page.tr;
  const bool proven = page.view.known == Known::Code;
  page.begin(true);
  Node middle = page.grown(page.box(Flow::Column, space::kM));
  middle.id = "known";
  middle.box.justify = Justify::Centre;
  middle.box.scroll = true;
  page.tree.open(middle);
  page.heading("title", proven ? tr("Welcome back") : tr("This name is in our records"));
  page.body(
      "what",
      proven
          ? tr("You already have a portrait here. What would you like to do?")
          : tr("Is that you? With the code you were given you can renew your portrait or add another one. Without it nothing from the record is shown."));
  page.tree.leaf(page.sized(page.box(Flow::Column), 1, 8));
  if (proven) two_ways(page);
  else name_ways(page);
  page.tree.close();
  page.end();
}

}  // namespace relievo::ui
