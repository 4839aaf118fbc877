// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The face, to be turned with a finger; how good it is, in words; and the question.
#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

constexpr float kToolsEdge = 16;  // dp, above and below the tools that lie on the face
// Share of what is shown that was measured, of the feature with the least: of an eye, whose cornea mirrors
// the lamps, half at best.
constexpr double kWholeFace = 0.45, kMostOfTheFace = 0.3;
constexpr double kSharp = 0.25;  // of the photographed texels

// No figures: they mean nothing to a visitor.
const char* quality(const Page& page, bool& good) {
  good = true;
  if (page.view.model == nullptr) return "";
  if (page.view.model->poses_left_out > 0) {
    good = false;
    return page.tr("One side did not fit and was left out. Another picture, held stiller, can have it.");
  }
  const pipeline::ModelQuality& q = page.view.model->quality;
  if (q.coverage >= kWholeFace && q.texture_sharpness >= kSharp)
    return page.tr("Very good: your whole face was seen clearly.");
  if (q.coverage >= kMostOfTheFace) return page.tr("Good: most of your face was seen clearly.");
  good = false;
  return page.tr("Parts of your face were hidden or blurred. Another picture will be better.");
}

void tools(Page& page) {
  const auto& tr = page.tr;
  Node row = page.box(Flow::Row, 10);
  row.box.justify = Justify::Centre;
  row.box.left_to_right = true;  // what turns the face to the left lies on the left
  const auto in_row = page.tree.inside(row);
  page.square_button("turn_left", tr("Turn left"), icon::kTurnLeft, {ActionKind::TurnLeft, 0});
  page.square_button("turn_right", tr("Turn right"), icon::kTurnRight, {ActionKind::TurnRight, 0});
  page.square_button("zoom_out", tr("Smaller"), icon::kZoomOut, {ActionKind::ZoomOut, 0});
  page.square_button("zoom_in", tr("Larger"), icon::kZoomIn, {ActionKind::ZoomIn, 0});
  page.square_button("light", tr("Move the light"), icon::kSun, {ActionKind::MoveLight, 0});
  page.square_button("shape", tr("With and without colour"), icon::kShape, {ActionKind::ShowShape, 0});
  page.square_button("at_first", tr("As at first"), icon::kUndo, {ActionKind::LookAtFirst, 0});
}

void face(Page& page) {
  Node card = page.grown(page.box(Flow::Stack), page.portrait ? 1.0F : 1.35F);
  card.box.fill = page.palette.stage;
  card.box.radius = page.px(size::kCardRadius);
  card.box.shadow = true;
  const auto in_card = page.tree.inside(card);
  Node node = page.box(Flow::Column);
  node.id = "face";
  node.name = page.tr("Your face: turn it with a finger");
  node.role = Role::Picture;
  node.mark = page.view.model != nullptr ? Mark::Face : Mark::Shape;
  node.covered_px = page.px(size::kTarget + 2 * kToolsEdge);
  node.box.radius = page.px(size::kCardRadius);
  node.action = {ActionKind::TurnFace, 0};
  page.tree.leaf(node);
  Node column = page.box(Flow::Column, 0, 12, kToolsEdge);
  const auto in_column = page.tree.inside(column);
  page.space(1);
  tools(page);
}

void assurance(Page& page) {
  const auto& tr = page.tr;
  bool good = true;
  const char* said = quality(page, good);
  const auto what = [&] {
    page.body("what", tr("Turn the portrait with your finger. Nothing is stored until you say so."));
  };
  if (good) what();  // what speaks against keeping it comes first: large text may need scrolling
  Node row = page.box(Flow::Row, 14, 18, 14);
  row.id = "quality";
  row.role = Role::Status;
  row.box.align = Align::Centre;
  row.box.fill = page.palette.card;
  row.box.border = page.palette.card_border;
  row.box.border_px = page.px(1.5F);
  row.box.radius = page.px(size::kRadius);
  page.tree.open(row);
  page.sign(good ? icon::kGood : icon::kInfo, 32, good ? page.palette.good : page.palette.warn);
  page.tree.open(page.grown(page.box(Flow::Column)));
  page.tree.leaf(page.text(said, 22, Weight::Medium, page.palette.ink));
  page.tree.close();
  page.tree.close();
  if (!good) what();
}

void question(Page& page) {
  const auto& tr = page.tr;
  Node column = page.box(Flow::Column, space::kM);
  if (!page.portrait) column.box.grow = 1;
  const auto in_column = page.tree.inside(column);
  Node words = page.box(Flow::Column, space::kS);
  words.id = "words";
  words.box.grow = page.portrait ? 0.0F : 1.0F;
  words.box.scroll = !page.portrait;
  words.box.justify = Justify::Centre;
  page.tree.open(words);
  page.heading("title", tr("Is this you?"));
  if (page.view.trouble == Trouble::Storage) {
    Node trouble = page.text(
        tr("It could not be stored: the memory is full. Nothing was kept. Please tell the staff, or try again."),
        22, Weight::Medium, page.palette.bad);
    trouble.id = "trouble";
    trouble.role = Role::Alert;
    page.tree.leaf(trouble);
  } else {
    assurance(page);
  }
  page.tree.close();
  page.button("accept", tr("Yes, keep it"), icon::kGood, ButtonLook::Main, {ActionKind::Accept, 0});
  page.button("retake", tr("Take it again"), icon::kAgain, ButtonLook::Quiet, {ActionKind::Retake, 0});
}

}  // namespace

void review_screen(Page& page) {
  page.begin(false);
  page.tree.open(page.grown(page.sided(page.box(page.portrait ? Flow::Column : Flow::Row, space::kL))));
  face(page);
  question(page);
  page.tree.close();
  page.end();
}

}  // namespace relievo::ui
