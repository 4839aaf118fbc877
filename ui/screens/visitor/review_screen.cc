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
struct Quality {
  const char* words;
  bool good = true;
};
Quality quality_of(const Page& page) {
  if (page.view.model == nullptr) return {""};
  if (page.view.model->poses_left_out > 0)
    return {page.tr("One side did not fit and was left out. Another picture, held stiller, can have it."),
            false};
  const pipeline::ModelQuality& q = page.view.model->quality;
  if (q.coverage >= kWholeFace && q.texture_sharpness >= kSharp)
    return {page.tr("Very good: your whole face was seen clearly.")};
  if (q.coverage >= kMostOfTheFace) return {page.tr("Good: most of your face was seen clearly.")};
  return {page.tr("Parts of your face were hidden or blurred. Another picture will be better."), false};
}

void tools(Page& page) {
  const auto& tr = page.tr;
  // What turns the face to the left lies on the left.
  const auto in_row = page.tree.inside(left_first(justified(page.box(Flow::Row, 10), Justify::Centre)));
  page.turning_tools();
  page.square_button("shape", tr("With and without colour"), icon::kShape, ActionKind::ShowShape);
  page.square_button("at_first", tr("As at first"), icon::kUndo, ActionKind::LookAtFirst);
}

void face(Page& page) {
  Node card = page.stage(size::kCardRadius, page.portrait ? 1.0F : 1.35F);
  card.box.shadow = true;
  const auto in_card = page.tree.inside(card);
  Node node = page.model("face", page.tr("Your face: turn it with a finger"), size::kCardRadius);
  if (page.view.model == nullptr) node.mark = Mark::Shape;
  node.covered_px = page.px(size::kTarget + 2 * kToolsEdge);
  page.tree.leaf(node);
  const auto in_column = page.tree.inside(page.box(Flow::Column, 0, 12, kToolsEdge));
  page.space(1);
  tools(page);
}

void assurance(Page& page) {
  const auto& tr = page.tr;
  const auto [said, good] = quality_of(page);
  const auto what = [&] {
    page.body("what", tr("Turn the portrait with your finger. Nothing is stored until you say so."));
  };
  if (good) what();  // what speaks against keeping it comes first: large text may need scrolling
  Node row = page.row_box(14, 18, 14);
  tell(row, Role::Status, "quality", {});
  page.card(row, size::kRadius);
  page.tree.open(row);
  page.sign(good ? icon::kGood : icon::kInfo, 32, good ? page.palette.good : page.palette.warn);
  page.wide(page.text(said, 22, Weight::Medium, page.palette.ink));
  page.tree.close();
  if (!good) what();
}

void question(Page& page) {
  const auto& tr = page.tr;
  Node column = page.box(Flow::Column, space::kM);
  if (!page.portrait) column.box.grow = 1;
  const auto in_column = page.tree.inside(column);
  Node words = justified(page.box(Flow::Column, space::kS), Justify::Centre);
  words.id = "words";
  words.box.grow = page.portrait ? 0.0F : 1.0F;
  words.box.scroll = !page.portrait;
  page.tree.open(words);
  page.heading("title", tr("Is this you?"));
  if (page.view.trouble == Trouble::Storage) {
    page.put("trouble", Role::Alert, tr("Nothing can be stored at the moment"), 22, Weight::Medium,
             page.palette.bad);
    page.body("what", tr("Please tell the staff."));
    page.body("kept", tr("Nothing about you was kept."));
  } else if (page.view.trouble == Trouble::StorageFull) {
    page.put(
        "trouble", Role::Alert,
        tr("It could not be stored: the memory is full. Nothing was kept. Please tell the staff, or try again."),
        22, Weight::Medium, page.palette.bad);
  } else {
    assurance(page);
  }
  page.tree.close();
  page.button("accept", tr("Yes, keep it"), icon::kGood, ButtonLook::Main, ActionKind::Accept);
  page.button("retake", tr("Take it again"), icon::kAgain, ButtonLook::Quiet, ActionKind::Retake);
}

}  // namespace

void review_screen(Page& page) {
  page.begin(false);
  page.tree.open(page.grown(page.sided(page.abreast_box(space::kL))));
  face(page);
  question(page);
  page.tree.close();
  page.end();
}

}  // namespace relievo::ui
