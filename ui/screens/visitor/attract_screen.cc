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
  const auto in_row = page.tree.inside(page.row_box(space::kM));
  if (!host.sign.empty()) {
    const float aspect = aspect_of(host.sign_view());
    const auto in_card =
        page.tree.inside(page.painted(page.box(Flow::Column, 0, 10, 10), {255, 255, 255, 255}, 14));
    Node sign = page.sized(page.box(Flow::Column), kSignHigh * std::min(kMostAcross, aspect), kSignHigh);
    depict(sign, PictureSlot::Sign, aspect);
    page.tree.leaf(sign);
  }
  Node name = page.text(page.filled("{}", host.name), type::kBody, Weight::Bold, page.palette.good);
  name.id = "host";
  page.wide(name);
  page.tree.leaf(page.sized(page.box(Flow::Column), size::kTarget, 1));  // the staff's way in stands there
}

void face(Page& page) {
  Node node = page.grown(page.box(Flow::Column), 1.0F);
  tell(node, Role::Picture, "invitation_head", page.tr("A simulated head, as this device measures one"));
  node.mark = page.view.invitation_head == nullptr ? Mark::Shape : Mark::Face;
  page.tree.leaf(node);
}

void tools(Page& page) {
  Node row = page.box(Flow::Row, space::kS);
  if (page.portrait) row = page.sided(row);  // elsewhere with the whole page
  row.box.justify = Justify::End;
  const auto in_row = page.tree.inside(row);
  if ((page.view.languages & page.view.voices).any())
    page.square_button("speech", page.tr("Read aloud"), icon::kSpeaker, ActionKind::Speech,
                       page.visit.spoken ? page.tr("yes") : page.tr("no"));
  page.bigger_text();
  page.more_contrast();
  page.within_reach();
  page.privacy();
  page.square_button("help", page.tr("Help"), icon::kHelp, ActionKind::ShowHelp);
}

// All languages are to be seen, each in its own letters; where large letters leave no room, behind one
// button.
void languages(Page& page) {
  const std::size_t count = page.visit.offered(page.view).count();
  if (count < 2) return;
  if (page.portrait || page.text_share < 1.2F || count <= 4) return language_grid(page, 4);
  page.button("language", page.tr("Language"), icon::kTranslate, ButtonLook::Quiet,
              ActionKind::ShowLanguages);
}

// Beside the head, where large words would have to be scrolled to come to it.
bool tight(const Page& page) { return !page.portrait && page.text_share > 1.3F; }

void words(Page& page) {
  Node column = justified(page.box(Flow::Column, space::kM), Justify::Centre);
  column.box.grow = page.portrait ? 0 : 1.1F;
  column.box.shrink = true;
  const auto in_column = page.tree.inside(column);
  page.tree.open(shrinking(scroller("said", page.box(Flow::Column, space::kM))));
  page.heading("title", page.tr("Your face in three dimensions"),
               tight(page)                               ? 38
               : page.portrait || page.text_share < 1.2F ? type::kDisplay
                                                         : 50);
  page.body(
      "what",
      page.tr(
          "Two cameras look at you for a moment; all of it takes about a minute. You see your 3D portrait first. Without your consent nothing is kept."));
  if (!tight(page)) page.cameras();
  page.tree.close();
  page.tree.leaf(page.sized(page.box(Flow::Column), 1, 4));
  page.button("start", page.tr("Start"), page.onward(), ButtonLook::Main, ActionKind::Start);
  languages(page);
  if (page.portrait) tools(page);
}

constexpr float kBadge = 76;

bool side_by_side(const Page& page) { return !page.portrait && page.text_share < 1.3F; }

void badge(Page& page, const char* letter) {
  const Node box = justified(page.sized(page.box(Flow::Column), kBadge, kBadge), Justify::Centre);
  const auto in_box = page.tree.inside(page.painted(box, page.palette.accent.with_alpha(0.12F), kBadge / 4));
  page.sign(letter, kBadge / 2 / page.text_share, page.palette.link);
}

