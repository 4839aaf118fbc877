// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/visitor/visitor_screens.h"

#include <array>

#include "ui/screens/staff_screens.h"

namespace relievo::ui {
namespace {

bool is_dark(Step step) { return step == Step::Attract || step == Step::Trouble || step == Step::Starting; }

const Palette& palette_of(const Visit& visit) {
  return visit.high_contrast ? kHighContrast : is_dark(visit.step) ? kDark : kLight;
}

// In the order of Step.
constexpr std::array kStepScreens{attract_screen,  consent_screen, name_screen,     known_screen,
                                  position_screen, turn_screen,    working_screen,  review_screen,
                                  thanks_screen,   trouble_screen, starting_screen, declined_screen};
static_assert(kStepScreens.size() == kSteps.size());

// The simulated head: it invites, and shows what to do.
bool shows_invitation(const Visit& visit) {
  return visit.step == Step::Attract || visit.step == Step::Position || visit.step == Step::Turn;
}

// The machine wipes a model the moment it leaves Review; the page may be a frame late.
const pipeline::FaceModel* face_of(const ViewState& view, const Visit& visit) {
  return shows_invitation(visit) ? view.invitation_head : view.model;
}

}  // namespace

const Palette& build_visitor_screen(Tree& tree, const ViewState& view, const Visit& visit,
                                    const Rect& screen) {
  const Palette& palette = palette_of(visit);
  tree.begin(info_of(visit.language).right_to_left);
  Page page(tree, view, visit, palette, screen);
  Node root = page.box(Flow::Stack);
  root.id = "screen";
  tree.open(root);
  kStepScreens[std::size_t(visit.step)](page);
  staff_entrance(page);
  if (visit.overlay != Overlay::None) {
    Page over(tree, view, visit, visit.high_contrast ? kHighContrast : kLight, screen);
    overlay_screen(over);
  }
  tree.close();
  return palette;
}

void fill_pictures(DrawList& list, const ViewState& view, const Visit& visit) {
  list.pictures[std::size_t(PictureSlot::Live)] = {view.live.picture, view.live.number};
  for (std::size_t i = 0; i < kStageViews; ++i)
    list.pictures[std::size_t(PictureSlot::Photograph) + i] = view.stages[i];
  if (view.consent != nullptr && !view.consent->host.sign.empty())
    list.pictures[std::size_t(PictureSlot::Sign)] = {view.consent->host.sign_view(), 1};
  list.pictures[std::size_t(PictureSlot::Receipt)] = view.receipt_code;
  list.pictures[std::size_t(PictureSlot::Link)] = view.take_home.link_code;
  list.faces = {};
  list.faces[0].model = face_of(view, visit);
  if (list.faces[0].model != nullptr)
    list.faces[0].version = shows_invitation(visit) ? ~0U : view.model_number;
  list.face_look = visit.shown_look(view.now);
  if (const auto shown = gesture(view, visit.step)) list.face_look = *shown;
  list.face_look.backdrop = visit.step == Step::Review;
}

}  // namespace relievo::ui
