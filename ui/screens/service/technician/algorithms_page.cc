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

void kinds(TechnicianFrame& f) {
  f.page.begin_panel("kinds");
  for (std::size_t i = 0; i < f.view.choice.kinds.size(); ++i) {
    const TechnicianKind& kind = f.view.choice.kinds[i];
    const bool chosen = i == f.view.choice.kind;
    Node row = f.page.box(Flow::Column, 2, 12, 8);
    tell(row, Role::Button, f.id("kind", i), label_of(f.tr, kind.key), technician_action(ChooseKind{i}));
    row.box.min_height = f.page.px(size::kStaffTarget);
    row.box.justify = Justify::Centre;
    row.box.radius = f.page.px(12);
    row.box.fill = chosen ? f.page.palette.accent : f.page.palette.card;
    const auto in_row = f.page.tree.inside(row);
    f.page.tree.leaf(f.page.text(label_of(f.tr, kind.key), type::kSmall, Weight::Medium,
                                 chosen ? f.page.palette.accent_ink : f.page.palette.ink));
    f.page.tree.leaf(f.page.text(f.left_to_right(f.breakable(kind.value)), 17, Weight::Regular,
                                 chosen ? f.page.palette.accent_ink : f.page.palette.ink_soft));
  }
  f.page.tree.close();
}

void names(TechnicianFrame& f) {
  const TechnicianChoice& choice = f.view.choice;
  const std::size_t across = f.page.text_share > 1.2F ? 2 : 3;
  for (std::size_t first = 0; first < choice.names.size(); first += across) {
    const auto in_box = f.page.tree.inside(f.page.box(Flow::Row, space::kXs));
    for (std::size_t i = first; i < first + across; ++i) {
      if (i >= choice.names.size()) f.page.space(1);
      else
        f.choice(f.id("name", i), f.left_to_right(choice.names[i].name), choice.names[i].chosen,
                 technician_action(ChooseName{i}));
    }
  }
}

void rejected(TechnicianFrame& f) {
  const TechnicianResult& r = f.view.result;
  f.page.section(f.tr("Figures"));
  f.page.row("accepted count", f.tr("Accepted matches"), f.page.number(double(r.accepted)));
  for (std::size_t i = 0; i < r.rule_count; ++i)
    f.page.row(f.id("rejected", i), f.left_to_right(r.rules[i].name),
               f.page.number(double(r.rules[i].rejected)));
}

// With the language's decimal mark, as it is typed.
std::string_view value_of(TechnicianFrame& f, const TechnicianOption& option) {
  return f.left_to_right(option.text ? option.value : f.page.as_number(option.value));
}

std::string_view as_typed(TechnicianFrame& f, std::string_view typed) {
  const char mark = info_of(f.tr.language()).decimal_mark;
  const std::string_view first = f.page.tree.keep({});
  std::size_t length = 0;
  for (const char c : typed) length += f.page.tree.keep({c == '.' ? &mark : &c, 1}).size();
  return f.left_to_right({first.data(), length});
}

void options(TechnicianFrame& f) {
  const TechnicianChoice& choice = f.view.choice;
  names(f);
  f.page.begin_panel("options");
  Node said = f.page.english(choice.kinds[choice.kind].sentence, 17);
  said.box.pad_y = f.page.px(6);
  f.page.tree.leaf(said);
  for (std::size_t i = 0; i < choice.options.size(); ++i) {
    const TechnicianOption& option = choice.options[i];
    const Action action = option.text ? Action{} : technician_action(EditOption{i});
    f.page.row(f.id("option", i), f.left_to_right(option.key), value_of(f, option),
               option.changed ? Mood::Warn : Mood::Plain, action);
  }
  if (choice.kinds[choice.kind].several && f.view.result.there) rejected(f);
  f.page.tree.close();
}

void key(TechnicianFrame& f, std::string_view id, const char* letter, Action action) {
  Node node = f.page.text(letter, type::kHeading, Weight::Medium, f.page.palette.link, TextAlign::Centre);
  tell(node, Role::Key, id, letter, action);
  node.box.grow = 1;
  node.box.min_height =
      f.page.px(f.page.portrait ? 1.4F * size::kStaffTarget : size::kStaffTarget);  // upright there is room
  frame(node, f.page.palette.card, f.page.palette.card_border, f.page.px(1.5F), f.page.px(14));
  f.page.tree.leaf(node);
}

