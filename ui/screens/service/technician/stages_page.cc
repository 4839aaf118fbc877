// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every stage of the test capture as a picture: the pair with its epipolar lines, where a touch shows a
// point's partner and pairs are made by hand; the matches in the colours of the rules; depth, points, surface
// with what the pairs by hand moved of it, texture.
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

constexpr int kLines = 8;
constexpr Colour kFaint{255, 255, 255, 70}, kTouched{255, 170, 40, 255}, kOther{110, 210, 255, 255};

bool is_pair(TechnicianStage stage) {
  return stage == TechnicianStage::Input || stage == TechnicianStage::Processed ||
         stage == TechnicianStage::Rectified;
}

bool makes_pairs(const TechnicianFrame& f) {
  return f.seen.by_hand && f.seen.stage == TechnicianStage::Rectified;
}

void tabs(TechnicianFrame& f) {
  const bool narrow = f.portrait && f.large_words();  // for long words
  const std::size_t across = narrow ? 3 : f.across(kTechnicianStages);
  f.in_rows(kTechnicianStages, across, 6, [&](std::size_t i) {
    const auto stage = static_cast<TechnicianStage>(i);
    const bool chosen = stage == f.seen.stage;
    Node tab = centred(f.grown(f.box(Flow::Row, 0, 4, 4)));
    tell(tab, Role::Button, f.id("stage", i), title_of(f.tr, stage), ShowStage{stage});
    frame(tab, chosen ? f.palette.accent : f.palette.quiet,
          chosen ? f.palette.accent : f.palette.quiet_border, f.px(2), f.px(14));
    tab.box.min_height = f.px(size::kStaffTarget);
    const auto in_tab = f.tree.inside(tab);
    f.write(title_of(f.tr, stage), f.portrait ? 16 : 17, chosen ? Weight::Bold : Weight::Medium,
            chosen ? f.palette.accent_ink : f.palette.link, TextAlign::Centre);
  });
}

void pin_pairs(TechnicianFrame& f, std::size_t side) {
  for (const TechnicianPoint& p : f.seen.pairs.first(std::min(f.seen.pairs.size(), kMostPairs)))
    if (side == 0 || p.matched) f.pin_dot(side == 0 ? p.left_x : p.right_x, p.y, kOther, {});
}

void pair_pictures(TechnicianFrame& f) {
  const bool touchable = f.seen.stage == TechnicianStage::Rectified;
  const auto in_row = f.tree.inside(left_first(f.grown(f.box(Flow::Row, space::kS), f.picture_share(2.4F))));
  for (std::size_t side = 0; side < 2; ++side) {
    Action action{}, dragged{};
    if (touchable) action = TouchPicture{side != 0, false};
    if (makes_pairs(f)) dragged = TouchPicture{side != 0, true};
    f.open_picture(side == 0 ? "left" : "right", f.camera_name(side), f.seen.shown[side], f.slot_of(side),
                   action, dragged);
    if (f.seen.stage != TechnicianStage::Input) {
      for (int i = 1; i < kLines; ++i) f.pin_line(float(i) / kLines, kFaint, 1);
    }
    if (makes_pairs(f)) pin_pairs(f, side);
    const TechnicianPoint& point = f.seen.point;
    if (touchable && point.touched) f.pin_line(point.y, kTouched, 2);
    if (touchable && point.touched && side == 0) f.pin_dot(point.left_x, point.y, kTouched, "left mark");
    if (touchable && point.matched && side == 1) f.pin_dot(point.right_x, point.y, kTouched, "right mark");
    f.tree.close();
  }
}

void one_picture(TechnicianFrame& f) {
  const auto in_row = f.tree.inside(f.grown(f.box(Flow::Row, space::kS), f.picture_share(2.4F)));
  f.open_picture("picture", title_of(f.tr, f.seen.stage), f.seen.shown[0], PictureSlot::TechnicianLeft);
  f.tree.close();
  if (!f.seen.shown[1].pixels.empty()) {
    const bool poses = f.seen.stage == TechnicianStage::Poses;
    f.open_picture("change", poses ? f.tr("Difference") : f.tr("Surface moved"), f.seen.shown[1],
                   PictureSlot::TechnicianRight);
    f.tree.close();
  }
}

