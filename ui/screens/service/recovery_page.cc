// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The recovery sheet: twelve words and the same as a QR code, to be written down; then two of them are typed.
#include "ui/screens/parts/keyboard.h"
#include "ui/screens/service/staff_pages.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

enum RecoveryMode : int { kSheet, kTypeWord };

void word(StaffFrame& page, const RecoveryView& seen, std::size_t i) {
  Node row = page.grown(page.box(Flow::Row, space::kS));
  row.box.left_to_right = true;  // English, and in this order
  row.box.align = Align::Centre;
  page.tree.open(row);
  Node number = page.text(page.number(static_cast<double>(i + 1)), type::kSmall, Weight::Regular,
                          page.palette.ink_soft, TextAlign::End);
  number.box.width = page.px(36 * page.text_share);
  page.tree.leaf(number);
  Node said = page.english(seen.words[i], type::kBody);
  said.colour = page.palette.ink;
  page.tree.leaf(said);
  page.tree.close();
}

// Downwards in columns, as the sheet is written.
void words(StaffFrame& page, const RecoveryView& seen) {
  const std::size_t columns = page.text_share > 1.2F ? 2 : 3, rows = seen.words.size() / columns;
  Node card = page.box(Flow::Row, space::kM, space::kM, space::kM);
  frame(card, page.palette.card, page.palette.card_border, page.px(1.5F), page.px(size::kRadius));
  card.id = "words";
  card.box.left_to_right = true;
  page.tree.open(card);
  for (std::size_t c = 0; c < columns; ++c) {
    page.tree.open(page.grown(page.box(Flow::Column, space::kXs)));
    for (std::size_t r = 0; r < rows; ++r) word(page, seen, c * rows + r);
    page.tree.close();
  }
  page.tree.close();
}

void sheet(StaffFrame& page, const RecoveryView& seen) {
  Node both = page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kL));
  both.box.align = Align::Centre;
  both.box.justify = Justify::Centre;
  page.tree.open(both);
  page.tree.open(page.grown(page.box(Flow::Column, space::kM), page.portrait ? 0.0F : 1.0F));
  page.body(
      "what",
      page.tr(
          "Write these words down in this order. They open the records should this device break; whoever has them and its disk can read every record."));
  words(page, seen);
  page.tree.close();
  Node code = page.sized(page.box(Flow::Column), 260, 260);
  tell(code, Role::Picture, "code", page.tr("Recovery words"));
  code.mark = Mark::Image;
  code.picture = PictureSlot::TechnicianLeft;
  page.tree.leaf(code);
  page.tree.close();
  page.button("written", page.tr("Go on"), page.onward(), ButtonLook::Main,
              {ActionKind::StaffMode, kTypeWord});
}

void typing(StaffFrame& page, const RecoveryView& seen) {
  const bool busy = seen.state == SheetState::Saving;
  Node field = page.box(Flow::Row, 3, 20, 8);
  const std::string_view asked =
      page.filled(page.tr("Word {} of the sheet"), page.number(static_cast<double>(seen.asked)));
  tell(field, Role::Field, "word field", asked);
  frame(field, page.palette.card, page.palette.accent, page.px(3), page.px(18));
  field.box.min_height = page.px(56);
  field.box.align = Align::Centre;
  page.tree.open(field);
  const std::string_view typed = page.service.typed();
  page.tree.leaf(page.text(typed.empty() ? asked : typed, type::kBody, Weight::Medium,
                           typed.empty() ? page.palette.ink_soft : page.palette.ink));
  page.tree.close();
  if (busy) page.status("state", page.tr("One moment, please"), Mood::Plain);
  if (seen.state == SheetState::Wrong && typed.empty())
    page.status("state", page.tr("That was not right."), Mood::Bad);
  if (seen.state == SheetState::Failed) page.outcome();
  if (page.portrait) page.space(1);
  keyboard(page, typed.empty() || busy ? Action{} : Action(OfferWord{}), Language::English);
}

}  // namespace

void recovery_page(StaffFrame& page) {
  const RecoveryView* seen = page.staff.recovery;
  if (seen == nullptr) return page.body("wait", page.tr("One moment, please"));
  if (seen->state == SheetState::Done) {
    page.status("state", page.tr("These words open the records from now on."), Mood::Good);
    page.space(1);
    return page.button("go on", page.tr("Go on"), page.onward(), ButtonLook::Main,
                       {ActionKind::StaffOpen, static_cast<int>(StaffPage::Menu)});
  }
  if (page.service.mode == kTypeWord) typing(page, *seen);
  else sheet(page, *seen);
}

}  // namespace relievo::ui
