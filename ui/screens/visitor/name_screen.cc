// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A name, or the code of an earlier record; typed, or shown to the cameras.
#include <algorithm>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {

// Somebody with this name, or the record of this code, is there already. To a name nothing is said but
// that; renew and add are for who quotes the code.
namespace {

bool narrow(const Page& page) { return page.portrait || page.text_share > 1.3F; }

// One of two ways on: what it is called, what it means. Who listens hears what it means with its button, not
// with the other's.
void way(Page& page, std::string_view id, const char* label, const char* letter, const char* words,
         Action action) {
  const auto in_box = page.tree.inside(page.grown(page.box(Flow::Column, space::kS)));
  page.button(id, label, letter, ButtonLook::Main, action, 0, words);
  Node meaning = page.text(words, 22, Weight::Regular, page.palette.ink_soft, TextAlign::Centre);
  meaning.unspoken = true;
  page.tree.leaf(meaning);
}

void two_ways(Page& page) {
  const auto& tr = page.tr;
  const auto in_box = page.tree.inside(
      page.box(narrow(page) ? Flow::Column : Flow::Row, page.portrait ? space::kL : space::kM));
  way(page, "renew", tr("Renew it"), icon::kAgain,
      tr("The old portrait is erased the moment the new one is stored."), ActionKind::Renew);
  way(page, "add", tr("Add another one"), icon::kShape, tr("The old portrait is kept beside the new one."),
      ActionKind::AddAnother);
}

void name_ways(Page& page) {
  const auto& tr = page.tr;
  page.tree.open(page.box(narrow(page) ? Flow::Column : Flow::Row, space::kM));
  const float grow = narrow(page) ? 0.0F : 1.0F;
  page.button("somebody_else", tr("I am somebody else"), icon::kPerson, ButtonLook::Quiet,
              ActionKind::SomebodyElse, grow);
  page.button("have_code", tr("I have my code"), icon::kLock, ButtonLook::Main, ActionKind::HaveCode, grow);
  page.tree.close();
  page.button("lost_code", tr("I lost my code"), icon::kHelp, ButtonLook::Plain, ActionKind::LostCode);
}

constexpr float kAsked = 38;  // the size of the question above the field
constexpr float kFinderHigh = 136, kFinderHighAbreast = 78, kFinderHighPortrait = 300;
constexpr float kMostOfCode = 1.5F;
constexpr float kLargest = 1.6F;  // share of the text, from which the question has a row of its own

// Large letters leave no room above the keys: question and answer stand side by side, up to the largest.
bool abreast(const Page& page) { return !page.portrait && page.text_share > 1.1F; }

// "4821-9037-____-__": what is there, and how much is still to come. As long as the code itself.
std::string_view grouped(Page& page, std::string_view digits) {
  const std::size_t from = page.tree.kept();
  for (std::size_t i = 0; i < kCodeDigits; ++i) {
    if (i % 4 == 0 && i > 0) page.tree.keep("-");
    page.tree.keep(i < digits.size() ? digits.substr(i, 1) : std::string_view("_"));
  }
  return page.tree.kept_since(from);
}

void field(Page& page, const char* asked, float grow) {
  const std::string_view name = page.visit.name();
  const bool code = page.visit.quotes_code();
  Node field = page.row_box(3, 26, 14);
  // How long a code is the eye sees by what is still to come.
  tell(field, Role::Field, "name",
       code ? page.filled("{} – {}", {asked, page.share_of(name.size(), kCodeDigits)}) : asked);
  field.by_key = ActionKind::Done;
  field.box.grow = grow;
  // Letter by letter while it is typed; a code that is whole, digit by digit.
  field.value = code && name.size() == kCodeDigits ? page.spelled(grouped(page, name)) : name;
  field.secret = true;
  field.box.min_height = page.px(72);
  field.box.left_to_right = code;
  frame(field, page.palette.card, page.palette.accent, page.px(3), page.px(size::kRadius));
  const auto in_field = page.tree.inside(field);
  const bool hint = name.empty() && !code;
  // What is still to come of a code stays to the right of it, also where words run to the left.
  Node typed = page.text(hint   ? std::string_view(page.tr("Type here or show a QR code"))
                         : code ? page.left_to_right(grouped(page, name))
                                : name,
                         hint && abreast(page) && page.text_share > kLargest ? type::kSmall : type::kButton,
                         Weight::Medium, hint ? page.palette.ink_soft : page.palette.ink);
  if (code) typed.style.size_px *= std::min(1.0F, kMostOfCode / page.text_share);  // it stays on one line
  typed.id = "typed";
  if (!hint) page.tree.leaf(typed);
  if (!code) page.tree.leaf(page.painted(page.sized(page.box(Flow::Column), 3, 36), page.palette.accent));
  if (hint) page.tree.leaf(typed);
}

// Where a code is held, as in a mirror, with the corners of a frame it fits into.
void finder(Page& page, float high_dp) {
  const ImageView& live = page.view.live.picture;
  if (live.empty()) return;
  const float aspect = aspect_of(live);
  Node room = page.sized(page.box(Flow::Stack), high_dp * aspect, high_dp);
  room.aspect = aspect;
  const auto in_room = page.tree.inside(room);
  Node picture = page.box(Flow::Column);
  tell(picture, Role::Picture, "finder", page.tr("What the camera sees: hold a QR code here"));
  depict(picture, PictureSlot::Live, aspect);
  picture.mirrored = true;
  picture.box.radius = page.px(12);
  page.tree.leaf(picture);
  const float side = 0.62F * high_dp, arm = 0.16F * high_dp, line = 4;
  const auto bar = [&](float x, float y, float w, float h) {
    const Node one =
        pinned(page.sized(page.box(Flow::Column), w, h), 0.5F + x / (high_dp * aspect), 0.5F + y / high_dp);
    page.tree.leaf(page.painted(one, {255, 255, 255, 235}, line / 2));
  };
  for (const float right : {-1.0F, 1.0F})
    for (const float down : {-1.0F, 1.0F}) {
      bar(right * (side - arm) / 2, down * side / 2, arm, line);
      bar(right * side / 2, down * (side - arm) / 2, line, arm);
    }
}

void wrong_code(Page& page) {
  if (page.view.known != Known::NoSuchCode || !page.visit.code_handed_in()) return;
  page.put("wrong_code", Role::Alert, page.tr("No record has this code. Please check it, or ask the staff."),
           type::kSmall, Weight::Bold, page.palette.bad);
}

// Question and answer, with the camera's picture beside them.
void ask_name(Page& page, const char* asked) {
  const bool largest = abreast(page) && page.text_share > kLargest;
  if (largest) page.heading("title", asked, type::kSmall);
  Node row = page.abreast_box(space::kM);
  row.box.align = page.portrait ? Align::Stretch : Align::Centre;
  const auto in_row = page.tree.inside(row);
  if (abreast(page)) {
    if (!largest) page.heading("title", asked, type::kBody);
    field(page, asked, 1);
  } else {
    const auto in_box =
        page.tree.inside(page.grown(page.box(Flow::Column, space::kM), page.portrait ? 0.0F : 1.0F));
    page.heading("title", asked, kAsked);
    field(page, asked, 0);
  }
  if (page.portrait) {
    page.tree.open(justified(page.box(Flow::Row), Justify::Centre));
  }
  finder(page, page.portrait ? kFinderHighPortrait : abreast(page) ? kFinderHighAbreast : kFinderHigh);
  if (page.portrait) page.tree.close();
}

// Digits only: a pad of them, beside the question where there is room.
void ask_code(Page& page, const char* asked) {
  Node room = justified(page.grown(page.sided(page.abreast_box(space::kXl))), Justify::Centre);
  if (page.portrait) room.box.align = Align::Centre, room.box.shrink = true;
  const auto in_room = page.tree.inside(room);
  Node said = scroller("said", justified(page.box(Flow::Column, space::kM), Justify::Centre));
  said.box.shrink = page.portrait;
  if (page.portrait) said.box.width = page.px(page.width_dp - 2 * kPageMargin);
  else said.box.grow = 1;
  page.tree.open(said);
  page.heading("title", asked, kAsked);
  field(page, asked, 0);
  wrong_code(page);
  finder(page, !page.portrait && page.large_words() ? kFinderHighAbreast : kFinderHigh);
  page.button("lost_code", page.tr("I lost my code"), icon::kHelp, ButtonLook::Quiet, ActionKind::LostCode);
  page.tree.close();
  number_pad(page, {"key ", "done"},
             page.visit.name().size() == kCodeDigits ? Action(ActionKind::Done) : Action{});
}

}  // namespace

void known_screen(Page& page) {
  const auto& tr = page.tr;
  const bool proven = page.view.known == Known::Code;
  page.begin(true);
  page.tree.open(
      scroller("known", justified(page.grown(page.box(Flow::Column, space::kM)), Justify::Centre)));
  page.heading("title", proven ? tr("Welcome back") : tr("This name is in our records"));
  page.body(
      "what",
      proven
          ? tr("You already have a portrait here. What would you like to do?")
          : tr("Is that you? With the code you were given you can renew your portrait or add another one. Without it nothing from the record is shown."));
  page.tree.leaf(page.sized(page.box(Flow::Column), 1, 8));
  if (proven) two_ways(page);
  else name_ways(page);
  page.tree.close();
  page.end();
}

void name_screen(Page& page) {
  page.begin(true);
  if (page.visit.quotes_code()) {
    ask_code(page, page.tr("Type your code"));
    return page.end();
  }
  ask_name(page, page.tr("Your name or your number"));
  if (page.portrait) page.space(1);
  keyboard(page);
  page.end();
}

}  // namespace relievo::ui
