// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/backdrop_maker.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/lattice/head_chart.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kStepMm = 5;  // on the chart
constexpr double kAsideMm = 160, kAboveMm = 165, kBelowMm = 190;
constexpr int kColumns = int(2 * kAsideMm / kStepMm) + 1, kRows = int((kAboveMm + kBelowMm) / kStepMm) + 1;
constexpr std::size_t kVertices = kColumns * kRows;
constexpr Vec3d kHeadMm{0, 20, -95}, kHalfMm{80, 118, 95};  // the ellipsoid, in the head's frame
constexpr double kBehindMm = -120;                          // beyond it a plane
constexpr float kUnderFaceMm = 3;
constexpr int kRounds = 150;
constexpr float kPull = 0.02F;  // to the rough shape, against the neighbours'
constexpr float kClearMm = 25, kGoneMm = 100, kDimMm = 40, kDimmed = 0.6F;
constexpr float kTurned = 0, kFacing = 0.25F;  // cosines to the camera
constexpr int kAbout = 5;                      // steps over which it is looked at how the shape turns
constexpr float kBlurMm = 5;
constexpr int kTaps = 5;  // samples a side over that
// Beside the jaw is the neck, or the room: what the chart's outermost columns show there.
constexpr int kRoomColumns = 3;
constexpr float kRoomFromMm = 20, kRoomToMm = 90;  // below about the tip of the nose
constexpr float kLevels = 8, kShare = 0.2F;        // by which the room's colour varies

