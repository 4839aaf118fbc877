// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pages with one message: thanks, trouble, and the moment before the appliance is ready.
#include <algorithm>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

constexpr float kColumn = 860, kTwoCards = 1180;
constexpr float kSide = 24;
constexpr float kCorner = 16;  // as the staff's way in has it (staff_entrance)

// What every page has at its top, beside the staff's way in where there is one: whoever reads a message reads
// it in their language, and as large as they need it.
void tools(Page& page) {
  const auto in_row = page.tree.inside(justified(page.sided(page.box(Flow::Row, space::kS)), Justify::End));
  if (page.visit.step == Step::Thanks) {
    const auto in_seen = page.tree.inside(page.grown(page.row_box()));
    // They rest as soon as the portrait is stored: who listens is not told first that they are on.
    if (!page.view.cameras_on) page.cameras();
  }
  page.reading_tools();
  if (page.view.service != nullptr && page.visit.step == Step::Trouble)
    page.tree.leaf(page.sized(page.box(Flow::Column), size::kTarget, 1));
}

// The way on stands under the words; where those are so large that they may have to be scrolled, at the foot
// of the page.
bool at_foot(const Page& page) { return !page.portrait && page.large_words(); }
// Two codes beside each other.
bool abreast(const Page& page) {
  return !page.portrait && !at_foot(page) && !page.view.take_home.link.empty();
}

// One column in the middle of the page, with a sign on top.
void begin_message(Page& page, const char* letter, Colour colour, bool with_tools, float gap = space::kM) {
  // Where the tools stood on the pages before, they stay; on a page that the staff can leave, beside their
  // lock.
  const bool at_lock = page.visit.step == Step::Trouble;
  page.open_page(
      page.box(Flow::Column, space::kM, at_lock ? kCorner : kPageMargin, at_lock ? kCorner : kPageTop));
  if (with_tools && !page.low()) tools(page);
  page.tree.open(
      aligned(page.grown(page.box(Flow::Column, 0, kSide, with_tools ? 0 : kSide)), Align::Centre));
  Node column = scroller("message", justified(page.grown(page.box(Flow::Column, gap)), Justify::Centre));
  const float across = abreast(page) ? kTwoCards : kColumn;
  column.box.max_width = page.px(across);
  column.box.width = page.px(std::min(across, page.width_dp - 80));
  page.tree.open(column);
  if (letter != nullptr) page.sign(letter, 88 / page.text_share, colour);
}

// Closes the column, the middle and the page.
void end_message(Page& page, bool in_column = true) {
  if (in_column) page.tree.close();
  page.tree.close();
  if (page.low() && page.visit.step != Step::Starting) tools(page);
  page.tree.close();
}

template <typename Under>
void end_message(Page& page, bool foot, const Under& draw) {
  if (foot) page.tree.close();
  else page.tree.leaf(page.sized(page.box(Flow::Column), 1, 8));
  Node under = page.box(Flow::Column, space::kS, 0, foot ? space::kS : 0.0F);
  if (foot) under.box.width = page.px(std::min(kColumn, page.width_dp - 2 * (kPageMargin + kSide)));
  page.tree.open(under);
  draw();
  page.tree.close();
  end_message(page, !foot);
}

void end_message(Page& page, const char* on, const char* letter, bool foot,
                 ActionKind action = ActionKind::Finish) {
  end_message(page, foot, [&] {
    page.button(action == ActionKind::Finish ? "finish" : "enter", on, letter, ButtonLook::Main, {action, 0});
  });
}

struct Message {
  const char *letter, *title, *words;
};