void point(Page& page, const char* letter, std::string_view title, std::string_view words) {
  Node row = page.box(Flow::Row, space::kM, 22, side_by_side(page) ? 26 : 18);
  row.box.align = side_by_side(page) ? Align::Start : Align::Centre;  // titles of neighbours on one line
  page.card(row, size::kRadius);
  row.box.grow = 1;
  const auto in_row = page.tree.inside(row);
  if (letter != nullptr) badge(page, letter);
  const auto in_column = page.tree.inside(page.grown(page.box(Flow::Column, 4)));
  page.write(title, type::kBody, Weight::Bold, page.palette.ink);
  if (!words.empty()) page.write(words, 22, Weight::Regular, page.palette.ink_soft);
}

void points(Page& page) {
  const auto& tr = page.tr;
  const bool two = side_by_side(page);
  if (two) page.tree.open(page.grown(page.box(Flow::Row, space::kS)));
  point(
      page, icon::kCamera, tr("We photograph your head"),
      tr("Two cameras photograph your face at the same moment, and its sides if you turn your head. Nothing is photographed until you say yes."));
  point(page, icon::kShape, tr("You look at it first"),
        tr("This device computes a 3D portrait from it. Nothing leaves the device for this."));
  if (two) page.tree.close(), page.tree.open(page.grown(page.box(Flow::Row, space::kS)));
  point(page, icon::kDisk, tr("You decide what is kept"),
        tr("Only if you accept it are the portrait, your name and this consent stored, on this device."));
  point(page, icon::kBin, tr("You can have it erased"),
        tr("You get a code. Quote it to the staff at any time and everything about you is erased."));
  if (two) page.tree.close();
}

}  // namespace

void attract_screen(Page& page) {
  page.open_page(page.portrait ? page.box(Flow::Column, space::kL, 56, 56)
                               : page.sided(page.box(Flow::Row, space::kXl, 72, 32)));
  if (page.portrait) host(page), face(page);
  words(page);
  if (!page.portrait) {
    const auto in_box = page.tree.inside(page.grown(page.box(Flow::Column, space::kM)));
    host(page);
    face(page);
    if (tight(page)) page.cameras();
    tools(page);
  }
  page.tree.close();
  if (page.visit.rests(page.view.now)) page.tree.leaf(page.painted(page.box(Flow::Column), {0, 0, 0, 150}));
}

// What happens, what is kept, and the question. No camera has run before the answer.
void consent_screen(Page& page) {
  const auto& tr = page.tr;
  page.begin(true);
  const ConsentText* own =
      page.view.consent != nullptr ? page.view.consent->of(page.visit.language) : nullptr;
  Node top = page.row_box(space::kM);
  top.box.wrap = true;
  page.tree.open(top);
  page.tree.open(page.grown(page.box(Flow::Column)));
  page.heading("title", own != nullptr ? std::string_view(own->title) : tr("What happens here"));
  page.tree.close();
  page.cameras();
  page.tree.close();
  Node list = page.grown(page.box(Flow::Column, space::kS));
  list.id = kToRead;
  list.box.scroll = list.box.even = true;
  page.tree.open(list);
  if (own != nullptr) {  // one under the other, as the operator wrote them
    for (const ConsentPoint& said : own->points) point(page, nullptr, said.title, said.words);
  } else {
    points(page);
    page.write(tr("Sample text, not reviewed by a lawyer: the operator puts their own here."), type::kSmall,
               Weight::Regular, page.palette.ink_soft);
  }
  page.tree.close();
  page.tree.open(page.sided(page.abreast_box(space::kM)));
  const float grow = page.portrait ? 0.0F : 1.0F;
  page.button("decline", tr("No, thank you"), nullptr, ButtonLook::Quiet, ActionKind::Decline, grow);
  if (page.visit.has_read())
    page.button("agree", tr("I agree"), icon::kGood, ButtonLook::Main, ActionKind::Agree, 1.6F * grow);
  else page.button("read_on", tr("Go on"), icon::kDown, ButtonLook::Quiet, ActionKind::ReadOn, 1.6F * grow);
  page.tree.close();
  page.end();
}

}  // namespace relievo::ui
