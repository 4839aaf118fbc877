// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every stage of the test capture as a picture: the pair with its epipolar lines, where a touch shows a
// point's partner and pairs are made by hand; the matches in the colours of the rules; depth, points, surface
// with what the pairs by hand moved of it, texture.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

constexpr int kLines = 8;
constexpr Colour kFaint{255, 255, 255, 70}, kTouched{255, 170, 40, 255}, kOther{110, 210, 255, 255};

bool is_pair(TechnicianStage stage) {
  return stage == TechnicianStage::Input || stage == TechnicianStage::Processed ||
         stage == TechnicianStage::Rectified;
}

bool makes_pairs(const TechnicianFrame& b) {
  return b.view.by_hand && b.view.stage == TechnicianStage::Rectified;
}

void tabs(TechnicianFrame& b) {
  const std::size_t across = b.across(kTechnicianStages);
  for (std::size_t first = 0; first < kTechnicianStages; first += across) {
    b.page.tree.open(b.page.box(Flow::Row, 6));
    for (std::size_t i = first; i < first + across; ++i) {
      const auto stage = static_cast<TechnicianStage>(i);
      const bool chosen = stage == b.view.stage;
      Node tab = b.page.grown(b.page.box(Flow::Row, 0, 4, 4));
      tab.id = b.id("stage", i);
      tab.name = title_of(b.tr, stage);
      tab.role = Role::Button;
      tab.action = technician_action(TechnicianAct::ShowStage, static_cast<std::int32_t>(i));
      tab.box.justify = Justify::Centre;
      tab.box.align = Align::Centre;
      tab.box.min_height = b.page.px(size::kStaffTarget);
      tab.box.radius = b.page.px(14);
      tab.box.fill = chosen ? b.page.palette.accent : b.page.palette.quiet;
      tab.box.border = chosen ? b.page.palette.accent : b.page.palette.quiet_border;
      tab.box.border_px = b.page.px(2);
      b.page.tree.open(tab);
      b.page.tree.leaf(b.page.text(
          title_of(b.tr, stage), b.page.portrait ? 16 : 19, chosen ? Weight::Bold : Weight::Medium,
          chosen ? b.page.palette.accent_ink : b.page.palette.link, TextAlign::Centre));
      b.page.tree.close();
    }
    b.page.tree.close();
  }
}

void pin_pairs(TechnicianFrame& b, std::size_t side) {
  for (const TechnicianPoint& p : b.view.pairs.first(std::min(b.view.pairs.size(), kMostPairs)))
    if (side == 0 || p.matched) b.pin_dot(side == 0 ? p.left_x : p.right_x, p.y, kOther, {});
}

void pair_pictures(TechnicianFrame& b) {
  const bool touchable = b.view.stage == TechnicianStage::Rectified;
  Node row = b.page.grown(b.page.box(Flow::Row, space::kS), b.picture_share(2.4F));
  row.box.left_to_right = true;
  b.page.tree.open(row);
  for (std::size_t side = 0; side < 2; ++side) {
    Action action{}, dragged{};
    if (touchable) action = technician_action(side == 0 ? TechnicianAct::Point : TechnicianAct::PointRight);
    if (makes_pairs(b))
      dragged = technician_action(side == 0 ? TechnicianAct::Drag : TechnicianAct::DragRight);
    b.open_picture(side == 0 ? "left" : "right", side == 0 ? b.tr("Left camera") : b.tr("Right camera"),
                   b.view.shown[side], side == 0 ? PictureSlot::TechnicianLeft : PictureSlot::TechnicianRight,
                   action, dragged);
    if (b.view.stage != TechnicianStage::Input) {
      for (int i = 1; i < kLines; ++i) b.pin_line(static_cast<float>(i) / kLines, kFaint, 1);
    }
    if (makes_pairs(b)) pin_pairs(b, side);
    const TechnicianPoint& point = b.view.point;
    if (touchable && point.touched) b.pin_line(point.y, kTouched, 2);
    if (touchable && point.touched && side == 0) b.pin_dot(point.left_x, point.y, kTouched, "left mark");
    if (touchable && point.matched && side == 1) b.pin_dot(point.right_x, point.y, kTouched, "right mark");
    b.close_picture();
  }
  b.page.tree.close();
}