Message words_of(const Page& page) {
  const auto& tr = page.tr;
  // What stands in everybody's way counts more than what stood in the last visitor's.
  const bool waits = page.view.screen == Screen::Idle &&
                     (page.view.trouble == Trouble::None || bars_the_way(page.view.out_of_order));
  switch (waits ? page.view.out_of_order : page.view.trouble) {
    case Trouble::Camera:
      return {icon::kNoCamera, tr("A camera does not answer"),
              tr("Please tell the staff. This device tries again by itself.")};
    case Trouble::Calibration:
      return {icon::kWrench, tr("The cameras need adjusting"),
              tr("A technician has to measure them again before portraits can be made.")};
    case Trouble::Refused:
      return {
          icon::kPerson, tr("It did not work this time"),
          tr("No picture was good enough for a portrait. You can start again, or ask the staff for help.")};
    case Trouble::Storage:
    case Trouble::StorageFull:
      return {icon::kDisk, tr("Nothing can be stored at the moment"), tr("Please tell the staff.")};
    case Trouble::TookTooLong: return {icon::kWait, tr("It took too long"), tr("You can start again.")};
    case Trouble::Uncalibrated:
      return {
          icon::kWrench, tr("This device is not set up yet"),
          tr("A technician has to calibrate its cameras first. As soon as that is done, it carries on by itself.")};
    case Trouble::Clock:
      return {
          icon::kWait, tr("The clock of this device is wrong"),
          tr("Your consent needs the right date. Please tell the staff: as soon as the clock is set, this device carries on by itself.")};
    case Trouble::Restarted:
      return {
          icon::kAgain, tr("This device has just restarted"),
          tr("If you were in the middle of a portrait, please begin again: nothing of it was kept. Portraits stored earlier are safe.")};
    case Trouble::None:
    case Trouble::Other: break;
  }
  return {icon::kAlert, tr("This device needs help"),
          tr("Please tell the staff. This device tries again by itself.")};
}

constexpr float kCodeSide = 190, kLinkWords = 220, kLinkLetters = 18;  // so many on one of its lines

void qr(Page& page, std::string_view id, PictureSlot slot) {
  Node code = page.sized(page.box(Flow::Column), kCodeSide, kCodeSide);
  code.id = id;
  depict(code, slot, 1);
  page.tree.leaf(code);
}

Node code_card(const Page& page, std::string_view id, const char* name, Colour border) {
  Node card =
      aligned(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM, 32, page.portrait ? 16 : 10),
              Align::Centre);
  tell(card, Role::Group, id, name);
  frame(card, page.palette.card, border, page.px(3), page.px(size::kCardRadius));
  return card;
}

// Large words leave room for it where nothing else is offered.
bool has_room_for_qr(const Page& page) {
  constexpr float kRoom = 1.3F;
  return !at_foot(page) ||
         (page.text_share < kRoom && page.view.take_home.link.empty() &&
          page.view.take_home.taking == Taking::None && page.view.printing == Printing::None);
}

// The code in digits, and where there is room as a QR code for a photograph.
void erasure_code(Page& page) {
  const auto& tr = page.tr;
  Node card = code_card(page, "code", tr("Your code"), page.palette.accent);
  card.value = page.spelled(page.view.receipt);
  card.secret = true;
  const auto in_card = page.tree.inside(card);
  page.tree.open(page.box(Flow::Column, 4));
  page.write(tr("Your code"), type::kSmall, Weight::Medium, page.palette.ink_soft, TextAlign::Centre);
  const float code_dp = abreast(page) ? 36 : 52;
  Node code = page.text(page.filled("{}", page.view.receipt), code_dp, Weight::Bold, page.palette.ink,
                        TextAlign::Centre);
  code.id = "receipt";
  code.style.size_px = page.px(code_dp);
  page.tree.leaf(code);
  page.tree.close();
  if (!page.view.receipt_code.pixels.empty() && has_room_for_qr(page)) qr(page, "qr", PictureSlot::Receipt);
}