float smooth_step(float from, float to, float at) {
  const float t = std::clamp((at - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

class Maker {
 public:
  Maker(const FaceMesh& mesh, const RigidTransform& head_from_camera, const RectifiedPair& pair,
        StageContext& context)
      : pair_(pair),
        chart_(head_from_camera),
        radius_(kVertices, 0.0F, &context.scratch),
        away_mm_(kVertices, 1e6F, &context.scratch),
        made_(&context.output) {
    for (const Vec3f& v : mesh.vertices_mm) {
      const Vec3f from_centre = minus(v, narrow(chart_.centre_mm));
      const Vec2d at = chart_.place(from_centre);
      const long c = std::lround((at.x + kAsideMm) / kStepMm), r = std::lround((at.y + kAboveMm) / kStepMm);
      if (c < 0 || r < 0 || c >= kColumns || r >= kRows) continue;
      const std::size_t k = index(int(c), int(r));
      radius_[k] = std::max(radius_[k], length(from_centre) - kUnderFaceMm);
      away_mm_[k] = 0;
    }
  }

  Backdrop make(Arena& scratch) {
    measure_distance();
    shape(scratch);
    made_.columns = kColumns;
    made_.rows = kRows;
    made_.at_mm.resize(kVertices);
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c)
        made_.at_mm[index(c, r)] =
            plus(chart_.at(place(c, r), double(radius_[index(c, r)])), narrow(chart_.centre_mm));
    find_room();
    made_.rgba.resize(kVertices);
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c) made_.rgba[index(c, r)] = colour(c, r);
    return std::move(made_);
  }

 private:
  static std::size_t index(int c, int r) { return std::size_t(r * kColumns + c); }
  Vec2d place(int c, int r) const { return {c * kStepMm - kAsideMm, r * kStepMm - kAboveMm}; }
  bool face(std::size_t k) const { return away_mm_[k] <= 0; }

  // Two sweeps over eight neighbours.
  void measure_distance() {
    const float step = float(kStepMm), askew = step * 1.4142F;
    const auto take = [&](int c, int r, int dc, int dr) {
      if (c + dc < 0 || r + dr < 0 || c + dc >= kColumns || r + dr >= kRows) return;
      away_mm_[index(c, r)] = std::min(away_mm_[index(c, r)],
                                       away_mm_[index(c + dc, r + dr)] + (dc != 0 && dr != 0 ? askew : step));
    };
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c)
        take(c, r, -1, 0), take(c, r, 0, -1), take(c, r, -1, -1), take(c, r, 1, -1);
    for (int r = kRows; r-- > 0;)
      for (int c = kColumns; c-- > 0;)
        take(c, r, 1, 0), take(c, r, 0, 1), take(c, r, 1, 1), take(c, r, -1, 1);
  }

  // From the chart's centre to the ellipsoid's front, or to the plane behind.
  float rough_radius(int c, int r) const {
    const auto in_halves = [](const Vec3d& v) {
      return Vec3d{v.x / kHalfMm.x, v.y / kHalfMm.y, v.z / kHalfMm.z};
    };
    const Vec3d d = apply(chart_.head_from_axes, wide(chart_.at(place(c, r), 1)));
    const Vec3d e = in_halves(d), o = in_halves(minus(HeadChart::kCentreMm, kHeadMm));
    const double a = dot(e, e), b = dot(o, e), rest = b * b - a * (dot(o, o) - 1);
    const double plane = (kBehindMm - HeadChart::kCentreMm.z) / std::max(d.z, 0.2);
    return float(rest > 0 ? std::max(plane, (-b + std::sqrt(rest)) / a) : plane);
  }
  void shape(Arena& scratch) {
    std::pmr::vector<float> rough(kVertices, 0.0F, &scratch);
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c) {
        rough[index(c, r)] = rough_radius(c, r);
        if (!face(index(c, r))) radius_[index(c, r)] = rough[index(c, r)];
      }
    for (int round = 0; round < kRounds; ++round)
      for (int r = 0; r < kRows; ++r)
        for (int c = 0; c < kColumns; ++c) {
          const std::size_t k = index(c, r);
          if (face(k)) continue;
          const float around =
              radius_[index(std::max(c - 1, 0), r)] + radius_[index(std::min(c + 1, kColumns - 1), r)] +
              radius_[index(c, std::max(r - 1, 0))] + radius_[index(c, std::min(r + 1, kRows - 1))];
          radius_[k] = (around / 4 + kPull * rough[k]) / (1 + kPull);
        }
  }

  float facing(int c, int r) const {
    const auto at = [&](int x, int y) {
      return made_.at_mm[index(std::clamp(x, 0, kColumns - 1), std::clamp(y, 0, kRows - 1))];
    };
    const Vec3f n =
        unit(cross(minus(at(c + kAbout, r), at(c - kAbout, r)), minus(at(c, r + kAbout), at(c, r - kAbout))));
    return std::abs(dot(n, unit(at(c, r))));
  }

  // What the photograph shows there and around it, and how many of the samples it has.
  struct Seen {
    std::array<float, 3> sum{};
    int taps = 0;
  };
  Seen photograph(std::size_t k) const {
    Seen seen;
    const Vec3d p = apply(pair_.rectified_from_left, wide(made_.at_mm[k]));
    if (p.z <= 0) return seen;
    const double scale = pair_.focal_px / p.z;
    for (int j = 0; j < kTaps; ++j)
      for (int i = 0; i < kTaps; ++i) {
        const auto aside = [&](int n) { return (2.0 * n / (kTaps - 1) - 1) * double(kBlurMm); };
        const long x = std::lround(pair_.left_centre_px.x + scale * (p.x + aside(i))),
                   y = std::lround(pair_.left_centre_px.y + scale * (p.y + aside(j)));
        if (x < 0 || y < 0 || x >= pair_.width_px || y >= pair_.height_px) continue;
        const std::size_t at = pair_.index(int(x), int(y));
        if (!pair_.left.valid.empty() && pair_.left.valid[at] == 0) continue;
        for (std::size_t n = 0; n < 3; ++n) seen.sum[n] += float(pair_.left.rgb[3 * at + n]);
        ++seen.taps;
      }
    return seen;
  }

  // What is seen far beside the jaw, on either side.
  void find_room() {
    for (int side = 0; side < 2; ++side) {
      Seen& room = room_[std::size_t(side)];
      for (int r = 0; r < kRows; ++r)
        for (int i = 0; i < kRoomColumns; ++i) {
          const int c = side == 0 ? i : kColumns - 1 - i;
          if (const double below = place(c, r).y; below < kRoomFromMm || below > kRoomToMm) continue;
          const Seen seen = photograph(index(c, r));
          for (std::size_t n = 0; n < 3; ++n) room.sum[n] += seen.sum[n];
          room.taps += seen.taps;
        }
    }
  }

  // 0 beside the jaw where what is shown looks like the room beside it: it would stain the face.
  float belongs(int c, int r, const Seen& seen) const {
    const Seen& room = room_[c < kColumns / 2 ? 0 : 1];
    if (room.taps == 0) return 1;
    float unlike = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      const float there = room.sum[n] / float(room.taps), here = seen.sum[n] / float(seen.taps);
      unlike = std::max(unlike, std::abs(here - there) / (kLevels + kShare * there));
    }
    const float below = smooth_step(0, kRoomFromMm, float(place(c, r).y));
    return 1 - below * (1 - smooth_step(1, 2, unlike));
  }

  std::array<std::uint8_t, 4> colour(int c, int r) const {
    const std::size_t k = index(c, r);
    const Seen seen = photograph(k);
    if (seen.taps == 0) return {};
    const float away = away_mm_[k];
    const float light = 1 - (1 - kDimmed) * smooth_step(0, kDimMm, away);
    const float beside = smooth_step(0, kDimMm, away);  // what continues the rim is shown however it turns
    const float faces = 1 - beside * (1 - smooth_step(kTurned, kFacing, facing(c, r)));
    const int to_edge = std::min({c, r, kColumns - 1 - c, kRows - 1 - r});
    const float opacity = (1 - smooth_step(kClearMm, kGoneMm, away)) *
                          smooth_step(0, kDimMm, float(to_edge * kStepMm)) * faces * belongs(c, r, seen) *
                          float(seen.taps) / (kTaps * kTaps);
    std::array<std::uint8_t, 4> rgba{};
    for (std::size_t n = 0; n < 3; ++n)
      rgba[n] = std::uint8_t(std::lround(light * seen.sum[n] / float(seen.taps)));
    rgba[3] = std::uint8_t(std::lround(255 * opacity));
    return rgba;
  }

  const RectifiedPair& pair_;
  HeadChart chart_;
  std::pmr::vector<float> radius_;   // of a vertex, from the chart's centre
  std::pmr::vector<float> away_mm_;  // from the face; 0 on it
  std::array<Seen, 2> room_{};       // at the left and the right
  Backdrop made_;
};

}  // namespace

Backdrop make_backdrop(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                       const RectifiedPair& pair, StageContext& context) {
  if (pair.left.rgb.empty()) return Backdrop(&context.output);
  return Maker(mesh, head_from_camera, pair, context).make(context.scratch);
}

}  // namespace relievo::pipeline
