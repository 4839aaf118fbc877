// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's first page: what needs a hand, then the pages a role may open, in groups. Both are made from
// tables (status_table.h, staff_pages()): what is new appears by its row.
#include <array>
#include <utility>

#include "ui/screens/service/status_table.h"
#include "ui/screens/staff_screens.h"

namespace relievo::ui {
namespace {

// Sign, words, what is said beside them; a button where this role can mend it, else whose work it is.
void finding(StaffFrame& page, const Finding& found) {
  const auto& tr = page.tr;
  const StaffPage where = found.rule->page_of(page.staff.role);
  const bool mine = where != StaffPage::Menu;
  Node row = page.row_box(space::kS, 0, 6);
  tell(row, mine ? Role::Button : Role::Status, page.joined({"status ", found.rule->id}),
       tr(found.rule->words));
  row.value = tr("Not in order");
  if (mine) row.action = {ActionKind::StaffOpen, int(where)};
  row.box.min_height = page.px(size::kStaffTarget);
  const auto in_row = page.tree.inside(row);
  const Colour ink = page.ink_of(found.mood);
  page.sign(page.sign_of(found.mood), 28, ink);
  Node both = page.grown(page.row_box(space::kM));
  both.box.wrap = true;
  page.tree.open(both);
  page.wide(page.text(tr(found.rule->words), type::kSmall, Weight::Medium, ink));
  const char* whose = page.staff.role == StaffRole::Operator ? tr("Technician") : tr("Operator");
  const std::string_view value = !mine                          ? std::string_view(whose)
                                 : found.rule->value != nullptr ? found.rule->value(page, *page.staff.status)
                                                                : std::string_view();
  if (!value.empty()) page.write(value, type::kSmall, Weight::Regular, page.palette.ink_soft, TextAlign::End);
  page.tree.close();
  if (mine) page.sign(page.onward(), 24, page.palette.link);
}

void status(StaffFrame& page) {
  const StatusView* seen = page.staff.status;
  Node card = page.box(Flow::Column, 0, space::kM, 4);
  page.card(card, size::kRadius);
  card.id = "status";
  const auto in_card = page.tree.inside(card);
  if (seen == nullptr || !seen->looked) {
    page.status("status looking", page.tr("One moment, please"), Mood::Plain);
  } else {
    std::array<Finding, kMostFindings> room;
    const std::span<const Finding> found = find_status(page.view, *seen, room);
    if (found.empty()) page.status("status good", page.tr("In order"), Mood::Good);
    for (const Finding& one : found) {
      if (&one != found.data()) page.rule();
      finding(page, one);
    }
  }
}

void tile(StaffFrame& page, const StaffPageInfo& info) {
  Node node = page.grown(page.row_box(space::kS, page.portrait ? 10 : 16, 8));
  const char* title = page.tr(info.title);
  tell(node, Role::Button, info.id, title, {ActionKind::StaffOpen, int(info.page)});
  node.box.min_height = page.px(72);
  frame(node, page.palette.card, page.palette.card_border, page.px(2), page.px(20));
  const auto in_node = page.tree.inside(node);
  page.sign(info.letter, 32 / page.text_share, page.palette.accent);
  page.wide(page.text(title, type::kSmall, Weight::Medium, page.palette.ink));
}

}  // namespace

void menu_page(StaffFrame& page) {
  page.begin(page.staff.role == StaffRole::Operator ? page.tr("Operator") : page.tr("Technician"), nullptr);
  page.tree.open(scroller("menu", page.grown(page.box(Flow::Column, space::kXs))));
  status(page);
  // Where letters are large, a long word must not be torn: fewer and wider tiles.
  const std::size_t across = page.little_room() ? 2 : 4;
  std::array<const StaffPageInfo*, std::size_t(StaffPage::Count)> tiles{};
  std::size_t count = 0;
  const auto draw = [&] {
    page.in_full_rows(std::exchange(count, 0), across, space::kS,
                      [&](std::size_t i) { tile(page, *tiles[i]); });
  };
  const char* group = nullptr;
  for (const StaffPageInfo& info : staff_pages()) {
    if (info.group != nullptr) group = info.group;
    if (!may_open(page.staff.role, info)) continue;
    if (info.page == StaffPage::Recovery && !page.staff.access.words_due) continue;  // shown once
    if (const char* title = std::exchange(group, nullptr)) {
      draw();
      page.put({}, Role::Heading, page.tr(title), type::kSmall, Weight::Bold, page.palette.link);
    }
    tiles[count++] = &info;
  }
  draw();
  page.tree.close();
  page.end();
}

}  // namespace relievo::ui
