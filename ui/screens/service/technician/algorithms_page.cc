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
  f.begin_panel("kinds");
  for (std::size_t i = 0; i < f.seen.choice.kinds.size(); ++i) {
    const TechnicianKind& kind = f.seen.choice.kinds[i];
    const bool chosen = i == f.seen.choice.kind;
    const char* label = label_of(f.tr, kind.key);
    const Colour ink = chosen ? f.palette.accent_ink : f.palette.ink;
    Node row = f.painted(justified(f.box(Flow::Column, 2, 12, 8), Justify::Centre),
                         chosen ? f.palette.accent : f.palette.card, 12);
    tell(row, Role::Button, f.id("kind", i), label, ChooseKind{i});
    row.box.min_height = f.px(size::kStaffTarget);
    const auto in_row = f.tree.inside(row);
    f.write(label, type::kSmall, Weight::Medium, ink);
    f.write(f.left_to_right(f.breakable(kind.value)), 17, Weight::Regular,
            chosen ? f.palette.accent_ink : f.palette.ink_soft);
  }
  f.tree.close();
}

void names(TechnicianFrame& f) {
  const TechnicianChoice& choice = f.seen.choice;
  f.in_full_rows(choice.names.size(), f.large_words() ? 2 : 3, space::kXs, [&](std::size_t i) {
    f.choice(f.id("name", i), f.left_to_right(choice.names[i].name), choice.names[i].chosen, ChooseName{i});
  });
}

void rejected(TechnicianFrame& f) {
  const TechnicianResult& r = f.seen.result;
  f.section(f.tr("Figures"));
  f.row("accepted count", f.tr("Accepted matches"), f.number(r.accepted));
  for (std::size_t i = 0; i < r.rule_count; ++i)
    f.row(f.id("rejected", i), f.left_to_right(r.rules[i].name), f.number(r.rules[i].rejected));
}

// With the language's decimal mark, as it is typed.
std::string_view value_of(TechnicianFrame& f, const TechnicianOption& option) {
  return f.left_to_right(option.text ? option.value : f.as_number(option.value));
}

std::string_view as_typed(TechnicianFrame& f, std::string_view typed) {
  const char mark = info_of(f.tr.language()).decimal_mark;
  const std::size_t from = f.tree.kept();
  for (const char c : typed) f.tree.keep({c == '.' ? &mark : &c, 1});
  return f.left_to_right(f.tree.kept_since(from));
}

void options(TechnicianFrame& f) {
  const TechnicianChoice& choice = f.seen.choice;
  names(f);
  f.begin_panel("options");
  Node said = f.english(choice.kinds[choice.kind].sentence, 17);
  said.box.pad_y = f.px(6);
  f.tree.leaf(said);
  for (std::size_t i = 0; i < choice.options.size(); ++i) {
    const TechnicianOption& option = choice.options[i];
    const Action action = option.text ? Action{} : EditOption{i};
    f.row(f.id("option", i), f.left_to_right(option.key), value_of(f, option),
          option.changed ? Mood::Warn : Mood::Plain, action);
  }
  if (choice.kinds[choice.kind].several && f.seen.result.there) rejected(f);
  f.tree.close();
}

void key(TechnicianFrame& f, std::string_view id, const char* letter, Action action) {
  Node node = f.text(letter, type::kHeading, Weight::Medium, f.palette.link, TextAlign::Centre);
  tell(node, Role::Key, id, letter, action);
  node.box.grow = 1;
  node.box.min_height =
      f.px(f.portrait ? 1.4F * size::kStaffTarget : size::kStaffTarget);  // upright there is room
  f.card(node, 14);
  f.tree.leaf(node);
}

