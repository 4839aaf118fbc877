// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {
namespace {

constexpr float kMargin = 32, kTop = 20;
constexpr const char* kLeaveSign = "\uf343";

// In the order of Outcome, behind None.
constexpr std::array kOutcomes{
    Told{mark_tr("Done."), Mood::Good},
    Told{mark_tr("Cancelled. Nothing was left half done."), Mood::Warn},
    Told{mark_tr("No stick is ready. Plug one in, or pull this one out and plug it in again.")},
    Told{mark_tr("There is no room left. Nothing was left half written.")},
    Told{mark_tr("The stick was pulled out too early. Plug it in, then try again.")},
    Told{mark_tr("The stick is write-protected. Please use another one.")},
    Told{mark_tr("The stick does not keep what is written on it. Plug in another one and export again.")},
    Told{
        mark_tr(
            "It is all there and read back, but the device cannot let go of the stick. Wait ten seconds, then pull it out."),
        Mood::Warn},
    Told{
        mark_tr(
            "It is written and was read back, but the device cannot open the stick once more to be sure. You can pull it out; export again to another one."),
        Mood::Warn},
    Told{mark_tr("It is no longer there.")},
    Told{mark_tr("This cannot be accepted.")},
    Told{mark_tr("It could not be done. The log says why.")},
};
static_assert(kOutcomes.size() == std::size_t(Outcome::Failed));

}  // namespace

// In the order of Mood.
Colour StaffFrame::ink_of(Mood mood) const {
  const std::array inks{palette.ink, palette.good, palette.warn, palette.bad};
  static_assert(std::tuple_size_v<decltype(inks)> == std::size_t(Mood::Bad) + 1);
  return inks[std::size_t(mood)];
}

const char* StaffFrame::sign_of(Mood mood) const {
  constexpr std::array<const char*, std::size_t(Mood::Bad) + 1> kSigns{nullptr, icon::kGood, icon::kInfo,
                                                                       icon::kAlert};
  return kSigns[std::size_t(mood)];
}

void StaffFrame::begin(const char* title, const char* letter) {
  open_page(box(Flow::Column, space::kS, kMargin, kTop));
  tree.open(row_box(space::kS));
  square_button("back", tr("Back"), backward(), ActionKind::Back);
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
  square_button(kBarsEnd, tr("Sign out"), kLeaveSign, ActionKind::StaffLeave);
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
  const std::string_view words =
      plural_tr("You are signed out in {} second. Touch the screen to stay.",
                "You are signed out in {} seconds. Touch the screen to stay.", staff.leaves_in_s);
  Node soon = text(words, type::kSmall, Weight::Bold, palette.warn);
  soon.style.tabular = true;
  put("leaves", Role::Status, soon);
}

void StaffFrame::typed_field(std::string_view id, std::string_view asked, const Action& done) {
  const std::string_view typed = service.typed();
  Node field = row_box(3, 20, 8);
  tell(field, Role::Field, id, asked);
  field.value = typed;
  field.secret = true;
  field.by_key = done;
  frame(field, palette.card, palette.accent, px(3), px(18));
  field.box.min_height = px(56);
  const auto in_field = tree.inside(field);
  write(typed.empty() ? asked : typed, type::kBody, Weight::Medium,
        typed.empty() ? palette.ink_soft : palette.ink);
}

void StaffFrame::outcome(Outcome how) {
  if (how == Outcome::None) return;
  const Told& said = kOutcomes[std::size_t(how) - 1];
  status("outcome", tr(said.words), said.mood);
}

void StaffFrame::status(std::string_view id, std::string_view words, Mood mood) {
  Node row = row_box(space::kS, 0, 4);
  tell(row, Role::Status, id, words);
  const auto in_row = tree.inside(row);
  if (const char* letter = sign_of(mood)) sign(letter, 28, ink_of(mood));
  wide(text(words, type::kSmall, Weight::Medium, ink_of(mood)));
}

}  // namespace relievo::ui