void one_picture(TechnicianFrame& b) {
  Node row = b.page.grown(b.page.box(Flow::Row, space::kS), b.picture_share(2.4F));
  b.page.tree.open(row);
  b.open_picture("picture", title_of(b.tr, b.view.stage), b.view.shown[0], PictureSlot::TechnicianLeft);
  b.close_picture();
  if (!b.view.shown[1].pixels.empty()) {
    b.open_picture("change", b.tr("What the pairs by hand moved"), b.view.shown[1],
                   PictureSlot::TechnicianRight);
    b.close_picture();
  }
  b.page.tree.close();
}

std::string_view coordinates(TechnicianFrame& b, const pipeline::Vec2f& px) {
  return b.several({static_cast<double>(px.x), static_cast<double>(px.y)}, 2, "px");
}

std::string_view plus_minus(TechnicianFrame& b, double value, double sigma, int decimals,
                            const char* unit_name) {
  return b.joined(b.page.number(value, decimals), "\u00a0±\u00a0", b.page.number(sigma, decimals, unit_name));
}

void point_rows(TechnicianFrame& b) {
  const TechnicianPoint& point = b.view.point;
  if (!point.touched) {
    b.page.tree.leaf(b.page.text(
        b.view.by_hand
            ? b.tr(
                  "Touch a point in the left picture. Its partner is proposed in the right one: touch or drag to correct it.")
            : b.tr("Touch the left picture: the line and the match of that point are shown."),
        type::kSmall, Weight::Regular, b.page.palette.ink_soft));
    return;
  }
  b.page.row("point left", b.tr("Left"), coordinates(b, point.left_px));
  if (point.waits_for_right) {
    b.page.tree.leaf(b.page.text(b.tr("Now touch its partner on the orange line in the right picture."),
                                 type::kSmall, Weight::Medium, b.page.palette.ink));
    return;
  }
  if (!point.matched) {
    b.page.row("point none", b.tr("No match here"), {}, Mood::Warn);
    return;
  }
  if (point.new_surface) b.page.row("point moved", b.tr("Surface here"), b.tr("new"), Mood::Good);
  else if (!std::isnan(point.moved_mm))
    b.page.row("point moved", b.tr("Surface came nearer by"),
               b.page.number(static_cast<double>(point.moved_mm), 2, "mm"));
  b.page.row("point right", b.tr("Right"), coordinates(b, point.right_px));
  b.page.row(
      "point disparity", b.tr("Disparity"),
      plus_minus(b, static_cast<double>(point.disparity_px), static_cast<double>(point.sigma_px), 2, "px"));
  b.page.row("point likeness", b.tr("Likeness"), b.page.number(1 - static_cast<double>(point.cost), 3));
  if (!point.rejected_by.empty())
    b.page.row("point rejected", b.tr("Rejected by"), b.rule_name(point.rejected_by), Mood::Bad);
  else if (!point.by_hand) b.page.row("point accepted", b.tr("Accepted"), b.tr("yes"), Mood::Good);
  b.page.row("point space", b.tr("In space"),
             b.several({static_cast<double>(point.at_mm.x), static_cast<double>(point.at_mm.y),
                        static_cast<double>(point.at_mm.z)},
                       1, "mm"));
  b.page.row("point sigma", b.tr("Depth uncertainty"),
             b.page.number(static_cast<double>(point.sigma_mm), 3, "mm"));
}

void change_rows(TechnicianFrame& b) {
  if (b.view.pairs.empty()) return;
  b.page.rule();
  b.page.row("pairs", b.tr("Pairs by hand"), b.page.number(static_cast<double>(b.view.pairs.size())));
  const TechnicianChange& change = b.view.change;
  if (!change.known) return;
  b.page.row("moved", b.tr("Surface moved"), b.page.number(static_cast<double>(change.moved_mm2), 0, "mm²"));
  b.page.row("new", b.tr("New surface"), b.page.number(static_cast<double>(change.new_mm2), 0, "mm²"));
  b.page.row("farthest", b.tr("Largest move"),
             b.page.number(static_cast<double>(change.farthest_mm), 2, "mm"));
  if (b.view.stage == TechnicianStage::Mesh)
    b.page.tree.leaf(
        b.page.text(b.page.filled(b.tr("Red came nearer, blue went away; white stayed. Full colour: {}."),
                                  b.page.number(static_cast<double>(change.full_colour_mm), 2, "mm")),
                    type::kSmall, Weight::Regular, b.page.palette.ink_soft));
}

