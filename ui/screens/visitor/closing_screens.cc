// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pages with one message: thanks, trouble, and the moment before the appliance is ready.
#include <algorithm>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

constexpr float kColumn = 860;
constexpr float kCorner = 16;  // as the staff's way in has it (staff_entrance)

// What every page has at its top, beside the staff's way in where there is one: whoever reads a message reads
// it in their language, and as large as they need it.
void tools(Page& page) {
  Node row = page.sided(page.box(Flow::Row, space::kS));
  row.box.justify = Justify::End;
  const auto in_row = page.tree.inside(row);
  page.reading_tools();
  if (page.view.service != nullptr && page.visit.step == Step::Trouble)
    page.tree.leaf(page.sized(page.box(Flow::Column), size::kTarget, 1));
}

// One column in the middle of the page, with a sign on top.
void begin_message(Page& page, const char* letter, Colour colour, bool with_tools, float gap = space::kM) {
  // Where the tools stood on the pages before, they stay; on a page that the staff can leave, beside their
  // lock.
  const bool at_lock = page.visit.step == Step::Trouble;
  Node root =
      page.box(Flow::Column, space::kM, at_lock ? kCorner : kPageMargin, at_lock ? kCorner : kPageTop);
  root.id = "page";
  root.box.fill = page.palette.ground;
  root.box.fill_end = page.palette.ground_end;
  page.tree.open(root);
  if (with_tools && !page.low()) tools(page);
  Node middle = page.grown(page.box(Flow::Column, 0, 24, with_tools ? 0 : 24));
  middle.box.align = Align::Centre;
  page.tree.open(middle);
  Node column = page.grown(page.box(Flow::Column, gap));
  column.box.max_width = page.px(kColumn);
  column.box.width = page.px(std::min(kColumn, page.width_dp - 80));
  column.box.justify = Justify::Centre;
  column.box.scroll = true;
  column.id = "message";
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

// The way on stands under the words; where those are so large that they may have to be scrolled, at the foot
// of the page.
bool at_foot(const Page& page) { return !page.portrait && page.text_share > 1.2F; }

void end_message(Page& page, const char* on, const char* letter, bool foot,
                 ActionKind action = ActionKind::Finish) {
  if (foot) page.tree.close();
  else page.tree.leaf(page.sized(page.box(Flow::Column), 1, 8));
  Node row = page.box(Flow::Column, 0, 0, foot ? space::kS : 0.0F);
  if (foot) row.box.width = page.px(std::min(kColumn, page.width_dp - 80));
  page.tree.open(row);
  page.button(action == ActionKind::Finish ? "finish" : "enter", on, letter, ButtonLook::Main, {action, 0});
  page.tree.close();
  end_message(page, !foot);
}

struct Words4 {
  const char* letter;
  const char* title;
  const char* words;
};

Words4 words_of(const Page& page) {
  const auto& tr = page.tr;
  // What stands in everybody's way counts more than what stood in the last visitor's.
  const bool waits = page.view.screen == Screen::Idle &&
                     (page.view.trouble == Trouble::None || bars_the_way(page.view.out_of_order));
  switch (waits ? page.view.out_of_order : page.view.trouble) {
    case Trouble::Camera:
      return {icon::kNoCamera, tr("A camera does not answer"),
              tr("Please tell the staff. This device tries again by itself. Nothing about you was kept.")};
    case Trouble::Calibration:
      return {
          icon::kWrench, tr("The cameras need adjusting"),
          tr("A technician has to measure them again before portraits can be made. Nothing about you was kept.")};
    case Trouble::Refused:
      return {
          icon::kPerson, tr("It did not work this time"),
          tr("Three pictures were not good enough for a portrait. You can start again, or ask the staff for help. Nothing about you was kept.")};
    case Trouble::Storage:
      return {icon::kDisk, tr("Nothing can be stored at the moment"),
              tr("Please tell the staff. Nothing about you was kept.")};
    case Trouble::TookTooLong:
      return {icon::kWait, tr("It took too long"), tr("You can start again. Nothing about you was kept.")};
    case Trouble::Uncalibrated:
      return {
          icon::kWrench, tr("This device is not set up yet"),
          tr("A technician has to calibrate its cameras first. As soon as that is done, it carries on by itself. Nothing about you was kept.")};
    case Trouble::Clock:
      return {
          icon::kWait, tr("The clock of this device is wrong"),
          tr("Your consent needs the right date. Please tell the staff: as soon as the clock is set, this device carries on by itself. Nothing about you was kept.")};
    case Trouble::Restarted:
      return {
          icon::kAgain, tr("This device has just restarted"),
          tr("If you were in the middle of a portrait, please begin again: nothing of it was kept. Portraits stored earlier are safe.")};
    case Trouble::None:
    case Trouble::Other: break;
  }
  return {icon::kAlert, tr("This device needs help"),
          tr("Please tell the staff. This device tries again by itself. Nothing about you was kept.")};
}

// The code in digits, and where there is room as a QR code for a photograph.
void receipt(Page& page) {
  const auto& tr = page.tr;
  Node row = page.box(Flow::Row);
  row.box.justify = Justify::Centre;
  const auto in_row = page.tree.inside(row);
  Node card = page.box(page.portrait ? Flow::Column : Flow::Row, space::kM, 32, 16);
  tell(card, Role::Group, "code", tr("Your code"));
  card.value = page.spelled(page.view.receipt);
  card.secret = true;
  card.box.align = Align::Centre;
  frame(card, page.palette.card, page.palette.accent, page.px(3), page.px(size::kCardRadius));
  const auto in_card = page.tree.inside(card);
  page.tree.open(page.box(Flow::Column, 4));
  page.tree.leaf(
      page.text(tr("Your code"), type::kSmall, Weight::Medium, page.palette.ink_soft, TextAlign::Centre));
  constexpr float kCode = 52;
  Node code = page.text(page.filled("{}", page.view.receipt), kCode, Weight::Bold, page.palette.ink,
                        TextAlign::Centre);
  code.id = "receipt";
  code.style.size_px = page.px(kCode);
  page.tree.leaf(code);
  page.tree.close();
  if (const ImageView& drawn = page.view.receipt_code.picture; !drawn.empty() && !at_foot(page)) {
    constexpr float kSide = 190;
    Node qr = page.sized(page.box(Flow::Column), kSide, kSide);
    qr.id = "qr";
    qr.mark = Mark::Image;
    qr.picture = PictureSlot::Receipt;
    qr.aspect = 1;
    page.tree.leaf(qr);
  }
}

// On paper, where there is a printer.
void printing(Page& page) {
  const auto& tr = page.tr;
  const char* said = nullptr;
  switch (page.view.printing) {
    case Printing::None: return;
    case Printing::Busy: said = tr("One moment, please"); break;
    case Printing::Done: said = tr("It has been printed"); break;
    case Printing::Failed: said = tr("It could not be printed"); break;
    case Printing::Ready: break;
  }
  if (said != nullptr) {
    Node words = page.text(said, type::kBody, Weight::Medium,
                           page.view.printing == Printing::Failed ? page.palette.bad : page.palette.ink,
                           TextAlign::Centre);
    words.id = "printing";
    words.role = Role::Status;
    page.tree.leaf(words);
  }
  if (page.view.printing == Printing::Ready || page.view.printing == Printing::Failed)
    page.button("print", tr("Print the code"), icon::kPrinter, ButtonLook::Quiet, {ActionKind::Print, 0});
}

}  // namespace

void thanks_screen(Page& page) {
  const auto& tr = page.tr;
  // A low page has no room for a sign: the code must be seen whole, and the way on.
  begin_message(page, page.portrait ? icon::kGood : nullptr, page.palette.good, true,
                page.portrait ? space::kM : space::kS);
  page.heading("title", tr("Thank you. Your portrait is stored"), type::kTitle, TextAlign::Centre);
  // Between letters so large that the words may have to be scrolled, the code comes first.
  if (at_foot(page)) receipt(page);
  page.body("what", tr("To have it erased, quote this code to the staff. You can take a photo of it."),
            TextAlign::Centre);
  if (!at_foot(page)) receipt(page);
  printing(page);
  Node row = page.box(Flow::Row);
  row.box.justify = Justify::Centre;
  page.tree.open(row);
  page.cameras();
  page.tree.close();
  end_message(page, tr("Done"), icon::kCheck, !page.portrait);
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
  const Words4 said = words_of(page);
  begin_message(page, said.letter, page.palette.warn, true);
  page.heading("title", said.title, type::kTitle, TextAlign::Centre);
  page.body("what", said.words, TextAlign::Centre);
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
