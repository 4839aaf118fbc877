// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <span>

#include "hal/base/statistics.h"
#include "pipeline/mesh/completion/generic_head.h"
#include "pipeline/mesh/landmarks/face_profile.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/lattice/surface_shaping.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/mesh/triangle_raster.h"

namespace relievo::pipeline {
namespace {

constexpr int kEvery = 3;  // nodes of the lattice a node of the rough surface that shows where the head is
constexpr float kRoomMm = 25;     // on the chart, around what was measured
constexpr float kReachMm = 35;    // from what either side shows a face is continued to its outline, at most
constexpr float kSeamMm = 6;      // between what one side and what the generic head say
constexpr float kNoseSeamMm = 1;  // the same below the tip of the nose; less shows the step between both
constexpr double kHeadCellMm = 2, kHeadMisfitMm = 1.5;
constexpr double kAboveJawMm = -35;  // from the tip of the nose: jaws differ too much
constexpr float kUnsureMm = 8;       // of the outline, where that is only known about
constexpr float kSoftMm = 1.2F;      // on either side of where a completed part begins
constexpr float kSoftMm2 = 150;      // of a part that is no opening of lips or lids
constexpr float kLikely = 2;         // sigmas
constexpr float kRimMm = 2;          // so near to a hole ...
constexpr float kCrumbMm = 1;        // half the width of the narrowest strip that stays
constexpr double kLeastPart = 0.05;  // of the surface: what is smaller and by itself is a crumb
constexpr float kSteepRim = 1.5F;    // ... surface steeper than this tangent was measured worst
constexpr double kUnsure = 6;        // times the usual sigma: in the lower face that is no skin
constexpr double kBelowTipMm = 2;    // of a nose begins the lower face
constexpr double kStepCells = 8;     // of radius between neighbours, in widths of a cell: more is no slope
constexpr double kChinBelowPogonion = 22;
constexpr double kBelowChin = 1;  // of the lowest skin of it that was seen: what follows is throat
constexpr double kChinHalf = 4;   // of its width, on which its end is looked for
constexpr double kChinFrom = -55, kChinGap = 10;  // below the tip of the nose; of what is still the same chin
constexpr double kShortest = 70, kLongest = 110;  // of what lies below the tip of a nose

// Nostrils, wings and what is between them and the lip: both sides hide there what the other would tell.
bool below_nose(const PointLattice& l, const Vec3f& p) {
  const Vec3d at = l.chart->in_head(p);
  return std::abs(at.x) < 25 && at.y < kBelowTipMm && at.y > -22;
}

// The measured surface, thinned out.
FaceMesh rough_surface(const PointLattice& l, Arena& scratch) {
  FaceMesh mesh(&scratch);
  std::pmr::vector<std::uint32_t> number(l.size(), 0, &scratch);
  for (int r = 0; r < l.rows; r += kEvery)
    for (int c = 0; c < l.columns; c += kEvery) {
      const std::size_t k = l.index(c, r);
      if (l.node[k] != Node::Measured) continue;
      number[k] = add_vertex(mesh, {l.at_mm[k], l.sigma_mm[k], 1}) + 1;
    }
  const auto whole = [&](int c, int r) {
    for (int y = r; y < r + kEvery; ++y)
      for (int x = c; x < c + kEvery; ++x)
        if (triangle_count(l.cells[l.index(x, y)]) != 2) return false;
    return true;
  };
  for (int r = 0; r + kEvery < l.rows; r += kEvery)
    for (int c = 0; c + kEvery < l.columns; c += kEvery) {
      const std::uint32_t a = number[l.index(c, r)], b = number[l.index(c + kEvery, r)];
      const std::uint32_t o = number[l.index(c, r + kEvery)], d = number[l.index(c + kEvery, r + kEvery)];
      if (a == 0 || b == 0 || o == 0 || d == 0 || !whole(c, r)) continue;
      mesh.triangles.push_back({a - 1, o - 1, d - 1});
      mesh.triangles.push_back({a - 1, d - 1, b - 1});
    }
  compute_normals(mesh, 1, &scratch);
  return mesh;
}

FaceOutline outline_of(const PointLattice& seen, const FaceMesh& rough,
                       const RigidTransform& head_from_camera, Arena& scratch) {
  FaceOutline outline{HeadChart(head_from_camera)};
  const auto profile = profile_of(rough, head_from_camera, &scratch);
  const ProfileMarks marks = find_profile_marks(profile);
  const auto chin = marks.chin_recedes ? std::nullopt : marks.chin;
  if (chin) outline.below_mm = kChinBelowPogonion - chin->y_mm;
  const double from = chin ? chin->y_mm : kChinFrom;
  // Where the skin ends that was seen of a chin, or where that should begin; the profile runs upwards.
  double lowest = from;
  for (auto at = profile.rbegin(); at != profile.rend(); ++at)
    if (at->y_mm < lowest && at->y_mm > lowest - kChinGap) lowest = at->y_mm;
  // The rough surface ends up to a whole block earlier than what was measured.
  const double ends_early = lowest - kEvery * double(seen.cell_height_mm) - 1;
  for (int r = 0; r < seen.rows && lowest < from; ++r)
    for (int c = 0; c < seen.columns; ++c) {
      if (!carries_surface(seen, c, r)) continue;
      const Vec3d at = apply(head_from_camera, wide(seen.at_mm[seen.index(c, r)]));
      if (std::abs(at.x) < kChinHalf && at.y > ends_early) lowest = std::min(lowest, at.y);
    }
  if (lowest < from) outline.below_mm = std::min(outline.below_mm, kBelowChin - lowest);
  outline.below_mm = std::clamp(outline.below_mm, kShortest, kLongest);
  return outline;
}

// The other side of the face: radii at every node, 0 where it shows nothing. Where surface stands before
// surface the step between them is nobody's curvature.
std::pmr::vector<double> mirrored(const PointLattice& l, Arena& scratch) {
  std::pmr::vector<double> radius(l.size(), 0.0, &scratch);
  for (int r = 0; r < l.rows; ++r)
    for (int c = 0; c < l.columns; ++c)
      if (l.node[l.index(c, r)] == Node::Measured && carries_surface(l, c, r))
        radius[l.index(l.columns - 1 - c, r)] = l.radius_mm(l.index(c, r));
  const std::pmr::vector<double> before(radius, &scratch);
  const double most = kStepCells * double(l.cell_width_mm);
  const auto parts = [&](std::size_t a, std::size_t b) {
    return before[a] != 0 && before[b] != 0 && std::abs(before[a] - before[b]) > most;
  };
  for (int r = 0; r + 1 < l.rows; ++r)
    for (int c = 0; c + 1 < l.columns; ++c) {
      const std::size_t k = l.index(c, r), below = l.index(c, r + 1);
      if (parts(k, k + 1)) radius[k] = radius[k + 1] = 0;
      if (parts(k, below)) radius[k] = radius[below] = 0;
    }
  return radius;
}

// Where neither side shows anything, the head that fits what was measured says how skin goes on. Not right
// beside what the other side shows: between both nothing is known of how they meet. Under a nose all is
// beside that, and what a nose looks like is better than a lid from its tip to the lip.
void add_generic_head(const FaceMesh& rough, const RigidTransform& head_from_camera, const PointLattice& l,
                      std::span<double> like, MaskShaper& shaper, Arena& scratch) {
  UnrolledHead head(rough, head_from_camera, kHeadCellMm, scratch);
  fit_generic_face(head, kHeadMisfitMm);
  const FaceRelief& fitted = head.added;
  struct Place {
    Vec2f at;
    float radius_mm = 0;
  };
  const auto place = [&](int c, int r) {
    const Vec3d p = rolled(fitted.x_mm(c), fitted.y_mm(r), double(fitted.z(c, r)));
    const Vec3d from = minus(p, HeadChart::kCentreMm);
    const Vec2d on_chart = HeadChart::place_in_head(from);
    return Place{
        {float((on_chart.x - l.first_mm.x) / l.step_mm), float((on_chart.y - l.first_mm.y) / l.step_mm)},
        float(length(from))};
  };
  std::pmr::vector<float> radius(l.size(), 0.0F, &scratch);
  const auto draw = [&](const Place& a, const Place& b, const Place& c) {
    for_each_texel(a.at, b.at, c.at, l.columns, {0, l.rows}, [&](int x, int y, float wa, float wb, float wc) {
      radius[l.index(x, y)] =
          std::max(radius[l.index(x, y)], wa * a.radius_mm + wb * b.radius_mm + wc * c.radius_mm);
    });
  };
  for (int r = 0; r + 1 < fitted.rows(); ++r)
    for (int c = 0; c + 1 < fitted.columns(); ++c) {
      if (fitted.y_mm(r) < kAboveJawMm ||
          std::isnan(fitted.z(c, r) + fitted.z(c + 1, r) + fitted.z(c, r + 1) + fitted.z(c + 1, r + 1)))
        continue;
      draw(place(c, r), place(c + 1, r), place(c, r + 1));
      draw(place(c + 1, r), place(c + 1, r + 1), place(c, r + 1));
    }
  CellMask shown(l.size(), 0, &scratch);
  for (std::size_t k = 0; k < l.size(); ++k) shown[k] = like[k] > 0;
  CellMask under_nose(shown, &scratch);
  shaper.dilate(shown, kSeamMm);
  shaper.dilate(under_nose, kNoseSeamMm);
  for (std::size_t k = 0; k < l.size(); ++k) {
    const auto at = double(radius[k]);
    if (!(below_nose(l, l.on_ray(k, at)) ? under_nose : shown)[k]) like[k] = at;
  }
}

// Before a gap the last rows of a nose's back, or of a cheek, are what the matcher's window mixed with what
// lies behind: they would bend what is laid over the gap. So would crumbs in it, the flaps that a matcher
// leads into nostrils, and pins of a jaw whose other side was measured well.
void drop_poor_rims(PointLattice& l, const Vec3f& from_mm, MaskShaper& shaper, Arena& scratch) {
  CellMask kept(l.size(), 0, &scratch), near(l.size(), 0, &scratch);
  for (std::size_t k = 0; k < l.size(); ++k) {
    kept[k] = triangle_count(l.cells[k]) == 2;
    near[k] = !kept[k];
  }
  shaper.dilate(near, kRimMm);
  const CellMask steep = steep_cells(l, kSteepRim, from_mm, &scratch);
  std::pmr::vector<float> sigma(&scratch);
  sigma.reserve(l.size());
  for (std::size_t k = 0; k < l.size(); ++k)
    if (kept[k]) sigma.push_back(l.sigma_mm[k]);
  const double most = sigma.empty() ? 0 : kUnsure * median(sigma);
  const auto w = std::size_t(l.columns);
  const auto sigma_at = [&](std::size_t k) {
    return double(std::max({l.sigma_mm[k], l.sigma_mm[k + 1], l.sigma_mm[k + w], l.sigma_mm[k + w + 1]}));
  };
  const auto unsure = [&](std::size_t k) {
    if (sigma_at(k) <= most) return false;
    const std::size_t across = k - k % w + (w - 2 - k % w);  // the other side's cell
    return below_nose(l, l.at_mm[k]) || (triangle_count(l.cells[across]) == 2 && sigma_at(across) <= most &&
                                         l.chart->in_head(l.at_mm[k]).y < kBelowTipMm);
  };
  for (std::size_t k = 0; k < l.size(); ++k) kept[k] = kept[k] && !(near[k] && steep[k]) && !unsure(k);
  shaper.open(kept, kCrumbMm);
  // A noisy matcher's surface may fall into parts here: what lies between them is laid anew.
  shaper.drop_pieces_below(kept, std::size_t(kLeastPart * double(std::ranges::count(kept, 1))));
  for (std::size_t k = 0; k < l.size(); ++k)
    if (!kept[k]) l.cells[k] = 0;
}

// Where a completed part meets the measured surface at a tilt nobody's skin has an edge: a strip along the
// seam is laid anew from both sides. What that moves by no more than is likely stays measured. Not below a
// nose, and not around small parts: nostrils, lips and lids do have edges.
void soften_seams(PointLattice& l, const CellMask& completed, MaskShaper& shaper, Arena& scratch,
                  const std::atomic<bool>& cancelled) {
  CellMask strip(completed, &scratch), measured(l.size(), 0, &scratch);
  shaper.drop_pieces_below(strip, std::size_t(kSoftMm2 / (l.cell_width_mm * l.cell_height_mm)));
  for (std::size_t k = 0; k < l.size(); ++k) measured[k] = !completed[k] && triangle_count(l.cells[k]) == 2;
  shaper.dilate(strip, kSoftMm);
  shaper.dilate(measured, kSoftMm);
  for (std::size_t k = 0; k < l.size(); ++k) {
    strip[k] = strip[k] && measured[k] && triangle_count(l.cells[k]) == 2 && !below_nose(l, l.at_mm[k]);
    if (strip[k]) l.cells[k] = 0;
  }
  const std::pmr::vector<Vec3f> at_mm(l.at_mm, &scratch);
  const std::pmr::vector<float> sigma_mm(l.sigma_mm, &scratch);
  const std::pmr::vector<Node> node(l.node, &scratch);
  fill_cells(l, strip, kSteepest, {}, &scratch, &cancelled);
  for (std::size_t k = 0; k < l.size(); ++k) {
    const float moved = distance(l.at_mm[k], at_mm[k]);
    if (node[k] != Node::Measured || moved > kLikely * sigma_mm[k]) continue;
    l.sigma_mm[k] = std::hypot(sigma_mm[k], moved);
    l.node[k] = node[k];
  }
}

// Surface that the outline's cut will not come near.
void drop_beyond(PointLattice& l, const FaceOutline& outline) {
  for (std::size_t k = 0; k < l.size(); ++k)
    if (l.cells[k] != 0 && outline.depth_mm(l.at_mm[l.node[k] != Node::Empty ? k : k + 1]) < -kRimMm)
      l.cells[k] = 0;
}

// The cells that shall carry surface and do not: what lies within the outline, as far as either side or what
// lies near it tells.
CellMask open_cells(const PointLattice& l, const FaceOutline& outline, std::span<const double> mirror,
                    MaskShaper& shaper, Arena& scratch) {
  std::pmr::vector<double> radius(mirror.begin(), mirror.end(), &scratch);  // about
  std::pmr::vector<std::uint32_t> ring(&scratch), next(&scratch);
  const auto within = [&](std::uint32_t k) { return outline.depth_mm(l.on_ray(k, radius[k])) > -kUnsureMm; };
  for (int r = 1; r + 1 < l.rows; ++r)
    for (int c = 1; c + 1 < l.columns; ++c) {
      const std::uint32_t k = std::uint32_t(l.index(c, r));
      if (carries_surface(l, c, r)) radius[k] = l.radius_mm(k);
      if (radius[k] > 0 && within(k)) ring.push_back(k);
    }
  CellMask open(l.size(), 0, &scratch);
  for (const std::uint32_t k : ring) open[k] = 1;
  const std::uint32_t w = std::uint32_t(l.columns);
  const auto border = [&](std::uint32_t k) {
    return k % w < 2 || k % w + 3 > w || k / w < 2 || k / w + 3 > std::uint32_t(l.rows);
  };
  for (int turns = int(kReachMm / l.cell_width_mm); turns > 0 && !ring.empty(); --turns) {
    next.clear();
    for (const std::uint32_t k : ring)
      for (const std::uint32_t n : {k - 1, k + 1, k - w, k + w}) {
        if (radius[n] > 0 || border(n)) continue;
        radius[n] = radius[k];
        if (!within(n)) continue;
        open[n] = 1;
        next.push_back(n);
      }
    std::swap(ring, next);
  }
  shaper.fill_holes(open);
  for (std::uint32_t k = 0; k < l.size(); ++k)
    open[k] = open[k] && !border(k) && triangle_count(l.cells[k]) != 2;
  return open;
}

}  // namespace

Result<std::optional<ShapedLattice>> close_face(const PointLattice& seen, const Vec3d& right_camera_mm,
                                                const LatticeLimits& limits, StageContext& context) {
  Arena& scratch = context.scratch;
  const FaceMesh rough = rough_surface(seen, scratch);
  const auto head = find_head_frame(rough, context, right_camera_mm);
  if (!head && head.error().code == Errc::Cancelled) return head.error();
  if (!head) return std::optional<ShapedLattice>{};
  const FaceOutline outline = outline_of(seen, rough, head->head_from_camera, scratch);
  PointLattice l = lay_on_head(seen, outline.chart, kRoomMm, context.pool, &scratch);
  if (!(l.cell_width_mm > 0 && l.cell_height_mm > 0)) return std::optional<ShapedLattice>{};
  if (context.stop()) return stopped();
  join_neighbours(l, limits, &scratch);
  MaskShaper shaper(l.columns, l.rows, l.cell_width_mm, l.cell_height_mm, &scratch);
  const Vec3d between_cameras = minus(times(right_camera_mm, 0.5), outline.chart.centre_mm);
  drop_poor_rims(l, narrow(between_cameras), shaper, scratch);
  auto mirror = mirrored(l, scratch);
  if (context.stop()) return stopped();
  add_generic_head(rough, head->head_from_camera, l, mirror, shaper, scratch);
  if (context.stop()) return stopped();
  drop_beyond(l, outline);
  const CellMask open = open_cells(l, outline, mirror, shaper, scratch);
  if (context.stop()) return stopped();
  {
    const Arena::Mark filling(scratch);
    fill_cells(l, open, kSteepest, mirror, &scratch, &context.cancelled);
    if (!context.stop()) soften_seams(l, open, shaper, scratch, context.cancelled);
  }
  if (context.stop()) return stopped();
  drop_beyond(l, outline);
  CellMask inside(l.size(), 0, &scratch);
  for (std::size_t k = 0; k < l.size(); ++k) inside[k] = l.cells[k] != 0;
  shaper.fill_holes(inside);
  return std::optional(ShapedLattice{std::move(l), std::move(inside), outline});
}

}  // namespace relievo::pipeline
