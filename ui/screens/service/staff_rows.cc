// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffFrame's lists: rows of figures, of choices, and the lines between them.
#include <algorithm>
#include <charconv>

#include "ui/screens/service/staff_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {

constexpr float kUprightStretch = 1.8F;  // of rows on an upright screen, where there is room

void StaffFrame::begin_card(std::string_view id, bool fit_content) {
  Node list = grown(box(Flow::Column, 0, space::kM, 8));
  frame(list, palette.card, palette.card_border, px(1.5F), px(size::kRadius));
  list.id = id;
  list.box.scroll = true;
  list.box.fit_content = fit_content;
  list.box.row_stretch = portrait ? kUprightStretch : 1;
  tree.open(list);
  rule_due_ = false;
}

std::string_view StaffFrame::joined(std::initializer_list<std::string_view> parts) const {
  const std::string_view first = tree.keep({});
  std::size_t length = 0;
  for (const std::string_view part : parts) length += tree.keep(part).size();
  return {first.data(), length};
}

std::string_view StaffFrame::left_to_right(std::initializer_list<std::string_view> parts) const {
  const std::string_view first = tree.keep(isolate::kLeft), middle = joined(parts);
  return {first.data(), first.size() + middle.size() + tree.keep(isolate::kEnd).size()};
}

std::string_view StaffFrame::id(std::string_view what, std::size_t number) const {
  char digits[20];
  const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  return joined({what, " ", {digits, end}});
}

// Beside each other where both have room; else the value under its label, at the same end.
void StaffFrame::row(std::string_view id, std::string_view label, std::string_view value, Mood mood,
                     Action action) {
  due_rule();
  Node row = box(Flow::Row, space::kS, 0, 6);
  row.id = id;
  row.box.align = Align::Centre;
  row.box.min_height = px(action.kind == ActionKind::None ? 44 : size::kStaffTarget);
  if (action.kind != ActionKind::None) {
    row.role = Role::Button;
    row.name = label;
    row.action = action;
  }
  tree.open(row);
  Node both = grown(box(Flow::Row, space::kM));
  both.box.align = Align::Centre;
  both.box.wrap = true;
  tree.open(both);
  tree.open(grown(box(Flow::Column)));
  tree.leaf(text(filled("{}", label), type::kSmall, Weight::Medium, palette.ink));
  tree.close();
  if (!value.empty()) {
    Node end = box(Flow::Row, space::kXs);
    end.box.justify = Justify::End;
    end.box.align = Align::Centre;
    const auto in_end = tree.inside(end);
    if (const char* letter = sign_of(mood)) sign(letter, 24, ink_of(mood));
    tree.leaf(text(filled("{}", value), type::kSmall, Weight::Regular,
                   mood == Mood::Plain ? palette.ink_soft : ink_of(mood), TextAlign::End));
  }
  tree.close();
  if (action.kind != ActionKind::None) sign(onward(), 24, palette.link);
  tree.close();
  rule_due_ = true;
}

// Between two rows, not below the last: the card ends there.
void StaffFrame::due_rule() {
  if (rule_due_) rule();
  rule_due_ = false;
}

void StaffFrame::rule() {
  Node line = box(Flow::Column);
  line.box.height = std::max(1.0F, px(1));
  line.box.fill = palette.card_border;
  tree.leaf(line);
}

void StaffFrame::step_button(std::string_view id, const char* end, const char* spoken, std::string_view label,
                             const char* letter, Action action) {
  const bool dead = action.kind == ActionKind::None;
  Node node = sized(box(Flow::Row), size::kStaffTarget, size::kStaffTarget);
  tell(node, dead ? Role::Group : Role::Button, joined({id, " ", end}), joined({label, ": ", spoken}),
       action);
  centre(node);
  frame(node, dead ? Colour{} : palette.quiet, dead ? Colour{} : palette.quiet_border,
        dead ? 0 : std::max(1.5F, px(2)), px(18));
  const auto in_node = tree.inside(node);
  if (!dead) sign(letter, 30, palette.link);
}

void StaffFrame::stepper(std::string_view id, std::string_view label, std::string_view value,
                         const char* less_letter, Action less, const char* more_letter, Action more) {
  due_rule();
  Node row = box(Flow::Row, space::kS, 0, 6);
  row.box.align = Align::Centre;
  row.box.justify = Justify::Centre;  // of a wrapped one
  row.box.wrap = true;
  tree.open(row);
  tree.open(grown(box(Flow::Column)));
  tree.leaf(text(filled("{}", label), type::kSmall, Weight::Medium, palette.ink));
  tree.close();
  Node end = box(Flow::Row, space::kS);
  end.box.align = Align::Centre;
  end.box.justify = Justify::End;
  tree.open(end);
  Node scale = box(Flow::Row, space::kS);
  scale.box.align = Align::Centre;
  scale.box.left_to_right = true;  // less, then more, as on every page that counts
  tree.open(scale);
  step_button(id, "less", tr("Less"), label, less_letter, less);
  Node middle = box(Flow::Column);
  middle.box.width = px(150 * std::min(1.3F, text_share));
  tree.open(middle);
  tree.leaf(text(filled("{}", value), type::kSmall, Weight::Medium, palette.ink, TextAlign::Centre));
  tree.close();
  step_button(id, "more", tr("More"), label, more_letter, more);
  tree.close();
  tree.close();
  tree.close();
  rule_due_ = true;
}

void StaffFrame::plot(const Plot& what) {
  due_rule();
  ui::plot(*this, what, [](Page& page, double value, int decimals, const char* unit_name) {
    return static_cast<StaffFrame&>(page).number(value, decimals, unit_name);
  });
  rule_due_ = true;
}

void StaffFrame::nothing(std::string_view id, const char* letter, std::string_view words) {
  Node room = grown(box(Flow::Column, space::kS, space::kL, space::kL));
  centre(room);
  const auto in_room = tree.inside(room);
  sign(letter, 64 / text_share, palette.track);
  Node said = text(words, type::kBody, Weight::Regular, palette.ink_soft, TextAlign::Centre);
  said.id = id;
  tree.leaf(said);
}

void StaffFrame::section(std::string_view words) {
  due_rule();
  tree.leaf(sized(box(Flow::Column), 1, 14));
  Node name = text(words, type::kSmall, Weight::Bold, palette.link);
  name.role = Role::Heading;
  tree.leaf(name);
}

void StaffFrame::line(std::string_view words, Mood mood) {
  due_rule();
  // Apart from the page's direction: each runs as its own words do.
  Node said = text(filled("{}", words), 18, Weight::Regular, ink_of(mood));
  said.box.pad_y = px(4);
  tree.leaf(said);
}

}  // namespace relievo::ui
