// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/staff_frame.h"

#include <algorithm>
#include <array>
#include <string>

namespace relievo::ui {
namespace {

constexpr float kMargin = 32, kTop = 20;
constexpr const char* kLeaveSign = "\uf343";

struct SaidOutcome {
  const char* words;
  Mood mood = Mood::Bad;
};

// In the order of Outcome, behind None.
constexpr std::array kOutcomes{
    SaidOutcome{mark_tr("Done."), Mood::Good},
    SaidOutcome{mark_tr("Cancelled. Nothing was left half done."), Mood::Warn},
    SaidOutcome{mark_tr("There is no stick. Plug one in, then try again.")},
    SaidOutcome{mark_tr("There is no room left. Nothing was left half written.")},
    SaidOutcome{mark_tr("The stick was pulled out too early. Plug it in, then try again.")},
    SaidOutcome{mark_tr("The stick is write-protected. Please use another one.")},
    SaidOutcome{
        mark_tr("The stick does not keep what is written on it. Plug in another one and export again.")},
    SaidOutcome{
        mark_tr(
            "It is all there and read back, but the device cannot let go of the stick. Wait ten seconds, then pull it out."),
        Mood::Warn},
    SaidOutcome{
        mark_tr(
            "It is written and was read back, but the device cannot open the stick once more to be sure. You can pull it out; export again to another one."),
        Mood::Warn},
    SaidOutcome{mark_tr("It is no longer there.")},
    SaidOutcome{mark_tr("This cannot be accepted.")},
    SaidOutcome{mark_tr("It could not be done. The log says why.")},
};
static_assert(kOutcomes.size() == std::size_t(Outcome::Failed));

}  // namespace

Colour StaffFrame::ink_of(Mood mood) const {
  switch (mood) {
    case Mood::Good: return palette.good;
    case Mood::Warn: return palette.warn;
    case Mood::Bad: return palette.bad;
    case Mood::Plain: break;
  }
  return palette.ink;
}

const char* StaffFrame::sign_of(Mood mood) const {
  switch (mood) {
    case Mood::Good: return icon::kGood;
    case Mood::Warn: return icon::kInfo;
    case Mood::Bad: return icon::kAlert;
    case Mood::Plain: break;
  }
  return nullptr;
}

void StaffFrame::begin(const char* title, const char* letter) {
  open_page(box(Flow::Column, space::kS, kMargin, kTop));
  tree.open(row_box(space::kS));
  square_button("back", tr("Back"), backward(), {ActionKind::Back, 0});
  const auto name_page = [&] {
    const auto in_name = tree.inside(grown(row_box(space::kS)));
    if (letter != nullptr) sign(letter, 34 / text_share, palette.accent);
    const auto in_box = tree.inside(grown(box(Flow::Column)));
    if (staff.leaves_in_s > 0) leaving();
    else heading("title", title, portrait || text_share < 1.3F ? type::kHeading : type::kBody);
  };
  if (portrait) space(1);
  else name_page();
  reading_tools();
  square_button("sign out", tr("Sign out"), kLeaveSign, {ActionKind::StaffLeave, 0});
  tree.close();
  if (portrait) {
    Node row = box(Flow::Row);
    row.box.min_height =
        px(2 * type::kSmall * text_share) * type::kLines.apart;  // of what may stand in the title's place
    const auto in_row = tree.inside(row);
    name_page();
  }
}

// In the title's place: nothing on the page moves away from the finger that stays.
void StaffFrame::leaving() {
  const char* words = tr.plural("You are signed out in {} second. Touch the screen to stay.",
                                "You are signed out in {} seconds. Touch the screen to stay.",
                                static_cast<unsigned long>(staff.leaves_in_s));
  Node soon =
      text(filled(words, std::to_string(staff.leaves_in_s)), type::kSmall, Weight::Bold, palette.warn);
  soon.style.tabular = true;
  put("leaves", Role::Status, soon);
}

void StaffFrame::typed_field(std::string_view id, std::string_view asked) {
  Node field = row_box(3, 20, 8);
  tell(field, Role::Field, id, asked);
  frame(field, palette.card, palette.accent, px(3), px(18));
  field.box.min_height = px(56);
  const auto in_field = tree.inside(field);
  const std::string_view typed = service.typed();
  tree.leaf(text(typed.empty() ? asked : typed, type::kBody, Weight::Medium,
                 typed.empty() ? palette.ink_soft : palette.ink));
}

void StaffFrame::outcome(Outcome how) {
  if (how == Outcome::None) return;
  const SaidOutcome& said = kOutcomes[std::size_t(how) - 1];
  status("outcome", tr(said.words), said.mood);
}

void StaffFrame::status(std::string_view id, std::string_view words, Mood mood) {
  Node row = row_box(space::kS, 0, 4);
  tell(row, Role::Status, id, words);
  const auto in_row = tree.inside(row);
  if (const char* letter = sign_of(mood)) sign(letter, 28, ink_of(mood));
  wide(text(words, type::kSmall, Weight::Medium, ink_of(mood)));
}

void StaffFrame::grave_question(const char* title, const About& about, const char* words, const char* yes,
                                Action yes_action, const char* no, Action no_action) {
  const bool narrow = portrait || text_share > 1.3F;
  tree.open(grown(box(Flow::Row, space::kM)));
  if (!narrow) about.draw(*this);
  tree.open(scroller("question", justified(grown(box(Flow::Column, space::kM)), Justify::Centre)));
  heading("question title", title, type::kHeading);
  heading("question about", filled("{}", about.name), type::kBody);
  body("question code", filled("{}", about.code));
  body("question words", words);
  Node how = text(
      tr("Hold the button for three seconds; let go sooner and nothing happens. With keys: press once and wait; any other key calls it back."),
      type::kSmall, Weight::Medium, palette.ink);
  how.id = "question hint";
  tree.leaf(how);
  tree.close();
  tree.close();
  const auto in_row = tree.inside(box(narrow ? Flow::Column : Flow::Row, space::kS));
  button("no", no, nullptr, ButtonLook::Main, no_action, narrow ? 0 : 1);
  held_button("yes", yes, yes_action, narrow ? 0 : 1);
}

// As wide and high as the button beside it, in the colour of what is bad; the bar that fills is as dark as
// its letters.
void StaffFrame::held_button(std::string_view id, std::string_view label, Action action, float grow) {
  constexpr ButtonSize kSize = size::kMainButton;
  Node node = centred(box(Flow::Row, kSize.gap, text_share > 1.3F ? 14 : kSize.pad_x, kSize.pad_y));
  tell(node, Role::Button, id, label, action);
  node.hold = node.slow_key = true;
  frame(node, palette.quiet, palette.bad, std::max(2.0F, px(3)), px(kSize.radius));
  node.filling = palette.bad;
  node.box.grow = grow;
  node.box.min_height = px(kSize.height);
  const auto in_node = tree.inside(node);
  sign(icon::kBin, kSize.sign, palette.bad);
  tree.leaf(text(label, kSize.text, Weight::Medium, palette.bad, TextAlign::Centre));
}

}  // namespace relievo::ui
