// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/judgement.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr double kFillsMiddle = 0.4;  // too near for a whole face, or a face of which light leaves nothing

struct Judge {
  const GateMeasures& m;
  Advice said;
  static constexpr GateLimits l{};

  // While it is said, an advice holds from a little before its limit on.
  bool above(double value, double limit, Advice advice) const {
    return value > (said == advice ? limit * l.leave : limit);
  }
  bool strays(double value, double limit, Advice advice) const {
    return std::abs(value) > (said == advice ? limit * l.leave_pose : limit);
  }
  bool below(double value, double limit, Advice advice) const {
    return value < (said == advice ? limit / l.leave : limit);
  }

  // The relief knows no head: what can be said of the picture alone.
  Advice without_head() const {
    if (m.picture_dark_share > 0.97) return Advice::TooDark;
    if (m.middle_near_share > kFillsMiddle) return Advice::TooClose;
    if (m.middle_bright_share > kFillsMiddle) return Advice::TooBright;
    if (m.faces == 0)
      return m.somebody_right != 0 || m.somebody_down != 0 ? Advice::OffCentre : Advice::NoFace;
    if (m.guessed_mm < l.nearest_mm) return Advice::TooClose;
    if (m.guessed_mm > l.farthest_mm) return Advice::TooFar;
    return Advice::NoFace;
  }
  Advice distance() const {
    const double z = m.head.tip_mm.z, slack = 20;
    if (z < l.nearest_mm + (said == Advice::TooClose ? slack : 0)) return Advice::TooClose;
    if (z > l.farthest_mm - (said == Advice::TooFar ? slack : 0)) return Advice::TooFar;
    return Advice::None;
  }
  // Pictures of which neither place nor pose can be told. A face that moves fast is blurred because it moves.
  Advice lost() const {
    if (m.light.known && m.light.luminance_mean < l.lost_dark_mean) return Advice::TooDark;
    if (m.light.known && m.light.bright_share > l.lost_bright_share) return Advice::TooBright;
    if (m.blur_mm > l.lost_blur_mm && m.speed_mm_s < l.lost_below_mm_s) return Advice::Blurred;
    return Advice::None;
  }
  // Of a face that something covers neither tip nor pose can be told.
  Advice covered() const {
    return above(m.covered_share, l.covered_share, Advice::FaceHidden) ? Advice::FaceHidden : Advice::None;
  }
  // Neither its place nor its roll can be told of such a head.
  Advice turned_far() const { return m.turned_far ? Advice::TurnedAside : Advice::None; }
  Advice middle() const {
    if (strays(m.off_right_mm, l.off_right_mm, Advice::OffCentre) ||
        strays(m.off_down_mm, l.off_down_mm, Advice::OffCentre))
      return Advice::OffCentre;
    return Advice::None;
  }
  Advice pose() const {
    if (m.head.relief_mm < l.relief_mm) return Advice::FaceHidden;  // something flat is before it
    if (strays(m.head.yaw_deg, l.yaw_deg, Advice::TurnedAside)) return Advice::TurnedAside;
    if (strays(m.head.pitch_deg, l.pitch_deg, Advice::LooksUpOrDown)) return Advice::LooksUpOrDown;
    if (strays(m.head.roll_deg, l.roll_deg, Advice::Tilted)) return Advice::Tilted;
    if (above(m.speed_mm_s, l.speed_mm_s, Advice::Moved) || above(m.turn_deg_s, l.turn_deg_s, Advice::Moved))
      return Advice::Moved;
    return Advice::None;
  }
  Advice light() const {
    const FaceLight& f = m.light;
    if (!f.known) return Advice::NoFace;
    if (below(f.luminance_mean, l.darkest_mean, Advice::TooDark) ||
        above(f.dark_share, l.dark_share, Advice::TooDark))
      return Advice::TooDark;
    if (above(f.luminance_mean, l.brightest_mean, Advice::TooBright) ||
        above(f.bright_share, l.bright_share, Advice::TooBright))
      return Advice::TooBright;
    if (f.side_ratio < (said == Advice::UnevenLight ? l.side_ratio / l.leave_sides : l.side_ratio))
      return Advice::UnevenLight;
    if (above(f.glossy_share, l.glossy_share, Advice::Highlights)) return Advice::Highlights;
    if (above(m.blur_mm, l.blur_mm, Advice::Blurred)) return Advice::Blurred;
    return Advice::None;
  }
  Advice cover() const {
    const HeadMeasurement& h = m.head;
    const bool hidden = above(h.in_front_share, l.in_front_share, Advice::FaceHidden) ||
                        above(h.unknown_share, l.unknown_share, Advice::FaceHidden) ||
                        above(h.asymmetry_mm, l.asymmetry_mm, Advice::FaceHidden);
    return hidden ? Advice::FaceHidden : Advice::None;
  }
  // Light from one side takes most of one iris's contrast, not of both: one eye alone is closed only where
  // hardly anything is left.
  bool closed() const {
    double better = -1, worse = 1;
    for (const EyeMeasurement& eye : m.eyes)
      if (eye.known) better = std::max(better, eye.contrast), worse = std::min(worse, eye.contrast);
    return better > -1 && (below(better, l.iris_contrast, Advice::EyesClosed) ||
                           below(worse, l.one_eye_share * better, Advice::EyesClosed));
  }
  // Of an eye that something hides nobody can tell whether it is open.
  Advice eyes() const {
    for (const EyeMeasurement& eye : m.eyes)
      if (eye.known && below(eye.brightness, l.eye_brightness, Advice::EyesHidden)) return Advice::EyesHidden;
    const bool glare = std::ranges::any_of(m.eyes, [&](const EyeMeasurement& eye) {
      return eye.known && above(eye.glare_mm2, l.glare_mm2, Advice::GlassesGlare);
    });
    if (!glare && closed()) return Advice::EyesClosed;
    return glare ? Advice::GlassesGlare : Advice::None;
  }
  Advice mouth() const {
    const MouthMeasurement& mouth = m.mouth;
    if (!mouth.known) return Advice::None;
    const bool open = above(mouth.dark_mm2, l.dark_mm2, Advice::MouthOpen) ||
                      above(mouth.steps_mm, l.steps_mm, Advice::MouthOpen) ||
                      above(mouth.before_mm, l.before_mm, Advice::MouthOpen);
    if (open) return Advice::MouthOpen;
    return above(mouth.rise_mm, l.rise_mm, Advice::NotNeutral) ? Advice::NotNeutral : Advice::None;
  }
  Advice beside() const {
    return above(m.beside_share, l.beside_share, Advice::Background) ? Advice::Background : Advice::None;
  }
};

}  // namespace

Advice judge(const GateMeasures& measures, Advice said) {
  const Judge judge{measures, said};
  if (!measures.head.known) return judge.without_head();
  if (measures.faces > 1) return Advice::MoreThanOneFace;
  for (const Advice advice :
       {judge.distance(), judge.lost(), judge.covered(), judge.turned_far(), judge.middle(), judge.pose(),
        judge.light(), judge.cover(), judge.eyes(), judge.mouth(), judge.beside()})
    if (advice != Advice::None) return advice;
  return measures.tracked ? Advice::NoFace : Advice::None;
}

}  // namespace relievo::pipeline
