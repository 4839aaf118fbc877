// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lies over a page: help, languages, "really leave?", "still there?". Nothing under it is touched.
#include <cstdio>
#include <string>

#include "ui/screens/parts/overlay.h"

namespace relievo::ui {
namespace {

const char* help_for(const Page& page) {
  const auto& tr = page.tr;
  switch (page.visit.step) {
    case Step::Attract:
      return tr(
          "This device makes a three-dimensional portrait of your face. Touch Start. You can stop at any time.");
    case Step::Consent:
      return tr(
          "Read what happens, then choose. If you say no, nothing happens and nothing is kept. The staff will help you another way.");
    case Step::Known:
      return tr(
          "Is that you? With the code you were given you can renew your portrait or add another one. Without it nothing from the record is shown.");
    case Step::Name:
      return tr("Type your name, or the number you were given. The arrow key erases a letter.");
    case Step::Position:
      return tr(
          "Stand about an arm's length away, so that your face fills the oval. Take off sunglasses and hat. When all is well the picture is taken by itself.");
    case Step::Turn:
      return tr(
          "Pictures from the sides show your whole head. Turn it slowly and hold it level: each side is taken by itself. If you cannot or do not want to, touch the button below.");
    case Step::Working:
      return tr("Please wait a few seconds. To stop, touch the cross.");
    case Step::Review:
      return tr("Draw a finger across the portrait to turn it. Keep it, or take another one.");
    case Step::Thanks:
      return tr("Write the code down, or photograph it. With it everything about you can be erased.");
    case Step::Trouble:
    case Step::Starting:
      break;
  }
  return tr("Please tell the staff.");
}

void begin_card(Page& page) {
  Node veil = page.box(Flow::Column, 0, 40, 32);
  centre(veil);
  veil.id = "veil";
  veil.modal = true;
  veil.box.fill = page.palette.veil;
  page.tree.open(veil);
  Node card = page.box(Flow::Column, space::kM, 44, 40);
  frame(card, page.palette.card, page.palette.card_border, page.px(2), page.px(size::kCardRadius));
  card.id = "card";
  card.box.width = page.px(std::min(820.0F, page.width_dp - 80));
  card.box.shrink = true;
  card.box.shadow = true;
  page.tree.open(card);
}

void end_card(Page& page) {
  page.tree.close();
  page.tree.close();
}

// Two answers: side by side where there is room for their words.
void answers(Page& page, const char* quiet, Action quiet_action, const char* main, Action main_action) {
  const bool row = page.text_share < 1.4F && !(page.portrait && page.text_share > 1.2F);
  page.tree.open(page.box(row ? Flow::Row : Flow::Column, space::kS));
  page.button("answer_quiet", quiet, nullptr, ButtonLook::Quiet, quiet_action, row ? 1.0F : 0.0F);
  page.button("answer_main", main, nullptr, ButtonLook::Main, main_action, row ? 1.0F : 0.0F);
  page.tree.close();
}

// For who listens: volume and speed, which all keypads reach.
void hearing(Page& page) {
  const auto percent = [&](int value) { return page.filled("{} %", std::to_string(value)); };
  const std::string_view volume = percent(kVolumePercents[page.visit.volume]);
  Node row = page.box(Flow::Row, space::kS);
  page.tree.open(row);
  page.square_button("quieter", page.tr("Quieter"), icon::kQuieter, {ActionKind::Quieter, 0}, volume);
  page.square_button("louder", page.tr("Louder"), icon::kSpeaker, {ActionKind::Louder, 0}, volume);
  page.square_button("speed", page.tr("Speed of speech"), icon::kSpeed, {ActionKind::Speed, 0},
                     percent(kSpeedPercents[page.visit.speed]));
  page.tree.close();
}

// Large letters may need more than the screen: then the words can be scrolled.
void help(Page& page) {
  page.heading("overlay_title", page.tr("Help"));
  Node words = page.box(Flow::Column, space::kM);
  words.id = "overlay_words";
  words.box.scroll = words.box.shrink = true;
  page.tree.open(words);
  page.body("overlay_text", help_for(page));
  if (page.visit.step == Step::Name)
    page.body("overlay_code",
              page.tr("You can also hold a QR code with your name or number up to the cameras."));
  page.body(
      "overlay_staff",
      page.tr("If you would rather not use this screen, ask the staff: they can do every step for you."));
  page.tree.close();
  if (page.visit.spoken) hearing(page);
  page.button("close", page.tr("Go on"), icon::kCheck, ButtonLook::Main, {ActionKind::CloseOverlay, 0});
}

void languages(Page& page) {
  page.heading("overlay_title", page.tr("Choose your language"));
  language_grid(page, 2);
}

void leave(Page& page) {
  page.heading("overlay_title", page.tr("Stop and leave"));
  page.body("overlay_text",
            page.tr("Everything you have entered and every picture are wiped at once. Nothing is kept."));
  answers(page, page.tr("Yes, wipe everything"), {ActionKind::LeaveNow, 0}, page.tr("No, go on"),
          {ActionKind::Stay, 0});
}

void still_there(Page& page) {
  const int left = page.visit.seconds_left(page.view.now);
  char number[8];
  std::snprintf(number, sizeof number, "%d", left);
  page.heading("overlay_title", page.tr("Are you still there?"));
  Node words = page.text(
      page.filled(page.tr.plural("Everything is wiped in {} second.", "Everything is wiped in {} seconds.",
                                 static_cast<unsigned long>(left)),
                  number),
      type::kBody, Weight::Regular, page.palette.ink_soft);
  words.id = "overlay_text";
  words.role = Role::Status;
  page.tree.leaf(words);
  answers(page, page.tr("Stop now"), {ActionKind::LeaveNow, 0}, page.tr("Yes, go on"), {ActionKind::Stay, 0});
}

}  // namespace

void overlay_screen(Page& page) {
  begin_card(page);
  switch (page.visit.overlay) {
    case Overlay::Help:
      help(page);
      break;
    case Overlay::Languages:
      languages(page);
      break;
    case Overlay::Leave:
      leave(page);
      break;
    case Overlay::StillThere:
      still_there(page);
      break;
    case Overlay::None:
      break;
  }
  end_card(page);
}

}  // namespace relievo::ui
