// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pages on which a PIN is typed: the way in, and choosing new ones.
#include <cstdio>

#include "ui/screens/service/pin_verbs.h"
#include "ui/screens/service/staff_screens.h"

namespace relievo::ui {
namespace {

// As many dots as digits: nobody behind reads them.
void dots(StaffFrame& page) {
  Node row = page.box(Flow::Row, 14);
  row.id = "typed";
  row.role = Role::Field;
  row.name = page.tr("Your PIN");
  row.box.along = page.portrait ? Along::Centre : page.mirrored() ? Along::End : Along::Start;  // as the words above it
  row.box.across = Across::Centre;
  row.box.left_to_right = true;
  row.box.height = page.px(36);
  page.tree.open(row);
  for (std::size_t i = 0; i < kMostPinDigits; ++i) {
    const bool typed = i < page.service.typed().size();
    Node dot = page.sized(page.box(Flow::Column), typed ? 20.0F : 12.0F, typed ? 20.0F : 12.0F);
    dot.box.radius = page.px(10);
    dot.box.fill = typed ? page.palette.accent : page.palette.quiet_border;
    page.tree.leaf(dot);
  }
  page.tree.close();
}

const char* state_words(StaffFrame& page, Mood& mood) {
  const AccessView& access = page.staff.access;
  mood = Mood::Bad;
  if (access.checking) {
    mood = Mood::Plain;
    return page.tr("One moment, please");
  }
  if (access.wait_s > 0) return nullptr;
  if (access.wrong) return page.tr("That was not right.");
  mood = Mood::Plain;
  return page.tr("Type your PIN, then touch the tick.");
}

}  // namespace

void pin_entry(StaffFrame& page, const char* title, std::string_view words, Mood mood, Action done) {
  Node room = page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kXl));
  room.box.across = Across::Centre;
  room.box.along = Along::Centre;
  page.tree.open(room);
  Node said = page.box(Flow::Column, space::kM);
  said.box.width = page.px(page.portrait ? 560.0F : 440.0F);
  page.tree.open(said);
  const TextAlign align = page.portrait ? TextAlign::Centre : TextAlign::Start;
  page.heading("pin title", title, type::kHeading, align);
  Node state = page.text(words, type::kBody, Weight::Regular, mood == Mood::Plain ? page.palette.ink_soft : page.ink_of(mood), align);
  state.id = "pin state";
  state.role = Role::Status;
  page.tree.leaf(state);
  dots(page);
  page.tree.close();
  page.keypad(done);
  page.tree.close();
}

void pin_page(StaffFrame& page) {
  page.begin(page.tr("Staff"), icon::kLock);
  const AccessView& access = page.staff.access;
  Mood mood = Mood::Plain;
  const char* state = state_words(page, mood);
  std::string_view words = state == nullptr ? std::string_view() : state;
  if (state == nullptr) {
    char text[16];
    std::snprintf(text, sizeof text, "%d", access.wait_s);
    words = page.filled(page.tr.plural("Too many wrong PINs. The next try is possible in {} second.", "Too many wrong PINs. The next try is possible in {} seconds.", static_cast<unsigned long>(access.wait_s)), text);
  }
  const bool ready = page.service.typed().size() >= kLeastPinDigits && !access.checking && access.wait_s == 0;
  pin_entry(page, page.tr("Technician or operator"), words, mood, ready ? Action{ActionKind::StaffDo, kPinCheck} : Action{});
  page.end();
}

}  // namespace relievo::ui
