// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Both cameras, live, side by side, or the left one and its relief: light, focus, and whether they expose at
// the same instant.
#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

constexpr float kBurntOut = 0.02F, kTooDark = 0.12F, kSharpEnough = 0.9F;

// Touched, a camera's picture fills the page: mode 1 the left one's, 2 the right one's.
void live(TechnicianFrame& f, std::string_view id, const char* title, const Picture& picture,
          PictureSlot slot, int mode) {
  const auto in_column = f.tree.inside(justified(f.grown(f.box(Flow::Column, 6)), Justify::Centre));
  f.write(title, type::kSmall, Weight::Bold, f.palette.ink, TextAlign::Centre);
  const bool opens = mode > 0 && !picture.pixels.empty();
  f.open_picture(id, opens ? f.filled("{}: {}", {title, f.tr("Larger")}) : title, picture, slot,
                 opens ? Action(ActionKind::StaffMode, mode) : Action());
  f.tree.close();
}

void edges_button(TechnicianFrame& f, float grow) {
  f.choice("show edges", f.tr("Sharp edges"), f.seen.cameras.edges_shown, TechnicianAct::ShowEdges, grow);
}

// What a hand at the lens looks at.
void focus_card(TechnicianFrame& f, const TechnicianCamera& camera) {
  Node row = f.row_box(space::kM, space::kM, space::kXs);
  f.card(row, 18);
  const auto in_row = f.tree.inside(row);
  f.tree.open(f.grown(f.box(Flow::Column)));
  const auto figure = [&](std::string_view id, const char* label, float share, int decimals) {
    Node said = f.text(f.filled("{}: {}", {label, f.number(100 * double(share), decimals, "%")}), 18,
                       Weight::Medium, f.palette.ink);
    said.id = id;
    said.style.tabular = true;
    f.tree.leaf(said);
  };
  figure("whole focus", f.tr("Focus, of the best so far"), camera.focus, 0);
  if (f.seen.cameras.edges_shown) figure("whole edges", f.tr("Sharp edges"), camera.sharp_edges, 1);
  f.tree.close();
  edges_button(f, 0);
}

// One picture, and the figures below it.
void whole_page(TechnicianFrame& f, std::size_t side) {
  const TechnicianCamera& camera = f.seen.cameras.camera[side];
  f.open_picture("whole", f.filled("{}: {}", {f.camera_name(side), f.tr("Back")}), camera.picture,
                 f.slot_of(side), {ActionKind::StaffMode, 0});
  f.tree.close();
  focus_card(f, camera);
}

using Camera = TechnicianCamera;

// A figure of either camera: its decimals and unit, and when it is doubtful; none: it is not judged.
struct CameraRow {
  const char *id, *label;
  double (*value)(const Camera&);
  int decimals;
  const char* unit_name;
  bool (*doubtful)(const Camera&) = nullptr;
};
constexpr CameraRow kRows[] = {
    {"brightness", mark_tr("Brightness of the middle"), [](const Camera& x) { return 100.0 * x.mean; }, 0,
     "%", [](const Camera& x) { return x.mean < kTooDark; }},
    {"clipped", mark_tr("Overexposed"), [](const Camera& x) { return 100.0 * x.clipped; }, 1, "%",
     [](const Camera& x) { return x.clipped > kBurntOut; }},
    {"focus", mark_tr("Focus, of the best so far"), [](const Camera& x) { return 100.0 * x.focus; }, 0, "%",
     [](const Camera& x) { return x.focus < kSharpEnough; }},
    {"edges", mark_tr("Sharp edges"), [](const Camera& x) { return 100.0 * x.sharp_edges; }, 1, "%"},
    {"frames", mark_tr("Pictures"), [](const Camera& x) { return double(x.frames); }, 0, ""},
    {"lost", mark_tr("Lost"), [](const Camera& x) { return double(x.lost); }, 0, "",
     [](const Camera& x) { return x.lost > 0; }},
    {"damaged", mark_tr("Damaged"), [](const Camera& x) { return double(x.damaged); }, 0, "",
     [](const Camera& x) { return x.damaged > 0; }},
};

