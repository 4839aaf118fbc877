// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model that fills the page, and what is measured on it.
#include <array>

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

constexpr Colour kLine{255, 170, 40, 255}, kScale{255, 255, 255, 255}, kGround{0, 0, 0, 170};
constexpr float kMargin = 20, kScaleDp = 5, kDotDp = 14, kLineDp = 5, kGroundPadDp = 8;
constexpr int kLineDots = 40;
constexpr float kMostOfWidth = 0.25F;  // of the window, that the scale is long

// The longest round length that has room.
float scale_mm(const FaceRuler& ruler) {
  constexpr std::array kLengths{100.0F, 50.0F, 20.0F, 10.0F, 5.0F, 2.0F, 1.0F};
  for (const float mm : kLengths)
    if (mm * ruler.px_per_mm <= kMostOfWidth * ruler.width_px) return mm;
  return 0;
}

}  // namespace

void TechnicianFrame::face(float share, void (*tools)(TechnicianFrame&), float tools_dp) {
  const auto in_card = tree.inside(stage(size::kRadius, share));
  Node face = model("face", tr("The model: turn it with a finger"), size::kRadius);
  face.ruled = true;
  face.covered_px = px(tools_dp);
  tree.leaf(face);
  ruler();
  if (tools != nullptr) {
    const auto in_box = tree.inside(box(Flow::Column));
    space(1);
    tools(*this);
  }
}

void TechnicianFrame::measure_button(float grow) {
  choice("measure", tr("Distance"), service.ruler.on, ActionKind::StaffMeasure, grow);
}

void TechnicianFrame::ruler() {
  const FaceRuler& ruler = service.ruler;
  if (ruler.px_per_mm <= 0) return;
  tree.leaf(box(Flow::Column));
  const auto dot = [&](const pipeline::Vec2f& at, float dp) {
    tree.mark({{at.x, at.y, 0, 0}, kLine, px(dp), true});
  };
  if (ruler.count == 2)
    for (int i = 1; i < kLineDots; ++i) {
      const float t = float(i) / kLineDots;
      dot({std::lerp(ruler.seen[0].x, ruler.seen[1].x, t), std::lerp(ruler.seen[0].y, ruler.seen[1].y, t)},
          kLineDp);
    }
  for (std::size_t i = 0; i < ruler.count; ++i) dot(ruler.seen[i], kDotDp);
  const float mm = scale_mm(ruler), from = px(kMargin) / ruler.width_px,
              long_share = mm * ruler.px_per_mm / ruler.width_px, y = px(kMargin) / ruler.height_px;
  tree.mark({{mirrored() ? 1 - from - long_share : from, y, long_share, 0}, kScale, px(kScaleDp), false});
  const auto in_corner = tree.inside(
      aligned(box(Flow::Column, 0, kMargin - kGroundPadDp, kMargin + kScaleDp + 2), Align::Start));
  // The words may come to lie on the face.
  const auto in_words = tree.inside(painted(box(Flow::Column, 4, kGroundPadDp, 4), kGround, kGroundPadDp));
  put("scale", Role::Text, number(mm, 0, "mm"), 18, Weight::Medium, kScale);
  if (ruler.on) {
    const bool both = ruler.count == 2;
    put("distance", Role::Status,
        both ? filled("{}: {}", {tr("Distance"), number(ruler.distance_mm(), 1, "mm")})
             : std::string_view(tr("Touch two points of the surface.")),
        type::kSmall, Weight::Medium, kScale);
  }
}

}  // namespace relievo::ui
