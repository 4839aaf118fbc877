// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/expression/expression_measurement.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "hal/base/statistics.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kHalfWidthMm = 42, kMouthTopMm = 12;
constexpr std::array kBottomsMm{74.0, 67.0,
                                60.0};  // the lowest that the picture still shows: a chin may reach out of it
constexpr double kHighestLineMm = 18, kLowestLineMm = 54;
constexpr std::array kLineStripsMm{-18.0, -13.5, -9.0, -4.5, 0.0,
                                   4.5,   9.0,   13.5, 18.0};  // longer than nostrils and their shade
constexpr std::array kStripsMm{-12.0, -8.0, -4.0, 0.0, 4.0, 8.0, 12.0};  // middles of strips 4 mm wide
constexpr double kStripHalfMm = 2;
constexpr double kBendMm = 2;                  // of the line, from strip to strip
constexpr double kBesideLineMm = 2.5;          // a line is darker than what lies so far above and below
constexpr double kAboveMm = 9, kBelowMm = 17;  // the line: parted lips and what shows between them
constexpr double kDetailMm = 1.5;
constexpr double kLipsMm = 3;  // about the lips' line
constexpr double kLeastTeethMm = 4;
constexpr double kStrongShare = 0.55;  // of the darkest line
constexpr double kInsideShare = 0.25, kEvenShare = 0.8;
constexpr double kCornersBehindMm = 10;  // the corners of a mouth lie so far behind its middle
constexpr double kDarkShare = 0.40;      // of the skin
constexpr double kHalfMouthMm = 24;
constexpr double kThickMm = 2.5;      // thicker than the line of closed lips
constexpr double kLostMm = 9;         // so wide the middle of the line may be too faint to be followed
constexpr double kCornerShare = 0.3;  // of the line in the middle
constexpr std::size_t kRows = 128;

// Luminance from top to bottom of a strip, as shares of the skin's.
struct Profile {
  std::array<double, kRows> value{};
  int rows = 0;
};

Profile profile_of(const FaceWindow& w, double right_mm, double half_mm, double skin) {
  Profile p;
  p.rows = std::min(w.rows, int(kRows));
  const int x0 = std::max(0, int(std::lround(w.column(right_mm - half_mm)))),
            x1 = std::min(w.columns - 1, int(std::lround(w.column(right_mm + half_mm))));
  for (int y = 0; y < p.rows; ++y) {
    double sum = 0;
    for (int x = x0; x <= x1; ++x) sum += double(w.at(x, y));
    p.value[std::size_t(y)] = sum / (skin * std::max(1, x1 - x0 + 1));
  }
  return p;
}

double value(const Profile& p, const FaceWindow& w, double down_mm) {
  return p.value[std::size_t(std::clamp(Relief::nearest(w.row(down_mm)), 0, p.rows - 1))];
}

struct Line {
  double down = 0, strength = -1;
};
Line strongest_line(const Profile& p, const FaceWindow& w, double from, double to) {
  Line best;
  for (double down = from; down <= to; down += FaceWindow::kStepMm) {
    const double beside = std::min(value(p, w, down - kBesideLineMm), value(p, w, down + kBesideLineMm));
    if (const double strength = beside - value(p, w, down); strength > best.strength) best = {down, strength};
  }
  return best;
}

// The line that most strips share, each a little higher or lower.
Line find_line(const FaceWindow& w, double skin) {
  std::array<Profile, kLineStripsMm.size()> strips;
  for (std::size_t i = 0; i < strips.size(); ++i)
    strips[i] = profile_of(w, kLineStripsMm[i], kStripHalfMm, skin);
  Line best;
  for (double down = kHighestLineMm; down <= kLowestLineMm; down += FaceWindow::kStepMm) {
    std::array<double, kLineStripsMm.size()> strengths{};
    for (std::size_t i = 0; i < strips.size(); ++i)
      strengths[i] = strongest_line(strips[i], w, down - kBendMm, down + kBendMm).strength;
    if (const double shared = median(strengths); shared > best.strength) best = {down, shared};
  }
  // All heights within the bend are as good: the middle strip says which.
  const Line middle =
      strongest_line(strips[kLineStripsMm.size() / 2], w, best.down - kBendMm, best.down + kBendMm);
  return {middle.strength > 0 ? middle.down : best.down, best.strength};
}

double darker(const Profile& p, const FaceWindow& w, double down) {
  return (value(p, w, down - kDetailMm) + value(p, w, down + kDetailMm)) / 2 - value(p, w, down);
}

// Is what lies between two dark lines about as bright near both as anywhere? A lip fades into the shade below
// it, teeth do not.
bool even(const Profile& p, const FaceWindow& w, double from, double to) {
  double most = 0;
  for (double down = from + kDetailMm; down <= to - kDetailMm; down += FaceWindow::kStepMm)
    most = std::max(most, value(p, w, down));
  const double inside = kInsideShare * (to - from);
  return std::min(value(p, w, from + inside), value(p, w, to - inside)) >= kEvenShare * most;
}