// A label, and the figure of the left and of the right camera, on their sides in every language.
void pair_row(TechnicianFrame& f, const CameraRow& what) {
  Node row = f.row_box(space::kS, 0, 6);
  row.id = what.id;
  row.box.min_height = f.px(44);
  const auto in_row = f.tree.inside(row);
  f.tree.open(f.grown(f.box(Flow::Column), 1.4F));
  f.write(f.tr(what.label), type::kSmall, Weight::Medium, f.palette.ink);
  f.tree.close();
  const auto in_both = f.tree.inside(left_first(f.grown(f.box(Flow::Row, space::kS), 2)));
  for (const Camera& camera : f.seen.cameras.camera) {
    const Mood mood = what.doubtful == nullptr ? Mood::Plain
                      : what.doubtful(camera)  ? Mood::Warn
                                               : Mood::Good;
    const auto in_cell = f.tree.inside(f.grown(f.row_box(space::kXs)));
    if (const char* letter = f.sign_of(mood)) f.sign(letter, 22, f.ink_of(mood));
    f.write(f.number(what.value(camera), what.decimals, what.unit_name), type::kSmall, Weight::Regular,
            mood == Mood::Plain ? f.palette.ink_soft : f.ink_of(mood));
  }
}

void figures(TechnicianFrame& f) {
  const TechnicianCameras& c = f.seen.cameras;
  for (const CameraRow& row : kRows)
    if (c.edges_shown || std::string_view(row.id) != "edges") pair_row(f, row);
  f.section(f.tr("Together"));
  f.row("skew", f.tr("Apart in time"), f.number(c.skew_us, 0, "µs"));
  f.row("pairs", f.tr("Pairs"), f.number(c.pairs));
  f.row("apart", f.tr("Refused: too far apart"), f.number(c.apart), c.apart > 0 ? Mood::Warn : Mood::Good);
  f.row("rate", f.tr("Pairs a second"), f.number(c.pairs_per_second, 1));
  f.row("exposure", f.tr("Exposure"), f.number(double(c.exposure_us) / 1000, 2, "ms"));
  if (!c.can_be_set) f.row("fixed", f.tr("The exposure of these cameras cannot be set."), {});
}

}  // namespace

void technician_cameras_page(TechnicianFrame& f) {
  f.problem(f.seen.problem.empty() ? f.seen.cameras.problem : f.seen.problem);
  const TechnicianCameras& cameras = f.seen.cameras;
  if (f.service.mode > 0 && cameras.watched) return whole_page(f, f.service.mode == 1 ? 0 : 1);
  f.tree.open(f.grown(f.abreast_box(space::kM)));
  f.tree.open(left_first(f.grown(f.box(Flow::Row, space::kS), f.picture_share(1.5F))));
  live(f, "left live", f.tr("Left camera"), cameras.camera[0].picture, PictureSlot::TechnicianLeft, 1);
  if (cameras.relief_shown)
    live(f, "relief", f.tr("Relief"), cameras.relief, PictureSlot::TechnicianRight, 0);
  else
    live(f, "right live", f.tr("Right camera"), cameras.camera[1].picture, PictureSlot::TechnicianRight, 2);
  f.tree.close();
  f.tree.open(f.grown(f.box(Flow::Column)));
  f.begin_panel("camera figures");
  if (cameras.watched) figures(f);
  else f.line(cameras.starting ? f.tr("One moment, please") : f.tr("It was stopped"));
  f.tree.close(3);
  const float grow = f.open_buttons();
  if (cameras.can_be_set) {
    f.small_button("darker", f.tr("Darker"), icon::kDark, ButtonLook::Quiet, TechnicianAct::DarkerShot, grow);
    f.small_button("brighter", f.tr("Brighter"), icon::kSun, ButtonLook::Quiet, TechnicianAct::BrighterShot,
                   grow);
    if (f.portrait) f.tree.close(), f.open_buttons();  // two and two
  }
  if (cameras.watched) {
    edges_button(f, grow);
    f.choice("show relief", f.tr("Relief"), cameras.relief_shown, TechnicianAct::ShowRelief, grow);
  }
  const bool on = cameras.starting || cameras.watched;
  f.small_button("watch", on ? f.tr("Stop") : f.tr("Start"), on ? icon::kClose : icon::kCamera,
                 ButtonLook::Main, TechnicianAct::WatchCameras, grow);
  f.tree.close();
}

}  // namespace relievo::ui
