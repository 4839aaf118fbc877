// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

// Whose device it is.
void host(Page& page) {
  if (page.view.consent == nullptr || page.view.consent->host.name.empty()) return;
  const Host& host = page.view.consent->host;
  constexpr float kSignHigh = 64, kMostAcross = 4;
  Node row = page.box(Flow::Row, space::kM);
  row.box.align = Align::Centre;
  page.tree.open(row);
  if (!host.sign.empty()) {
    const float aspect = std::min(
        kMostAcross, static_cast<float>(host.sign_width_px) / static_cast<float>(host.sign_height_px));
    Node card = page.box(Flow::Column, 0, 10, 10);
    card.box.fill = {255, 255, 255, 255};
    card.box.radius = page.px(14);
    page.tree.open(card);
    Node sign = page.sized(page.box(Flow::Column), kSignHigh * aspect, kSignHigh);
    sign.mark = Mark::Image;
    sign.picture = PictureSlot::Sign;
    sign.aspect = static_cast<float>(host.sign_width_px) / static_cast<float>(host.sign_height_px);
    page.tree.leaf(sign);
    page.tree.close();
  }
  page.tree.open(page.grown(page.box(Flow::Column)));
  Node name = page.text(page.filled("{}", host.name), type::kBody, Weight::Bold, page.palette.good);
  name.id = "host";
  page.tree.leaf(name);
  page.tree.close();
  page.tree.leaf(page.sized(page.box(Flow::Column), size::kTarget, 1));  // the staff's way in stands there
  page.tree.close();
}

void face(Page& page) {
  Node node = page.grown(page.box(Flow::Column), 1.0F);
  node.id = "invitation_head";
  node.name = page.tr("A simulated head, as this device measures one");
  node.role = Role::Picture;
  node.mark = Mark::Face;
  if (page.view.invitation_head == nullptr) node.mark = Mark::Shape;
  page.tree.leaf(node);
}

void tools(Page& page) {
  Node row = page.box(Flow::Row, space::kS);
  row.box.justify = Justify::End;
  page.tree.open(row);
  if ((page.view.languages & page.view.voices).any())
    page.square_button("speech", page.tr("Read aloud"), icon::kSpeaker, {ActionKind::Speech, 0},
                       page.visit.spoken ? page.tr("yes") : page.tr("no"));
  page.bigger_text();
  page.more_contrast();
  page.within_reach();
  page.privacy();
  page.square_button("help", page.tr("Help"), icon::kHelp, {ActionKind::ShowHelp, 0});
  page.tree.close();
}

// All languages are to be seen, each in its own letters; where large letters leave no room, behind one
// button.
void languages(Page& page) {
  const std::size_t count = page.visit.offered(page.view).count();
  if (count < 2) return;
  if (page.portrait || page.text_share < 1.2F || count <= 4) return language_grid(page, 4);
  page.button("language", page.tr("Language"), icon::kTranslate, ButtonLook::Quiet,
              {ActionKind::ShowLanguages, 0});
}

void words(Page& page) {
  Node column = page.box(Flow::Column, space::kM);
  column.box.grow = page.portrait ? 0 : 1.1F;
  column.box.justify = Justify::Centre;
  column.box.shrink = true;
  page.tree.open(column);
  const bool tight = !page.portrait && page.text_share > 1.3F;
  Node said = page.box(Flow::Column, space::kM);
  said.id = "said";
  said.box.scroll = said.box.shrink = true;
  page.tree.open(said);
  page.heading("title", page.tr("Your face in three dimensions"),
               tight                                     ? 38
               : page.portrait || page.text_share < 1.2F ? type::kDisplay
                                                         : 50);
  page.body(
      "what",
      page.tr(
          "Two cameras look at you for a moment; all of it takes about a minute. You see your 3D portrait first. Without your consent nothing is kept."));
  page.cameras();
  page.tree.close();
  page.tree.leaf(page.sized(page.box(Flow::Column), 1, 4));
  page.button("start", page.tr("Start"), page.onward(), ButtonLook::Main, {ActionKind::Start, 0});
  languages(page);
  if (page.portrait) tools(page);
  page.tree.close();
}

}  // namespace

void attract_screen(Page& page) {
  Node root = page.portrait ? page.box(Flow::Column, space::kL, 56, 56)
                            : page.sided(page.box(Flow::Row, space::kXl, 72, 32));
  root.id = "page";
  root.box.fill = page.palette.ground;
  root.box.fill_end = page.palette.ground_end;
  page.tree.open(root);
  if (page.portrait) host(page), face(page);
  words(page);
  if (!page.portrait) {
    page.tree.open(page.grown(page.box(Flow::Column, space::kM)));
    host(page);
    face(page);
    tools(page);
    page.tree.close();
  }
  page.tree.close();
  if (!page.visit.rests(page.view.now)) return;
  Node night = page.box(Flow::Column);
  night.box.fill = {0, 0, 0, 150};
  page.tree.leaf(night);
}

}  // namespace relievo::ui