std::string_view coordinates(TechnicianFrame& f, const pipeline::Vec2f& px) {
  return f.several({double(px.x), double(px.y)}, 2, "px");
}

std::string_view plus_minus(TechnicianFrame& f, double value, double sigma, int decimals,
                            const char* unit_name) {
  return f.left_to_right({f.number(value, decimals), "\u00a0±\u00a0", f.number(sigma, decimals, unit_name)});
}

void point_rows(TechnicianFrame& f) {
  const TechnicianPoint& point = f.seen.point;
  if (!point.touched) {
    return f.note(
        f.seen.by_hand
            ? f.tr(
                  "Touch a point in the left picture. Its partner is proposed in the right one: touch or drag to correct it.")
            : f.tr("Touch the left picture: the line and the match of that point are shown."));
  }
  f.row("point left", f.tr("Left camera"), coordinates(f, point.left_px));
  if (point.waits_for_right) {
    f.write(f.tr("Now touch its partner on the orange line in the right picture."), type::kSmall,
            Weight::Medium, f.palette.ink);
    return;
  }
  if (!point.matched) return f.row("point none", f.tr("No match here"), {}, Mood::Warn);
  if (point.new_surface) f.row("point moved", f.tr("New surface"), f.tr("yes"), Mood::Good);
  else if (!std::isnan(point.moved_mm))
    f.row("point moved", f.tr("Surface came nearer by"), f.number(point.moved_mm, 2, "mm"));
  f.row("point right", f.tr("Right camera"), coordinates(f, point.right_px));
  f.row("point disparity", f.tr("Disparity"),
        plus_minus(f, double(point.disparity_px), double(point.sigma_px), 2, "px"));
  f.row("point likeness", f.tr("Similarity"), f.number(1 - double(point.cost), 3));
  if (!point.rejected_by.empty())
    f.row("point rejected", f.tr("Rejected by"), f.rule_name(point.rejected_by), Mood::Bad);
  else if (!point.by_hand) f.row("point accepted", f.tr("Verdict"), f.tr("Good"), Mood::Good);
  f.row("point space", f.tr("In space"),
        f.several({double(point.at_mm.x), double(point.at_mm.y), double(point.at_mm.z)}, 1, "mm"));
  f.row("point sigma", f.tr("Depth uncertainty"), f.number(point.sigma_mm, 3, "mm"));
}

void change_rows(TechnicianFrame& f) {
  const auto pairs = std::ranges::count_if(f.seen.pairs, &TechnicianPoint::matched);  // the others wait
  if (pairs == 0) return;
  f.rule();
  f.row("pairs", f.tr("Match by hand"), f.number(pairs));
  const TechnicianChange& change = f.seen.change;
  if (!change.known) return;
  f.row("moved", f.tr("Surface moved"), f.number(change.moved_mm2, 0, "mm²"));
  f.row("new", f.tr("New surface"), f.number(change.new_mm2, 0, "mm²"));
  f.row("farthest", f.tr("Largest move"), f.number(change.farthest_mm, 2, "mm"));
  if (f.seen.stage == TechnicianStage::Mesh) f.scale_words(change.full_colour_mm);
}

// How each pose was turned, and by how much it differs from each of the others.
void pose_rows(TechnicianFrame& f) {
  if (f.seen.pose_count == 0)
    return f.note(f.tr(
        "Turn the head a little and add a side, up to four times; then calculate again: all become one head."));
  for (std::size_t b = 0; b < f.seen.pose_count; ++b) {
    const TechnicianPose& pose = f.seen.poses[b];
    const auto number = [&](std::size_t of) { return f.number(of + 1); };
    f.section(f.filled("{}: {}", {number(b), f.number(pose.turned_deg, 1, "°")}));
    if (!pose.joined) f.row(f.id("left out", b), f.tr("No match here"), {}, Mood::Bad);
    for (std::size_t a = 0; a < f.seen.pose_count; ++a)
      if (pose.rms_mm[a] > 0)
        f.row(f.id(f.id("agrees", b), a), f.left_to_right({number(b), "\u00a0–\u00a0", number(a)}),
              f.number(pose.rms_mm[a], 3, "mm"));
  }
  f.scale_words(f.seen.full_residual_mm);
}

