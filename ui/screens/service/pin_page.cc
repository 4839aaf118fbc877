// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pages on which a PIN is typed: the way in, and choosing new ones.
#include <cstdio>

#include "ui/screens/service/pin_entry.h"
#include "ui/screens/service/staff_pages.h"

namespace relievo::ui {
namespace {

// As many dots as digits: nobody behind reads them.
void dots(StaffFrame& page) {
  Node row = page.box(Flow::Row, 14);
  tell(row, Role::Field, "typed", page.tr("Your PIN"));
  row.box.justify = page.portrait     ? Justify::Centre
                    : page.mirrored() ? Justify::End
                                      : Justify::Start;  // as the words above it
  row.box.align = Align::Centre;
  row.box.left_to_right = true;
  row.box.height = page.px(36);
  page.tree.open(row);
  for (std::size_t i = 0; i < kMostPinDigits; ++i) {
    const bool typed = i < page.service.typed().size();
    Node dot = page.sized(page.box(Flow::Column), typed ? 20.0F : 12.0F, typed ? 20.0F : 12.0F);
    dot.box.radius = page.px(10);
    dot.box.fill = typed ? page.palette.accent : page.palette.track;
    page.tree.leaf(dot);
  }
  page.tree.close();
}

void told(StaffFrame& page, std::string_view id, std::string_view words, Mood mood) {
  Node node = page.text(words, type::kBody, Weight::Regular,
                        mood == Mood::Plain ? page.palette.ink_soft : page.ink_of(mood),
                        page.portrait ? TextAlign::Centre : TextAlign::Start);
  node.id = id;
  node.role = Role::Status;
  page.tree.leaf(node);
}

PinWords words_of(StaffFrame& page) {
  const AccessView& access = page.staff.access;
  if (access.checking) return {page.tr("One moment, please"), {}, Mood::Plain};
  if (access.wait_s > 0) {
    char text[16];
    std::snprintf(text, sizeof text, "%d", access.wait_s);
    const char* words = page.tr.plural("Too many wrong PINs. The next try is possible in {} second.",
                                       "Too many wrong PINs. The next try is possible in {} seconds.",
                                       static_cast<unsigned long>(access.wait_s));
    return {nullptr, page.filled(words, text), Mood::Bad};
  }
  return {page.tr("Type your PIN, then touch the tick."),
          access.wrong ? std::string_view(page.tr("That was not right.")) : std::string_view(), Mood::Bad};
}

}  // namespace

void pin_entry(StaffFrame& page, const char* title, const PinWords& words, Action done) {
  Node room = page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kXl));
  centre(room);
  page.tree.open(room);
  Node said = page.box(Flow::Column, space::kM);
  said.box.width = page.px(page.portrait ? 560.0F : 440.0F);
  page.tree.open(said);
  const TextAlign align = page.portrait ? TextAlign::Centre : TextAlign::Start;
  page.heading("pin title", title, type::kHeading, align);
  if (words.hint != nullptr) told(page, "pin hint", words.hint, Mood::Plain);
  if (!words.told.empty()) told(page, "pin state", words.told, words.mood);
  dots(page);
  page.tree.close();
  number_pad(page, {"digit ", "pin done"}, done);
  page.tree.close();
}

void pin_page(StaffFrame& page) {
  page.begin(page.tr("Staff"), icon::kLock);
  const AccessView& access = page.staff.access;
  const bool ready = page.service.typed().size() >= kLeastPinDigits && !access.checking && access.wait_s == 0;
  pin_entry(page, page.tr("Technician or operator"), words_of(page), ready ? Action(CheckPin{}) : Action{});
  page.end();
}

}  // namespace relievo::ui
