// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffFrame's words: numbers and dates as the language writes them, and what the engine reports.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>

#include "ui/screens/service/staff_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

constexpr std::size_t kMostWords = 16, kGroup = 3, kLeastGrouped = 5;
constexpr std::string_view kMinus = "\u2212";
// Stands at its number, as no other unit does (ISO 80000-1), °C neither.
constexpr std::string_view kAngle = "°";
constexpr std::string_view kBetweenGroups = "\u202f";  // narrow, and no line ends there: ISO 80000-1

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// How many digits stand at the beginning.
std::size_t digits(std::string_view text) {
  return std::size_t(std::ranges::find_if_not(text, is_digit) - text.begin());
}

// "2026-03-14…"
bool begins_with_date(std::string_view text) {
  constexpr std::string_view kShape = "dddd-dd-dd";
  if (text.size() < kShape.size()) return false;
  for (std::size_t i = 0; i < kShape.size(); ++i) {
    if (kShape[i] == 'd' ? !is_digit(text[i]) : text[i] != kShape[i]) return false;
  }
  return true;
}

}  // namespace

std::string_view StaffFrame::written(double value, int decimals, const char* unit_name) {
  char figures[48];
  std::snprintf(figures, sizeof figures, "%.*f", decimals, value);
  const std::string_view text = figures;
  const std::size_t sign = text.starts_with('-') ? 1 : 0, whole = digits(text.substr(sign));
  const std::size_t from = tree.kept();
  tree.keep(isolate::kLeft);
  if (sign > 0) tree.keep(kMinus);
  for (std::size_t i = 0; i < whole; ++i) {
    if (i > 0 && whole >= kLeastGrouped && (whole - i) % kGroup == 0) tree.keep(kBetweenGroups);
    tree.keep(text.substr(sign + i, 1));
  }
  if (decimals > 0 && sign + whole < text.size()) {
    tree.keep({&info_of(visit.language).decimal_mark, 1});
    tree.keep(text.substr(sign + whole + 1));
  }
  if (*unit_name != 0 && unit_name != kAngle) tree.keep("\u00a0");
  tree.keep(unit_name);
  tree.keep(isolate::kEnd);
  return tree.kept_since(from);
}

std::string_view StaffFrame::as_number(std::string_view text) {
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0,
                    whole = digits(text.substr(sign));
  const std::size_t point = sign + whole, rest = point + 1;
  if (whole == 0 || point >= text.size() || text[point] != '.') return text;
  std::size_t behind = rest + digits(text.substr(rest));
  if (behind == rest) return text;
  if (behind < text.size() && text[behind] == 'e') {  // 2.5e-05
    const std::size_t power =
        behind + 1 +
        (behind + 1 < text.size() && (text[behind + 1] == '-' || text[behind + 1] == '+') ? 1 : 0);
    behind = power + digits(text.substr(std::min(power, text.size())));
  }
  if (behind < text.size() && text[behind] != ' ') return text;
  return left_to_right({text[0] == '-' ? kMinus : text.substr(0, sign),
                        text.substr(sign, whole),
                        {&info_of(visit.language).decimal_mark, 1},
                        text.substr(rest)});
}