void pair_buttons(TechnicianFrame& b) {
  b.choice("by hand", b.tr("Match by hand"), b.view.by_hand, technician_action(TechnicianAct::ByHand), 0);
  if (!b.view.by_hand) return;
  if (b.view.point.touched)
    b.page.small_button("remove pair", b.tr("Remove this pair"), icon::kClose, ButtonLook::Quiet,
                        technician_action(TechnicianAct::RemovePair));
  if (b.view.pairs_changed)
    b.page.small_button("run pairs", b.tr("Calculate with the pairs"), icon::kAgain, ButtonLook::Main,
                        technician_action(TechnicianAct::Run));
}

void rule_rows(TechnicianFrame& b) {
  const TechnicianResult& r = b.view.result;
  b.page.row("matches", b.tr("Matches"), b.page.number(static_cast<double>(r.matches)));
  b.page.row("accepted", b.tr("Accepted matches"), b.page.number(static_cast<double>(r.accepted)));
  b.page.section(b.tr("Rejected by"));
  for (std::size_t i = 0; i < r.rule_count; ++i) {
    const TechnicianRule& rule = r.rules[i];
    Node row = b.page.box(Flow::Row, space::kS, 0, 6);
    row.id = b.id("rule", i);
    row.box.align = Align::Centre;
    b.page.tree.open(row);
    Node patch = b.page.sized(b.page.box(Flow::Column), 26, 26);
    patch.box.fill = {rule.rgb[0], rule.rgb[1], rule.rgb[2], 255};
    patch.box.radius = b.page.px(6);
    b.page.tree.leaf(patch);
    b.page.tree.open(b.page.grown(b.page.box(Flow::Column)));
    b.page.tree.leaf(b.page.text(b.rule_name(rule.name), type::kSmall, Weight::Medium, b.page.palette.ink));
    b.page.tree.close();
    b.page.tree.leaf(b.page.text(b.page.number(static_cast<double>(rule.rejected)), type::kSmall,
                                 Weight::Regular, b.page.palette.ink_soft));
    b.page.tree.close();
  }
}

void time_rows(TechnicianFrame& b) {
  const TechnicianResult& r = b.view.result;
  const char* const made[] = {b.tr("Accepted matches"), b.tr("Points"), b.tr("Triangles"), b.tr("Texels"),
                              b.tr("Landmarks")};
  for (std::size_t i = 0; i < r.seconds.size(); ++i) {
    b.page.section(work_of(b.tr, i));
    b.page.row(b.id("time", i), b.tr("Time"), b.page.number(static_cast<double>(r.seconds[i]), 2, "s"));
    b.page.row(b.id("made", i), made[i], b.page.number(static_cast<double>(r.made[i])));
  }
}

void side_rows(TechnicianFrame& b) {
  b.failure();
  if (b.view.stage == TechnicianStage::Rectified) {
    point_rows(b);
    return change_rows(b);
  }
  if (b.view.stage == TechnicianStage::Mesh) change_rows(b);
  if (b.view.stage == TechnicianStage::Matches) return rule_rows(b);
  time_rows(b);
}

}  // namespace

void technician_stages_page(StaffFrame& page) {
  if (page.staff.technician == nullptr) return;
  TechnicianFrame b(page);
  if (b.view.saved.listed) return b.saved_list(TechnicianAct::Load);
  const bool there = b.capture_state();
  if (there) {
    tabs(b);
    page.tree.open(page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
    if (is_pair(b.view.stage)) pair_pictures(b);
    else one_picture(b);
    Node side = page.grown(page.box(Flow::Column, space::kXs));
    page.tree.open(side);
    page.begin_panel("facts");
    side_rows(b);
    page.tree.close();
    if (b.view.stage == TechnicianStage::Rectified) pair_buttons(b);
    page.tree.close();
    page.tree.close();
  }
  b.stick_state();
  b.capture_buttons(false, true);
}

}  // namespace relievo::ui
