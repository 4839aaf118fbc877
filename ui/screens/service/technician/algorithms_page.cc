// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every algorithm of every stage: chosen, its options edited and checked, rules switched; and what they make
// of the test capture. Names of algorithms and options, and what they say of themselves, are those of the
// command line in every language.
#include <cstdio>

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

const char* label_of(const Words& tr, std::string_view kind) {
  if (kind == "preprocessor") return tr("Preparation of the pictures");
  if (kind == "selector") return tr("Places to be matched");
  if (kind == "matcher") return tr("Matching");
  if (kind == "constraints") return tr("Rules for matches");
  if (kind == "triangulator") return tr("Points in space");
  if (kind == "outliers") return tr("Outliers");
  if (kind == "mesher") return tr("Surface");
  if (kind == "completion") return tr("Completion");
  if (kind == "relief") return tr("Check against pictures");
  return tr("Texture");
}

void kinds(TechnicianFrame& b) {
  b.page.begin_panel("kinds");
  for (std::size_t i = 0; i < b.view.choice.kinds.size(); ++i) {
    const TechnicianKind& kind = b.view.choice.kinds[i];
    const bool chosen = i == b.view.choice.kind;
    Node row = b.page.box(Flow::Column, 2, 12, 8);
    row.id = b.id("kind", i);
    row.name = label_of(b.tr, kind.key);
    row.role = Role::Button;
    row.action = technician_action(TechnicianAct::ChooseKind, static_cast<std::int32_t>(i));
    row.box.min_height = b.page.px(size::kStaffTarget);
    row.box.justify = Justify::Centre;
    row.box.radius = b.page.px(12);
    row.box.fill = chosen ? b.page.palette.accent : b.page.palette.card;
    b.page.tree.open(row);
    b.page.tree.leaf(b.page.text(label_of(b.tr, kind.key), type::kSmall, Weight::Medium,
                                 chosen ? b.page.palette.accent_ink : b.page.palette.ink));
    b.page.tree.leaf(b.page.text(b.left_to_right(b.breakable(kind.value)), 17, Weight::Regular,
                                 chosen ? b.page.palette.accent_ink : b.page.palette.ink_soft));
    b.page.tree.close();
  }
  b.page.tree.close();
}

void names(TechnicianFrame& b) {
  const TechnicianChoice& choice = b.view.choice;
  const std::size_t across = b.page.text_share > 1.2F ? 2 : 3;
  for (std::size_t first = 0; first < choice.names.size(); first += across) {
    b.page.tree.open(b.page.box(Flow::Row, space::kXs));
    for (std::size_t i = first; i < first + across; ++i) {
      if (i >= choice.names.size()) b.page.space(1);
      else
        b.choice(b.id("name", i), b.left_to_right(choice.names[i].name), choice.names[i].chosen,
                 technician_action(TechnicianAct::ChooseName, static_cast<std::int32_t>(i)));
    }
    b.page.tree.close();
  }
}

void rejected(TechnicianFrame& b) {
  const TechnicianResult& r = b.view.result;
  b.page.section(b.tr("In the last calculation"));
  b.page.row("accepted count", b.tr("Accepted matches"), b.page.number(static_cast<double>(r.accepted)));
  for (std::size_t i = 0; i < r.rule_count; ++i)
    b.page.row(b.id("rejected", i), b.left_to_right(r.rules[i].name),
               b.page.number(static_cast<double>(r.rules[i].rejected)));
}

// With the language's decimal mark, as it is typed.
std::string_view value_of(TechnicianFrame& b, const TechnicianOption& option) {
  return b.left_to_right(option.text ? option.value : b.page.as_number(option.value));
}

std::string_view as_typed(TechnicianFrame& b, std::string_view typed) {
  const char mark = info_of(b.tr.language()).decimal_mark;
  const std::string_view first = b.page.tree.keep({});
  std::size_t length = 0;
  for (const char c : typed) length += b.page.tree.keep({c == '.' ? &mark : &c, 1}).size();
  return b.left_to_right({first.data(), length});
}