// Where the operator offers the portrait.
void link(Page& page) {
  const std::string_view site = site_of(page.view.take_home.link);
  Node card = code_card(page, "link", page.tr("Your portrait"), page.palette.card_border);
  card.value = site;
  const auto in_card = page.tree.inside(card);
  // A line that may end at a point does, though the whole address has room on the next.
  const bool has_room = float(site.size()) * page.text_share < kLinkLetters;
  Node words = page.text(page.filled(page.tr("Photograph this code to find your portrait at {}."),
                                     has_room ? site : page.breakable(site, ".")),
                         type::kSmall, Weight::Medium, page.palette.ink_soft,
                         page.portrait ? TextAlign::Centre : TextAlign::Start);
  words.id = "link_words";
  if (!page.portrait && !at_foot(page)) words.box.width = page.px(kLinkWords);
  page.tree.leaf(at_foot(page) ? page.grown(words) : words);
  qr(page, "link_qr", PictureSlot::Link);
}

void codes(Page& page) {
  Node row = justified(page.box(abreast(page) ? Flow::Row : Flow::Column, space::kM), Justify::Centre);
  if (!abreast(page)) row.box.align = Align::Centre;
  const auto in_row = page.tree.inside(row);
  erasure_code(page);
  if (!page.view.take_home.link.empty()) link(page);
}

void said(Page& page, std::string_view id, const char* words, Colour ink) {
  page.put(id, Role::Status, words, at_foot(page) ? type::kSmall : type::kBody, Weight::Medium, ink,
           TextAlign::Centre);
}

// On paper, where there is a printer.
void printing(Page& page) {
  const auto& tr = page.tr;
  const Printing paper = page.view.printing;
  if (paper == Printing::Busy) said(page, "printing", tr("One moment, please"), page.palette.ink);
  if (paper == Printing::Done) said(page, "printing", tr("It has been printed"), page.palette.ink);
  if (paper == Printing::Failed) said(page, "printing", tr("It could not be printed"), page.palette.bad);
  // The printer would wait for the stick.
  const bool free = page.view.take_home.taking != Taking::Busy;
  if (free && (paper == Printing::Ready || paper == Printing::Failed))
    page.button("print", tr("Print the code"), icon::kPrinter, ButtonLook::Quiet, ActionKind::Print);
}

// The copy on the visitor's stick: how the last try ended, or how one begins.
void said_of_stick(Page& page) {
  const auto& tr = page.tr;
  const TakeHomeView& home = page.view.take_home;
  const auto good = [&](const char* words) { said(page, "stick", words, page.palette.good); };
  const auto bad = [&](const char* words) { said(page, "stick", words, page.palette.bad); };
  switch (home.outcome) {
    case Outcome::None: break;
    case Outcome::Done:
    case Outcome::StickUnchecked: return good(tr("Your portrait is on the stick. You can pull it out now."));
    case Outcome::StickHeld:
      return good(tr("Your portrait is on the stick. Wait ten seconds, then pull it out."));
    case Outcome::StickFull: return bad(tr("The stick is full. Please use another one."));
    case Outcome::StickGone:
      return bad(tr("The stick was pulled out too early. Plug it in, then try again."));
    case Outcome::StickLocked: return bad(tr("The stick is write-protected. Please use another one."));
    case Outcome::Cancelled: return said(page, "stick", tr("It was stopped"), page.palette.ink);
    case Outcome::StickBad:
    case Outcome::NoStick:
    case Outcome::NotFound:
    case Outcome::Refused:
    case Outcome::Failed: return bad(tr("It did not work with this stick. Please use another one."));
  }
  if (home.taking != Taking::NoStick && home.taking != Taking::NotOurs) return;
  const char* offer =
      home.taking == Taking::NotOurs
          ? tr("A stick was already plugged in. If it is yours, pull it out and plug it in again.")
          : tr("You can take your portrait with you: plug in a USB stick.");
  page.put("stick", Role::Status, offer, type::kSmall, Weight::Regular, page.palette.ink_soft,
           TextAlign::Centre);
}