void keys(TechnicianFrame& f) {
  constexpr const char* kKeys[4][4] = {
      {"1", "2", "3", "."}, {"4", "5", "6", "-"}, {"7", "8", "9", "e"}, {"0", nullptr, nullptr, nullptr}};
  const char* const decimal_mark = info_of(f.tr.language()).decimal_mark == ',' ? "," : ".";
  for (const auto& line : kKeys) {
    Node row = f.page.box(Flow::Row, 8);
    row.box.left_to_right = row.box.grid = true;
    const auto in_row = f.page.tree.inside(row);
    for (const char* letter : line) {
      if (letter == nullptr) continue;
      key(f, f.id("type", std::size_t(*letter)), *letter == '.' ? decimal_mark : letter,
          technician_action(TypeDigit{*letter}));
    }
    if (*line[0] == '0') {
      Node erase = f.page.grown(f.page.box(Flow::Row), 3);
      tell(erase, Role::Key, "type erase", f.tr("Erase"), technician_action(TechnicianAct::EraseDigit));
      centre(erase);
      frame(erase, f.page.palette.card, f.page.palette.card_border, f.page.px(1.5F), f.page.px(14));
      const auto in_erase = f.page.tree.inside(erase);
      f.page.sign(icon::kErase, 26, f.page.palette.link);
    }
  }
}

void editor(TechnicianFrame& f) {
  const TechnicianOption& option = *f.view.choice.edited;
  Node words = f.page.grown(f.page.box(Flow::Column, 6));
  words.id = "option words";
  words.box.scroll = true;
  f.page.tree.open(words);
  f.page.tree.leaf(f.page.text(f.left_to_right(option.key), type::kBody, Weight::Bold, f.page.palette.ink));
  if (!f.view.choice.refused.empty()) {
    Node no = f.page.text(f.tr("This cannot be accepted."), type::kSmall, Weight::Bold, f.page.palette.bad);
    no.id = "option refused";
    no.role = Role::Status;
    f.page.tree.leaf(no);
  }
  f.page.tree.leaf(f.page.english(option.sentence, type::kSmall));
  char text[96];
  std::snprintf(text, sizeof text, "%g … %g", option.least, option.most);
  f.page.row("option range", f.tr("Possible values"), f.left_to_right(f.page.with_numbers(text)));
  f.page.row("option value", f.tr("Now"), value_of(f, option));
  f.page.tree.close();
  Node field =
      f.page.text(f.view.choice.typed.empty() ? std::string_view("_") : as_typed(f, f.view.choice.typed),
                  type::kHeading, Weight::Bold, f.page.palette.ink, TextAlign::Centre);
  tell(field, Role::Field, "option typed", f.tr("Typed"));
  frame(field, f.page.palette.card, f.page.palette.accent, f.page.px(2), f.page.px(14));
  field.box.min_height = f.page.px(52);
  f.page.tree.leaf(field);
  keys(f);
  const bool stacked = f.page.portrait && f.page.text_share > 1.3F;
  const auto in_box = f.page.tree.inside(f.page.box(stacked ? Flow::Column : Flow::Row, space::kXs));
  f.page.small_button("option leave", f.tr("Cancel"), nullptr, ButtonLook::Quiet,
                      technician_action(TechnicianAct::LeaveOption), stacked ? 0.0F : 1.0F);
  f.page.small_button("option default", f.tr("Default"), nullptr, ButtonLook::Quiet,
                      technician_action(TechnicianAct::UseDefault), stacked ? 0.0F : 1.0F);
  f.page.small_button("option use", f.tr("Done"), icon::kCheck, ButtonLook::Main,
                      technician_action(TechnicianAct::UseTyped), stacked ? 0.0F : 1.0F);
}

void status(TechnicianFrame& f) {
  if (!f.view.calibrated)
    return f.page.status("uncalibrated", f.tr("This device is not calibrated yet"), Mood::Warn);
  f.problem(f.view.problem);
  const bool running = f.view.phase == TechnicianPhase::Capturing || f.view.phase == TechnicianPhase::Running;
  if (running)
    return f.page.progress("run progress", f.view.phase == TechnicianPhase::Running
                                               ? (float(f.view.working_on) + f.view.progress) / kStages
                                               : 0);
  if (f.view.applied) f.page.status("applied", f.tr("It applies from now on."), Mood::Good);
}

}  // namespace

void technician_algorithms_page(StaffFrame& page) {
  if (page.staff.technician == nullptr || page.staff.technician->choice.kinds.empty()) return;
  TechnicianFrame f(page);
  status(f);
  const bool editing = f.view.choice.edited != nullptr;
  page.tree.open(page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
  // Large letters leave room for one of the two while an option is edited.
  if (!editing || !(page.portrait || page.text_share > 1.2F)) {
    const auto in_box = page.tree.inside(page.grown(page.box(Flow::Column)));
    kinds(f);
  }
  page.tree.open(page.grown(page.box(Flow::Column, space::kXs), page.portrait ? 1.2F : 1.7F));
  if (editing) editor(f);
  else options(f);
  page.tree.close();
  page.tree.close();
  if (editing) return;
  const float grow = f.open_buttons();
  page.small_button("reset", f.tr("All as delivered"), nullptr, ButtonLook::Quiet,
                    technician_action(TechnicianAct::ResetSet), grow);
  if (f.view.calibrated)
    page.small_button("apply", f.tr("Use for visitors"), nullptr, ButtonLook::Quiet,
                      technician_action(TechnicianAct::ApplySet), grow);
  page.tree.close();
  f.capture_buttons(true);
}

}  // namespace relievo::ui