void options(TechnicianFrame& b) {
  const TechnicianChoice& choice = b.view.choice;
  names(b);
  b.page.begin_panel("options");
  Node said = b.page.english(choice.kinds[choice.kind].sentence, 17);
  said.box.pad_y = b.page.px(6);
  b.page.tree.leaf(said);
  for (std::size_t i = 0; i < choice.options.size(); ++i) {
    const TechnicianOption& option = choice.options[i];
    const Action action =
        option.text ? Action{} : technician_action(TechnicianAct::EditOption, static_cast<std::int32_t>(i));
    b.page.row(b.id("option", i), b.left_to_right(option.key), value_of(b, option),
               option.changed ? Mood::Warn : Mood::Plain, action);
  }
  if (choice.kinds[choice.kind].several && b.view.result.there) rejected(b);
  b.page.tree.close();
}

void key(TechnicianFrame& b, std::string_view id, const char* letter, Action action) {
  Node node = b.page.text(letter, type::kHeading, Weight::Medium, b.page.palette.link, TextAlign::Centre);
  node.id = id;
  node.name = letter;
  node.role = Role::Key;
  node.action = action;
  node.box.grow = 1;
  node.box.min_height =
      b.page.px(b.page.portrait ? 1.4F * size::kStaffTarget : size::kStaffTarget);  // upright there is room
  node.box.fill = b.page.palette.card;
  node.box.border = b.page.palette.card_border;
  node.box.border_px = b.page.px(1.5F);
  node.box.radius = b.page.px(14);
  b.page.tree.leaf(node);
}

void keys(TechnicianFrame& b) {
  constexpr const char* kKeys[4][4] = {
      {"1", "2", "3", "."}, {"4", "5", "6", "-"}, {"7", "8", "9", "e"}, {"0", nullptr, nullptr, nullptr}};
  const char* const decimal_mark = info_of(b.tr.language()).decimal_mark == ',' ? "," : ".";
  for (const auto& line : kKeys) {
    Node row = b.page.box(Flow::Row, 8);
    row.box.left_to_right = row.box.grid = true;
    b.page.tree.open(row);
    for (const char* letter : line) {
      if (letter == nullptr) continue;
      key(b, b.id("type", static_cast<std::size_t>(*letter)), *letter == '.' ? decimal_mark : letter,
          technician_action(TechnicianAct::TypeDigit, *letter));
    }
    if (*line[0] == '0') {
      Node erase = b.page.grown(b.page.box(Flow::Row), 3);
      erase.id = "type erase";
      erase.name = b.tr("Erase");
      erase.role = Role::Key;
      erase.action = technician_action(TechnicianAct::EraseDigit);
      erase.box.justify = Justify::Centre;
      erase.box.align = Align::Centre;
      erase.box.fill = b.page.palette.card;
      erase.box.border = b.page.palette.card_border;
      erase.box.border_px = b.page.px(1.5F);
      erase.box.radius = b.page.px(14);
      b.page.tree.open(erase);
      b.page.sign(icon::kErase, 26, b.page.palette.link);
      b.page.tree.close();
    }
    b.page.tree.close();
  }
}

