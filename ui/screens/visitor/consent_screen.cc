// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What happens, what is kept, and the question. No camera has run before the answer.
#include <algorithm>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

constexpr float kBadge = 76;

bool side_by_side(const Page& page) { return !page.portrait && page.text_share < 1.3F; }

void badge(Page& page, const char* letter) {
  Node box = page.sized(page.box(Flow::Column), kBadge, kBadge);
  box.box.justify = Justify::Centre;
  box.box.fill = page.palette.accent.with_alpha(0.12F);
  box.box.radius = page.px(kBadge / 4);
  page.tree.open(box);
  Node sign =
      page.text(letter, kBadge / 2 / page.text_share, Weight::Regular, page.palette.link, TextAlign::Centre);
  sign.role = Role::Icon;
  sign.style.icon = true;
  page.tree.leaf(sign);
  page.tree.close();
}

void point(Page& page, const char* letter, std::string_view title, std::string_view words) {
  Node row = page.box(Flow::Row, space::kM, 22, side_by_side(page) ? 26 : 18);
  row.box.align = side_by_side(page) ? Align::Start : Align::Centre;  // titles of neighbours on one line
  row.box.fill = page.palette.card;
  row.box.border = page.palette.card_border;
  row.box.border_px = page.px(1.5F);
  row.box.radius = page.px(size::kRadius);
  row.box.grow = 1;
  page.tree.open(row);
  if (letter != nullptr) badge(page, letter);
  Node column = page.grown(page.box(Flow::Column, 4));
  page.tree.open(column);
  page.tree.leaf(page.text(title, type::kBody, Weight::Bold, page.palette.ink));
  if (!words.empty()) page.tree.leaf(page.text(words, 22, Weight::Regular, page.palette.ink_soft));
  page.tree.close();
  page.tree.close();
}

void points(Page& page) {
  const auto& tr = page.tr;
  const bool two = side_by_side(page);
  const auto open_row = [&] {
    if (two) page.tree.open(page.grown(page.box(Flow::Row, space::kS)));
  };
  const auto close_row = [&] {
    if (two) page.tree.close();
  };
  open_row();
  point(
      page, icon::kCamera, tr("We photograph your head"),
      tr("Two cameras photograph your face at the same moment, and its sides if you turn your head. Nothing is photographed until you say yes."));
  point(page, icon::kShape, tr("You look at it first"),
        tr("This device computes a 3D portrait from it. Nothing leaves the device for this."));
  close_row();
  open_row();
  point(page, icon::kDisk, tr("You decide what is kept"),
        tr("Only if you accept it are the portrait, your name and this consent stored, on this device."));
  point(page, icon::kBin, tr("You can have it erased"),
        tr("You get a code. Quote it to the staff at any time and everything about you is erased."));
  close_row();
}

// The operator's own words, one under the other, as they wrote them.
void own_points(Page& page, const ConsentText& own) {
  for (const ConsentPoint& said : own.points) point(page, nullptr, said.title, said.words);
}

}  // namespace

void consent_screen(Page& page) {
  const auto& tr = page.tr;
  page.begin(true);
  const ConsentText* own =
      page.view.consent != nullptr ? page.view.consent->of(page.visit.language) : nullptr;
  Node top = page.box(Flow::Row, space::kM);
  top.box.wrap = true;
  top.box.align = Align::Centre;
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
  if (own != nullptr) own_points(page, *own);
  else points(page);
  if (own == nullptr)
    page.tree.leaf(page.text(tr("Sample text, not reviewed by a lawyer: the operator puts their own here."),
                             type::kSmall, Weight::Regular, page.palette.ink_soft));
  page.tree.close();
  page.tree.open(page.sided(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
  const float grow = page.portrait ? 0.0F : 1.0F;
  page.button("decline", tr("No, thank you"), nullptr, ButtonLook::Quiet, {ActionKind::Decline, 0}, grow);
  if (page.visit.has_read())
    page.button("agree", tr("I agree"), icon::kGood, ButtonLook::Main, {ActionKind::Agree, 0}, 1.6F * grow);
  else
    page.button("read_on", tr("Go on"), icon::kDown, ButtonLook::Quiet, {ActionKind::ReadOn, 0}, 1.6F * grow);
  page.tree.close();
  page.end();
}

}  // namespace relievo::ui