// Between two thin dark lines with teeth between them, the first of which is the lips' or lies above it: the
// furthest apart, 0 where there are none.
double teeth_between(const Profile& p, const FaceWindow& w, double line) {
  const double top = line - kAboveMm, bottom = line + kBelowMm, step = FaceWindow::kStepMm;
  double most = 0, before = bottom, apart = 0;
  for (double down = top; down <= bottom; down += step) most = std::max(most, darker(p, w, down));
  for (double down = top; down <= bottom; down += step) {
    const double here = darker(p, w, down);
    if (here < kStrongShare * most || here < darker(p, w, down - step) || here <= darker(p, w, down + step))
      continue;
    if (before <= line + kLipsMm && down - before >= kLeastTeethMm && even(p, w, before, down))
      apart = std::max(apart, down - before);
    before = down;
  }
  return apart;
}

// Darker than skin in the shade, and thicker than a line, column by column.
double dark_area(const FaceWindow& w, double line, double skin) {
  const auto level = float(kDarkShare * skin);
  const int y0 = std::max(0, int(w.row(line - kAboveMm / 2))),
            y1 = std::min(w.rows - 1, int(w.row(line + kBelowMm)));
  const int thick = int(kThickMm / FaceWindow::kStepMm);
  int all = 0;
  for (int x = int(w.column(-kHalfMouthMm)); x <= int(w.column(kHalfMouthMm)); ++x) {
    int run = 0;
    for (int y = y0; y <= y1; ++y) {
      const bool dark = w.at(x, y) < level;
      if (!dark || y == y1) all += run >= thick ? run : 0;
      run = dark ? run + 1 : 0;
    }
  }
  return all * FaceWindow::kStepMm * FaceWindow::kStepMm;
}

// Outwards along the line until it is lost.
Vec2d corner(const FaceWindow& w, const Line& middle, double side, double skin) {
  Vec2d end{0, middle.down};
  double down = middle.down;
  for (double out = 2; out <= kHalfWidthMm - 2; out += 1) {
    const Line here = strongest_line(profile_of(w, side * out, 0.5, skin), w, down - 1.5, down + 1.5);
    if (here.strength > kCornerShare * middle.strength) end = {side * out, here.down}, down = here.down;
    else if (out - std::abs(end.x) > (end.x == 0 ? kLostMm : 3)) break;
  }
  return end;
}

// How far behind the tip of the nose the surface lies at a place of the face's middle.
std::optional<double> behind(const FacePhoto& photo, double down_mm) {
  double sum = 0;
  int count = 0;
  for (const double right : {-4.0, -2.0, 0.0, 2.0, 4.0}) {
    const FacePlace place = place_on(photo.relief, photo.head, right, down_mm);
    if (!place.inside || !photo.relief.known(place.x, place.y)) continue;
    const Vec3d p = photo.relief.point(place.x, place.y);
    sum += dot(minus(p, photo.head.tip_mm), photo.head.away);
    ++count;
  }
  return count > 1 ? std::optional(sum / count) : std::nullopt;
}

// The middle of what is known just below the line; 0 where too little is.
double stands_before(const FacePhoto& photo, double line_mm) {
  constexpr std::array kDownMm{4.0, 6.0, 8.0, 10.0, 12.0, 14.0};  // further down the chin begins
  const std::optional<double> lip = behind(photo, line_mm - 6);
  if (!lip) return 0;
  const double slope = std::tan(photo.head.pitch_deg * std::numbers::pi / 180);
  std::array<double, kDownMm.size()> before{};
  before.fill(-1e9);
  std::size_t known = 0;
  for (const double below : kDownMm)
    if (const auto here = behind(photo, line_mm + below))
      before[known++] = *lip - *here + slope * (below + 6);
  if (known < 4) return 0;
  std::ranges::sort(before, std::greater<>());  // what is not known stays behind
  return before[known / 2];
}

}  // namespace

MouthMeasurement measure_mouth(const FacePhoto& photo, StageContext& context) {
  MouthMeasurement mouth;
  const auto cut = [&](double bottom) {
    return cut_window(photo, {-kHalfWidthMm, kHalfWidthMm, kMouthTopMm, bottom}, context);
  };
  FaceWindow w = cut(kBottomsMm[0]);
  for (std::size_t i = 1; i < kBottomsMm.size() && w.empty(); ++i) w = cut(kBottomsMm[i]);
  if (w.empty()) return mouth;
  mouth.known = true;
  const double skin = std::max(1.0, quantile(w, w.box, 0.6, context));
  const Line line = find_line(w, skin);
  std::array<double, kStripsMm.size()> steps{};
  for (std::size_t i = 0; i < kStripsMm.size(); ++i)
    steps[i] = teeth_between(profile_of(w, kStripsMm[i], kStripHalfMm, skin), w, line.down);
  mouth.steps_mm = median(steps);
  mouth.dark_mm2 = dark_area(w, line.down, skin);
  mouth.before_mm = stands_before(photo, line.down);
  const Vec2d a = corner(w, line, -1, skin), b = corner(w, line, 1, skin);
  // Of a head that is bowed, what lies further behind seems lower.
  mouth.rise_mm = line.down - (a.y + b.y) / 2 -
                  kCornersBehindMm * std::tan(photo.head.pitch_deg * std::numbers::pi / 180);
  return mouth;
}

}  // namespace relievo::pipeline
