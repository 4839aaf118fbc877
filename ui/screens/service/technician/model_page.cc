// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The test capture in three dimensions: points, edges, surface, texture and light, each switched on and off;
// the distance of two points on it.
#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

void switches(TechnicianFrame& f) {
  const FaceLook& look = f.page.visit.look;
  struct Switch {
    std::string_view id;
    const char* label;
    bool on;
    ActionKind kind;
  };
  const Switch all[] = {{"points", f.tr("Points"), look.points, ActionKind::LookPoints},
                        {"edges", f.tr("Edges"), look.edges, ActionKind::LookEdges},
                        {"fill", f.tr("Surface"), look.fill, ActionKind::LookFill},
                        {"texture", f.tr("Texture"), look.textured, ActionKind::ShowShape},
                        {"lit", f.tr("Light"), look.lit, ActionKind::LookLight}};
  for (const Switch& one : all) f.choice(one.id, one.label, one.on, {one.kind, 0}, 0);
}

void hands(TechnicianFrame& f) {
  Node row = f.page.box(Flow::Row, space::kXs, space::kXs, space::kXs);
  row.box.justify = Justify::Centre;
  row.box.left_to_right = true;  // as on the page where a visitor looks at it
  f.page.tree.open(row);
  f.page.square_button("turn_left", f.tr("Turn left"), icon::kTurnLeft, {ActionKind::TurnLeft, 0});
  f.page.square_button("turn_right", f.tr("Turn right"), icon::kTurnRight, {ActionKind::TurnRight, 0});
  f.page.square_button("zoom_out", f.tr("Smaller"), icon::kZoomOut, {ActionKind::ZoomOut, 0});
  f.page.square_button("zoom_in", f.tr("Larger"), icon::kZoomIn, {ActionKind::ZoomIn, 0});
  f.page.square_button("light", f.tr("Move the light"), icon::kSun, {ActionKind::MoveLight, 0});
  f.page.tree.close();
}

}  // namespace

void technician_model_page(StaffFrame& page) {
  if (page.staff.technician == nullptr) return;
  TechnicianFrame f(page);
  if (f.capture_state() && f.view.model == nullptr) {
    f.failure();
    page.nothing("no model", icon::kShape, f.tr("There is nothing: a stage before it gave up."));
  } else if (f.view.model != nullptr) {
    page.tree.open(page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
    f.face(3, hands, size::kTarget + 2 * space::kXs);
    Node side = page.box(Flow::Column, space::kS);
    if (!page.portrait) side.box.width = page.px(page.text_share > 1.2F ? 330 : 260);
    side.box.justify = Justify::Centre;
    page.tree.open(side);
    switches(f);
    f.measure_button(0);
    page.tree.close();
    page.tree.close();
  }
  f.capture_buttons(false);
}

}  // namespace relievo::ui