// Who waits for their stick does not leave by a touch too many.
void take_or_leave(Page& page) {
  const auto& tr = page.tr;
  if (page.view.take_home.taking == Taking::Busy) {
    said(page, "stick", tr("Writing to the stick"), page.palette.ink);
    page.body("do_not_pull", tr("Please do not pull it out."), TextAlign::Centre);
    page.progress("taking", page.view.take_home.progress);
    return page.button("stop", tr("Stop"), icon::kClose, ButtonLook::Quiet, ActionKind::StopTaking);
  }
  said_of_stick(page);
  const auto in_row = page.tree.inside(page.abreast_box(space::kS));
  const float share = page.portrait ? 0.0F : 1.0F;
  if (page.view.take_home.taking == Taking::Ready)
    page.button("take_home", tr("Take my portrait with me"), icon::kStick, ButtonLook::Quiet,
                ActionKind::TakeHome, share);
  page.button("finish", tr("Done"), icon::kCheck, ButtonLook::Main, ActionKind::Finish, share);
}

}  // namespace

void thanks_screen(Page& page) {
  const auto& tr = page.tr;
  // A low page has no room for a sign: the code must be seen whole, and the way on.
  begin_message(page, page.portrait ? icon::kGood : nullptr, page.palette.good, true,
                page.portrait ? space::kM : space::kS);
  page.heading("title", tr("Thank you. Your portrait is stored"), type::kTitle, TextAlign::Centre);
  // Between letters so large that the words may have to be scrolled, the code comes first.
  if (at_foot(page)) codes(page);
  page.body("what", tr("To have it erased, quote this code to the staff. You can take a photo of it."),
            TextAlign::Centre);
  if (!at_foot(page)) codes(page);
  printing(page);
  // What is said of a stick is seen without scrolling, and the way on where two codes leave no room for it.
  const bool tall =
      page.large_words() && (page.view.take_home.taking != Taking::None || !page.view.take_home.link.empty());
  end_message(page, !page.portrait || tall, [&] { take_or_leave(page); });
}

void declined_screen(Page& page) {
  begin_message(page, icon::kGood, page.palette.good, true);
  page.heading("title", page.tr("All right. Nothing was kept"), type::kTitle, TextAlign::Centre);
  page.body(
      "what",
      page.tr("If you would rather not use this screen, ask the staff: they can do every step for you."),
      TextAlign::Centre);
  end_message(page, page.tr("Back to the start"), icon::kAgain, at_foot(page));
}

void trouble_screen(Page& page) {
  const Message said = words_of(page);
  begin_message(page, said.letter, page.palette.warn, true);
  page.heading("title", said.title, type::kTitle, TextAlign::Centre);
  if (page.view.trouble == Trouble::Refused && page.visit.shot_in_the_dark)
    page.body("why", page.tr("It is too dark here for the cameras"), TextAlign::Centre);
  page.body("what", said.words, TextAlign::Centre);
  // Whoever has just been thanked was kept: what is out of order then is said to the next one.
  if (page.view.trouble != Trouble::None || page.view.screen != Screen::Idle)
    page.body("kept", page.tr("Nothing about you was kept."), TextAlign::Centre);
  if (page.view.screen == Screen::Idle && !bars_the_way(page.view.out_of_order))
    end_message(page, page.tr("Back to the start"), icon::kAgain, at_foot(page));
  // Who sets it up need not look for the way in.
  else if (page.view.out_of_order == Trouble::Uncalibrated && page.view.service != nullptr)
    end_message(page, page.tr("Staff"), icon::kLock, at_foot(page), ActionKind::StaffEnter);
  else end_message(page);
}

void starting_screen(Page& page) {
  begin_message(page, icon::kWait, page.palette.good, false);
  page.heading("title", page.tr("One moment, please"), type::kTitle, TextAlign::Centre);
  page.body("what", page.tr("This device is starting up and testing itself."), TextAlign::Centre);
  end_message(page);
}

}  // namespace relievo::ui