void pair_buttons(TechnicianFrame& f) {
  f.choice("by hand", f.tr("Match by hand"), f.seen.by_hand, TechnicianAct::ByHand, 0);
  if (!f.seen.by_hand) return;
  if (f.seen.point.touched)
    f.small_button("remove pair", f.tr("Remove this pair"), icon::kClose, ButtonLook::Quiet,
                   TechnicianAct::RemovePair);
  if (f.seen.pairs_changed)
    f.small_button("run pairs", f.tr("Calculate again"), icon::kAgain, ButtonLook::Main, RunStages{});
}

void rule_rows(TechnicianFrame& f) {
  const TechnicianResult& r = f.seen.result;
  f.row("matches", f.tr("Matches"), f.number(r.matches));
  f.row("accepted", f.tr("Accepted matches"), f.number(r.accepted));
  f.section(f.tr("Rejected by"));
  for (std::size_t i = 0; i < r.rule_count; ++i) {
    const TechnicianRule& rule = r.rules[i];
    Node row = f.row_box(space::kS, 0, 6);
    row.id = f.id("rule", i);
    const auto in_row = f.tree.inside(row);
    f.tree.leaf(
        f.painted(f.sized(f.box(Flow::Column), 26, 26), {rule.rgb[0], rule.rgb[1], rule.rgb[2], 255}, 6));
    f.wide(f.text(f.rule_name(rule.name), type::kSmall, Weight::Medium, f.palette.ink));
    f.write(f.number(rule.rejected), type::kSmall, Weight::Regular, f.palette.ink_soft);
  }
}

// How uncertain the surface is, of every hundred of its points.
void sigma_plot(TechnicianFrame& f) {
  const TechnicianResult& r = f.seen.result;
  if (r.coverage <= 0) return;
  const auto mm = [&](std::size_t bin) { return f.number(double(kSigmaBinMm) * double(bin), 2, "mm"); };
  std::array<std::string_view, kSigmaBins> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = mm(i);
  Plot plot;
  plot.id = "sigma", plot.title = f.tr("Median uncertainty");
  plot.figure = f.number(r.median_sigma_mm, 3, "mm");
  plot.values = r.sigma_percent, plot.names = names, plot.unit = "%";
  plot.under = {mm(0), {}, mm(kSigmaBins)};
  f.plot(plot);
}

void time_rows(TechnicianFrame& f) {
  const TechnicianResult& r = f.seen.result;
  for (std::size_t i = 0; i < r.seconds.size(); ++i) {
    f.row(f.id("time", i), work_of(f.tr, i), f.number(r.seconds[i], 2, "s"));
    f.row(f.id("made", i), made_by(f.tr, i), f.number(r.made[i]));
  }
}

void side_rows(TechnicianFrame& f) {
  f.failure();
  if (f.seen.stage == TechnicianStage::Rectified) {
    point_rows(f);
    return change_rows(f);
  }
  if (f.seen.stage == TechnicianStage::Mesh) change_rows(f);
  if (f.seen.stage == TechnicianStage::Matches) return rule_rows(f);
  if (f.seen.stage == TechnicianStage::Poses) return pose_rows(f);
  if (f.seen.stage >= TechnicianStage::Cloud) sigma_plot(f);
  time_rows(f);
}

}  // namespace

void technician_stages_page(TechnicianFrame& f) {
  if (f.seen.saved.listed) return f.saved_list(false);
  const bool there = f.capture_state();
  if (there) {
    tabs(f);
    const auto in_box = f.tree.inside(f.grown(f.abreast_box(space::kM)));
    if (is_pair(f.seen.stage)) pair_pictures(f);
    else one_picture(f);
    const auto in_side = f.tree.inside(f.grown(f.box(Flow::Column, space::kXs)));
    f.begin_panel("facts");
    side_rows(f);
    f.tree.close();
    if (f.seen.stage == TechnicianStage::Rectified) pair_buttons(f);
  }
  f.stick_state();
  f.capture_buttons(false, true);
}

}  // namespace relievo::ui