std::string_view StaffFrame::with_numbers(std::string_view text) {
  if (text.find(' ') == std::string_view::npos) return as_number(text);
  std::array<std::string_view, kMostWords> words{};
  std::size_t count = 0;
  for (std::string_view rest = text; !rest.empty();) {
    if (count == words.size()) return text;
    const std::size_t end = std::min(rest.find(' '), rest.size());
    words[count++] = as_number(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  const std::size_t from = tree.kept();
  for (std::size_t i = 0; i < count; ++i) joined({i > 0 ? " " : "", words[i]});
  return tree.kept_since(from);
}

std::string_view StaffFrame::date(std::string_view iso) {
  if (!begins_with_date(iso)) return iso;
  const std::string_view shape = tr("%Y-%m-%d"), year = iso.substr(0, 4), month = iso.substr(5, 2),
                         day = iso.substr(8, 2);
  const std::size_t from = tree.kept();
  tree.keep(isolate::kLeft);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const char part = shape[i] == '%' && i + 1 < shape.size() ? shape[i + 1] : '\0';
    const std::string_view said = part == 'Y'   ? year
                                  : part == 'm' ? month
                                  : part == 'd' ? day
                                                : shape.substr(i, 1);
    if (part != '\0') ++i;
    tree.keep(said);
  }
  for (const char c : iso.substr(10))
    tree.keep(c == ' ' ? std::string_view("\u00a0") : std::string_view(&c, 1));
  tree.keep(isolate::kEnd);
  return tree.kept_since(from);
}

Node StaffFrame::english(std::string_view words, float size) const {
  Node node = text(left_to_right(words), size, Weight::Regular, palette.ink_soft);
  node.style.size_px = px(size * text_share);  // Latin letters are as large in every language
  node.style.language = info_of(Language::English).code;
  return node;
}

void StaffFrame::detail(std::string_view words) {
  due_rule();
  tree.leaf(english(words, 17));
}

std::string_view StaffFrame::noted(const LogLine& what) {
  if (what.code) return words_of(tr, *what.code);
  if (*what.event == LogEvent::SettingChanged) {
    if (const std::string_view change = said_change(*this, what.values[0], what.values[1]); !change.empty())
      return change;
  }
  const LogWords words = words_of(tr, *what.event);
  if (words.role != nullptr) return filled(words.pattern, words.role);
  return filled(words.pattern, {what.values[0], what.values[1]});
}

void StaffFrame::logged(const LogLine& what) {
  Node row = aligned(box(Flow::Row, space::kS, 0, 6), Align::Start);
  row.role = what.fault ? Role::Status : Role::Group;
  if (what.fault) row.name = tr("Fault");
  const auto in_row = tree.inside(row);
  // Columns: all times are as wide as each other, and the sign has its room where there is none.
  Node time = text(date(what.at), 18, Weight::Regular, palette.ink_soft);
  time.style.tabular = true;
  tree.leaf(time);
  tree.open(aligned(sized(box(Flow::Column), 24 * text_share, 0), Align::Centre));
  if (what.fault) sign(icon::kAlert, 18, ink_of(Mood::Warn));
  tree.close();
  const auto in_box = tree.inside(grown(box(Flow::Column)));
  if (what.code || what.event)
    write(noted(what), 18, Weight::Regular, ink_of(what.fault ? Mood::Warn : Mood::Plain));
  if (!what.event) tree.leaf(english(what.text, 17));
}

// StaffFrame's lists: rows of figures, of choices, and the lines between them.

constexpr float kUprightStretch = 1.8F;  // of rows on an upright screen, where there is room

void StaffFrame::begin_card(std::string_view id, bool fit_content) {
  Node list = scroller(id, grown(box(Flow::Column, 0, space::kM, 8)));
  card(list, size::kRadius);
  list.box.fit_content = fit_content;
  list.box.row_stretch = portrait ? kUprightStretch : 1;
  tree.open(list);
  rule_due_ = false;
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
  const bool touched = action.kind != ActionKind::None;
  Node row = row_box(space::kS, 0, 6);
  row.id = id;
  row.box.min_height = px(touched ? size::kStaffTarget : 44);
  if (touched) tell(row, Role::Button, id, label, action);
  tree.open(row);
  Node both = grown(row_box(space::kM));
  both.box.wrap = true;
  tree.open(both);
  wide(text(filled("{}", label), type::kSmall, Weight::Medium, palette.ink));
  if (!value.empty()) {
    const auto in_end = tree.inside(justified(row_box(space::kXs), Justify::End));
    if (const char* letter = sign_of(mood)) sign(letter, 24, ink_of(mood));
    write(filled("{}", value), type::kSmall, Weight::Regular,
          mood == Mood::Plain ? palette.ink_soft : ink_of(mood), TextAlign::End);
  }
  tree.close();
  if (touched) sign(onward(), 24, palette.link);
  tree.close();
  rule_due_ = true;
}

// Between two rows, not below the last: the card ends there.
void StaffFrame::due_rule() {
  if (rule_due_) rule();
  rule_due_ = false;
}

Node StaffFrame::line_box(float thick_dp, Colour colour) const {
  Node line = painted(box(Flow::Column), colour);
  line.box.height = std::max(1.0F, px(thick_dp));
  return line;
}

void StaffFrame::step_button(std::string_view id, const char* end, const char* spoken, std::string_view label,
                             const char* letter, Action action) {
  const bool dead = action.kind == ActionKind::None;
  Node node = centred(sized(box(Flow::Row), size::kStaffTarget, size::kStaffTarget));
  tell(node, dead ? Role::Group : Role::Button, joined({id, " ", end}), joined({label, ": ", spoken}),
       action);
  frame(node, dead ? Colour{} : palette.quiet, dead ? Colour{} : palette.quiet_border,
        dead ? 0 : std::max(1.5F, px(2)), px(18));
  const auto in_node = tree.inside(node);
  if (!dead) sign(letter, 30, palette.link);
}

void StaffFrame::stepper(std::string_view id, std::string_view label, std::string_view value, Action less,
                         Action more) {
  due_rule();
  Node row = row_box(space::kS, 0, 6);
  row.box.justify = Justify::Centre;  // of a wrapped one
  row.box.wrap = true;
  tree.open(row);
  wide(text(filled("{}", label), type::kSmall, Weight::Medium, palette.ink));
  tree.open(justified(row_box(space::kS), Justify::End));
  // Less, then more, as on every page that counts.
  tree.open(left_first(row_box(space::kS)));
  step_button(id, "less", tr("Less"), label, icon::kLess, less);
  Node middle = box(Flow::Column);
  middle.box.width = px(150 * std::min(1.3F, text_share));
  tree.open(middle);
  write(filled("{}", value), type::kSmall, Weight::Medium, palette.ink, TextAlign::Centre);
  tree.close();
  step_button(id, "more", tr("More"), label, icon::kMore, more);
  tree.close(3);
  rule_due_ = true;
}

void StaffFrame::nothing(std::string_view id, const char* letter, std::string_view words) {
  const auto in_room = tree.inside(centred(grown(box(Flow::Column, space::kS, space::kL, space::kL))));
  sign(letter, 64 / text_share, palette.track);
  body(id, words, TextAlign::Centre);
}

void StaffFrame::section(std::string_view words) {
  due_rule();
  tree.leaf(sized(box(Flow::Column), 1, 14));
  put({}, Role::Heading, words, type::kSmall, Weight::Bold, palette.link);
}

void StaffFrame::line(std::string_view words, Mood mood) {
  due_rule();
  // Apart from the page's direction: each runs as its own words do.
  Node said = text(filled("{}", words), 18, Weight::Regular, ink_of(mood));
  said.box.pad_y = px(4);
  tree.leaf(said);
}

}  // namespace relievo::ui
