// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The test capture in three dimensions: points, edges, surface, texture and light, each switched on and off.
#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

void switches(TechnicianFrame& b) {
  const FaceLook& look = b.page.visit.look;
  struct Switch {
    std::string_view id;
    const char* label;
    bool on;
    ActionKind kind;
  };
  const Switch all[] = {{"points", b.tr("Points"), look.points, ActionKind::LookPoints},
                        {"edges", b.tr("Edges"), look.edges, ActionKind::LookEdges},
                        {"fill", b.tr("Surface"), look.fill, ActionKind::LookFill},
                        {"texture", b.tr("Texture"), look.textured, ActionKind::ShowShape},
                        {"lit", b.tr("Light"), look.lit, ActionKind::LookLight}};
  for (const Switch& one : all) b.choice(one.id, one.label, one.on, {one.kind, 0}, 0);
}

void hands(TechnicianFrame& b) {
  Node row = b.page.box(Flow::Row, space::kXs, space::kXs, space::kXs);
  row.box.justify = Justify::Centre;
  row.box.left_to_right = true;  // as on the page where a visitor looks at it
  b.page.tree.open(row);
  b.page.square_button("turn_left", b.tr("Turn left"), icon::kTurnLeft, {ActionKind::TurnLeft, 0});
  b.page.square_button("turn_right", b.tr("Turn right"), icon::kTurnRight, {ActionKind::TurnRight, 0});
  b.page.square_button("zoom_out", b.tr("Smaller"), icon::kZoomOut, {ActionKind::ZoomOut, 0});
  b.page.square_button("zoom_in", b.tr("Larger"), icon::kZoomIn, {ActionKind::ZoomIn, 0});
  b.page.square_button("light", b.tr("Move the light"), icon::kSun, {ActionKind::MoveLight, 0});
  b.page.tree.close();
}

void body(TechnicianFrame& b) {
  Node card = b.page.grown(b.page.box(Flow::Stack), 3);
  card.box.fill = b.page.palette.stage;
  card.box.radius = b.page.px(size::kRadius);
  b.page.tree.open(card);
  Node face = b.page.box(Flow::Column);
  face.id = "face";
  face.name = b.tr("The model: turn it with a finger");
  face.role = Role::Picture;
  face.mark = b.view.model != nullptr ? Mark::Face : Mark::Shape;
  face.covered_px = b.page.px(size::kTarget + 2 * space::kXs);  // by the tools
  face.box.radius = b.page.px(size::kRadius);
  face.action = {ActionKind::TurnFace, 0};
  b.page.tree.leaf(face);
  b.page.tree.open(b.page.box(Flow::Column));
  b.page.space(1);
  hands(b);
  b.page.tree.close();
  b.page.tree.close();
}

}  // namespace

void technician_model_page(StaffFrame& page) {
  if (page.staff.technician == nullptr) return;
  TechnicianFrame b(page);
  if (b.capture_state() && b.view.model == nullptr) {
    b.failure();
    page.nothing("no model", icon::kShape, b.tr("There is no model: a stage before it gave up."));
  } else if (b.view.model != nullptr) {
    page.tree.open(page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
    body(b);
    Node side = page.box(Flow::Column, space::kS);
    if (!page.portrait) side.box.width = page.px(page.text_share > 1.2F ? 330 : 260);
    side.box.justify = Justify::Centre;
    page.tree.open(side);
    switches(b);
    page.tree.close();
    page.tree.close();
  }
  b.capture_buttons(false);
}

}  // namespace relievo::ui