void keys(TechnicianFrame& f) {
  constexpr const char* kKeys[4][4] = {
      {"1", "2", "3", "."}, {"4", "5", "6", "-"}, {"7", "8", "9", "e"}, {"0", nullptr, nullptr, nullptr}};
  const char* const decimal_mark = info_of(f.tr.language()).decimal_mark == ',' ? "," : ".";
  for (const auto& line : kKeys) {
    Node row = f.box(Flow::Row, 8);
    row.box.left_to_right = row.box.grid = true;
    const auto in_row = f.tree.inside(row);
    for (const char* letter : line) {
      if (letter == nullptr) continue;
      key(f, f.id("type", std::size_t(*letter)), *letter == '.' ? decimal_mark : letter, TypeDigit{*letter});
    }
    if (*line[0] == '0') {
      Node erase = centred(f.grown(f.box(Flow::Row), 3));
      tell(erase, Role::Key, "type erase", f.tr("Erase"), TechnicianAct::EraseDigit);
      f.card(erase, 14);
      const auto in_erase = f.tree.inside(erase);
      f.sign(icon::kErase, 26, f.palette.link);
    }
  }
}

void editor(TechnicianFrame& f) {
  const TechnicianOption& option = *f.seen.choice.edited;
  f.tree.open(scroller("option words", f.grown(f.box(Flow::Column, 6))));
  f.write(f.left_to_right(option.key), type::kBody, Weight::Bold, f.palette.ink);
  if (!f.seen.choice.refused.empty())
    f.put("option refused", Role::Status, f.tr("This cannot be accepted."), type::kSmall, Weight::Bold,
          f.palette.bad);
  f.tree.leaf(f.english(option.sentence, type::kSmall));
  char text[96];
  std::snprintf(text, sizeof text, "%.10g … %.10g", option.least, option.most);
  f.row("option range", f.tr("Possible values"), f.left_to_right(f.with_numbers(text)));
  f.row("option value", f.tr("Now"), value_of(f, option));
  f.tree.close();
  Node field = f.text(f.seen.choice.typed.empty() ? std::string_view("_") : as_typed(f, f.seen.choice.typed),
                      type::kHeading, Weight::Bold, f.palette.ink, TextAlign::Centre);
  tell(field, Role::Field, "option typed", f.tr("Typed"));
  field.by_key = TechnicianAct::UseTyped;
  frame(field, f.palette.card, f.palette.accent, f.px(2), f.px(14));
  field.box.min_height = f.px(52);
  f.tree.leaf(field);
  keys(f);
  const bool stacked = f.portrait && f.text_share > 1.3F;
  const float grow = stacked ? 0 : 1;
  const auto in_box = f.tree.inside(f.box(stacked ? Flow::Column : Flow::Row, space::kXs));
  f.small_button("option leave", f.tr("Back"), nullptr, ButtonLook::Quiet, TechnicianAct::LeaveOption, grow);
  f.small_button("option default", f.tr("Default"), nullptr, ButtonLook::Quiet, TechnicianAct::UseDefault,
                 grow);
  f.small_button("option use", f.tr("Done"), icon::kCheck, ButtonLook::Main, TechnicianAct::UseTyped, grow);
}

void status(TechnicianFrame& f) {
  if (!f.seen.calibrated) return f.status("uncalibrated", f.tr("The cameras must be calibrated"), Mood::Warn);
  f.problem(f.seen.problem);
  if (f.busy()) f.progress("run progress", f.done());
  if (f.seen.applied) f.status("applied", f.tr("It applies from now on."), Mood::Good);
}

}  // namespace

void technician_algorithms_page(TechnicianFrame& f) {
  if (f.seen.choice.kinds.empty()) return;
  status(f);
  const bool editing = f.seen.choice.edited != nullptr;
  f.tree.open(f.grown(f.abreast_box(space::kM)));
  // Large letters leave room for one of the two while an option is edited.
  if (!editing || !f.little_room()) {
    const auto in_box = f.tree.inside(f.grown(f.box(Flow::Column)));
    kinds(f);
  }
  f.tree.open(f.grown(f.box(Flow::Column, space::kXs), f.portrait ? 1.2F : 1.7F));
  if (editing) editor(f);
  else options(f);
  f.tree.close(2);
  if (editing) return;
  const float grow = f.open_buttons();
  f.small_button("reset", f.tr("As at first"), nullptr, ButtonLook::Quiet, TechnicianAct::ResetSet, grow);
  if (f.seen.calibrated)
    f.small_button("apply", f.tr("Use for visitors"), nullptr, ButtonLook::Quiet, TechnicianAct::ApplySet,
                   grow);
  f.tree.close();
  f.capture_buttons(true);
}

}  // namespace relievo::ui