void editor(TechnicianFrame& b) {
  const TechnicianOption& option = *b.view.choice.edited;
  Node words = b.page.grown(b.page.box(Flow::Column, 6));
  words.id = "option words";
  words.box.scroll = true;
  b.page.tree.open(words);
  b.page.tree.leaf(b.page.text(b.left_to_right(option.key), type::kBody, Weight::Bold, b.page.palette.ink));
  if (!b.view.choice.refused.empty()) {
    Node no =
        b.page.text(b.tr("This value is not possible."), type::kSmall, Weight::Bold, b.page.palette.bad);
    no.id = "option refused";
    no.role = Role::Status;
    b.page.tree.leaf(no);
  }
  b.page.tree.leaf(b.page.english(option.sentence, type::kSmall));
  char text[96];
  std::snprintf(text, sizeof text, "%g … %g", option.least, option.most);
  b.page.row("option range", b.tr("Possible values"), b.left_to_right(b.page.with_numbers(text)));
  b.page.row("option value", b.tr("Now"), value_of(b, option));
  b.page.tree.close();
  Node field =
      b.page.text(b.view.choice.typed.empty() ? std::string_view("_") : as_typed(b, b.view.choice.typed),
                  type::kHeading, Weight::Bold, b.page.palette.ink, TextAlign::Centre);
  field.id = "option typed";
  field.role = Role::Field;
  field.name = b.tr("New value");
  field.box.min_height = b.page.px(52);
  field.box.fill = b.page.palette.card;
  field.box.border = b.page.palette.accent;
  field.box.border_px = b.page.px(2);
  field.box.radius = b.page.px(14);
  b.page.tree.leaf(field);
  keys(b);
  const bool stacked = b.page.portrait && b.page.text_share > 1.3F;
  b.page.tree.open(b.page.box(stacked ? Flow::Column : Flow::Row, space::kXs));
  b.page.small_button("option leave", b.tr("Cancel"), nullptr, ButtonLook::Quiet,
                      technician_action(TechnicianAct::LeaveOption), stacked ? 0.0F : 1.0F);
  b.page.small_button("option default", b.tr("Default"), nullptr, ButtonLook::Quiet,
                      technician_action(TechnicianAct::UseDefault), stacked ? 0.0F : 1.0F);
  b.page.small_button("option use", b.tr("Use it"), icon::kCheck, ButtonLook::Main,
                      technician_action(TechnicianAct::UseTyped), stacked ? 0.0F : 1.0F);
  b.page.tree.close();
}

void status(TechnicianFrame& b) {
  if (!b.view.calibrated)
    return b.page.status("uncalibrated", b.tr("This device is not calibrated yet"), Mood::Warn);
  b.problem(b.view.problem);
  const bool running = b.view.phase == TechnicianPhase::Capturing || b.view.phase == TechnicianPhase::Running;
  if (running)
    return b.page.progress("run progress",
                           b.view.phase == TechnicianPhase::Running
                               ? (static_cast<float>(b.view.working_on) + b.view.progress) / kStages
                               : 0);
  if (b.view.applied)
    b.page.status("applied", b.tr("Visitors are measured with these algorithms now."), Mood::Good);
}

}  // namespace

void technician_algorithms_page(StaffFrame& page) {
  if (page.staff.technician == nullptr || page.staff.technician->choice.kinds.empty()) return;
  TechnicianFrame b(page);
  status(b);
  const bool editing = b.view.choice.edited != nullptr;
  page.tree.open(page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
  // Large letters leave room for one of the two while an option is edited.
  if (!editing || !(page.portrait || page.text_share > 1.2F)) {
    page.tree.open(page.grown(page.box(Flow::Column)));
    kinds(b);
    page.tree.close();
  }
  page.tree.open(page.grown(page.box(Flow::Column, space::kXs), page.portrait ? 1.2F : 1.7F));
  if (editing) editor(b);
  else options(b);
  page.tree.close();
  page.tree.close();
  if (editing) return;
  const float grow = b.open_buttons();
  page.small_button("reset", b.tr("All as delivered"), nullptr, ButtonLook::Quiet,
                    technician_action(TechnicianAct::ResetSet), grow);
  if (b.view.calibrated)
    page.small_button("apply", b.tr("Use for visitors"), nullptr, ButtonLook::Quiet,
                      technician_action(TechnicianAct::ApplySet), grow);
  page.tree.close();
  b.capture_buttons(true);
}

}  // namespace relievo::ui
