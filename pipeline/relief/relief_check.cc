// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/relief/relief_check.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kLeastCells = 200;  // a sixth of the disc
constexpr double kTrusted = 0.75;         // share of the cells that counts: the nearest
constexpr double kSmoothMm = 8;           // narrower than a nose, wider than what noise makes hang together
constexpr double kCurveMm = 12;
constexpr double kTelling = 0.4;        // of the disc: less of a face may be nearly as flat as a sheet
constexpr double kCurveTelling = 0.04;  // of the disc: less of it may curve unlike the rest
constexpr double kFull = 0.8;           // share of a neighbourhood that must have been measured

double rms_of_trusted(std::span<const double> off_mm, Arena& scratch) {
  Arena::Mark mark(scratch);
  std::pmr::vector<double> squares(&scratch);
  squares.reserve(off_mm.size());
  for (const double r : off_mm) squares.push_back(r * r);
  std::ranges::sort(squares);
  const auto count = std::size_t(kTrusted * double(squares.size()));
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += squares[i];
  return std::sqrt(sum / double(count));
}

double median_sigma(const HeightCells& cells, Arena& scratch) {
  Arena::Mark mark(scratch);
  std::pmr::vector<double> sigmas(&scratch);
  sigmas.reserve(cells.size());
  for (const HeightCell& cell : cells) sigmas.push_back(cell.sigma_mm);
  return median(sigmas);
}

// Calls visit(k, dx, dy) for every cell within `reach_mm`; tells whether the neighbourhood is full.
template <typename Visit>
bool around(const HeightCells& cells, const HeightCell& middle, double reach_mm, Visit&& visit) {
  int found = 0;
  const int rows = int(reach_mm / kReliefCellMm) + 1;
  const auto above = std::lower_bound(cells.begin(), cells.end(), middle.row - rows,
                                      [](const HeightCell& c, int row) { return c.row < row; });
  for (auto cell = above; cell != cells.end() && cell->row <= middle.row + rows; ++cell) {
    const double dx = cell->x_mm - middle.x_mm, dy = cell->y_mm - middle.y_mm;
    if (dx * dx + dy * dy > reach_mm * reach_mm) continue;
    visit(std::size_t(cell - cells.begin()), dx, dy);
    ++found;
  }
  return found >= kFull * std::numbers::pi * (reach_mm / kReliefCellMm) * (reach_mm / kReliefCellMm);
}

double range_of(const HeightCells& cells, std::span<const double> off_mm, Arena& scratch) {
  Arena::Mark mark(scratch);
  std::pmr::vector<double> smooth(&scratch);
  smooth.reserve(cells.size());
  for (const HeightCell& cell : cells) {
    double sum = 0;
    int count = 0;
    const bool full =
        around(cells, cell, kSmoothMm, [&](std::size_t k, double, double) { sum += off_mm[k], ++count; });
    if (full) smooth.push_back(sum / count);
  }
  if (smooth.empty()) return 0;
  const double top = percentile(smooth, 0.98);
  return top - percentile(smooth, 0.02);
}

// From the quadratic that fits the heights round each cell best: K dA = (ac - b^2) / (1 + p^2 + q^2)^(3/2) dx
// dy. What has no full neighbourhood curves as the rest does: none where that is too little.
std::optional<double> curvature_of(const HeightCells& cells) {
  using Row = Eigen::Matrix<double, 6, 1>;
  double sum = 0;
  int count = 0;
  for (const HeightCell& cell : cells) {
    Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Zero();
    Row b = Row::Zero();
    const bool full = around(cells, cell, kCurveMm, [&](std::size_t k, double x, double y) {
      Row row;
      row << 1, x, y, x * x / 2, x * y, y * y / 2;
      a += row * row.transpose();
      b += row * cells[k].height_mm;
    });
    if (!full) continue;
    const Row f = solved<6>(a, b);
    const double steep = 1 + f[1] * f[1] + f[2] * f[2];
    sum += std::abs(f[3] * f[5] - f[4] * f[4]) / (steep * std::sqrt(steep));
    ++count;
  }
  const double disc_mm2 = std::numbers::pi * kReliefRadiusMm * kReliefRadiusMm;
  if (count * kReliefCellMm * kReliefCellMm < kCurveTelling * disc_mm2) return std::nullopt;
  return sum / count * disc_mm2;
}

}  // namespace

Result<ReliefFigures> measure_relief(const FaceMesh& mesh, const RectifiedPair& pair, StageContext& context) {
  Arena::Mark mark(context.scratch);
  const HeightCells cells = make_height_cells(mesh, pair, context);
  if (cells.size() < kLeastCells) return ReliefFigures{};
  const std::optional<double> curvature = curvature_of(cells);
  if (!curvature) return ReliefFigures{};
  const std::pmr::vector<double> off_plane = off_plane_mm(cells, context);
  RELIEVO_TRY_ASSIGN(const std::pmr::vector<double> off_sheet, off_sheet_mm(cells, context));
  ReliefFigures relief;
  const double side = kReliefRadiusMm / kReliefCellMm;
  relief.covered = std::min(1.0, double(cells.size()) / (std::numbers::pi * side * side));
  relief.sigma_mm = median_sigma(cells, context.scratch);
  relief.off_plane_mm = rms_of_trusted(off_plane, context.scratch);
  relief.off_sheet_mm = rms_of_trusted(off_sheet, context.scratch);
  relief.sheet_range_mm = range_of(cells, off_sheet, context.scratch);
  relief.curvature_sr = *curvature;
  return relief;
}

ReliefVerdict judge(const ReliefFigures& r, const ReliefOptions& o) {
  if (r.covered == 0) return ReliefVerdict::Unjudged;
  const bool off_sheet = r.off_sheet_mm >= o.least_off_sheet_mm,
             beyond_noise = r.off_sheet_mm >= o.least_sigmas * r.sigma_mm;
  if (off_sheet && beyond_noise && r.curvature_sr >= o.least_curvature_sr) return ReliefVerdict::Face;
  // Would a face's relief have been seen?
  const bool quiet = o.least_sigmas * r.sigma_mm <= o.least_off_sheet_mm, whole = r.covered >= kTelling;
  const bool flat = r.off_sheet_mm < o.least_off_sheet_mm / 2;
  return quiet && (whole || flat) ? ReliefVerdict::Picture : ReliefVerdict::Unjudged;
}

Error error_of(ReliefVerdict verdict, const ReliefFigures& r, const ReliefOptions& o) {
  const Error why =
      verdict == ReliefVerdict::Picture
          ? Error{Errc::NoFace, "that looks like a picture of a face: please look into the cameras yourself"}
          : Error{
                Errc::PoorGeometry,
                "too little of the middle of the face was measured: more light, and nothing before the face"};
  if (r.covered == 0) return why;
  char figures[192];
  std::snprintf(
      figures, sizeof figures,
      "%.2f mm off a plane; %.2f mm off a bent sheet, a face at least %.1f, sigma %.2f; curved by %.1f sr, a face at least %.1f",
      r.off_plane_mm, r.off_sheet_mm, std::max(o.least_off_sheet_mm, o.least_sigmas * r.sigma_mm), r.sigma_mm,
      r.curvature_sr, o.least_curvature_sr);
  return Error(why).at(figures);
}

std::optional<Error> why_unjudged(const FaceModel& model, const std::optional<ReliefOptions>& asked) {
  if (!asked) return std::nullopt;
  const ReliefFigures& relief = model.quality.relief;
  const ReliefVerdict verdict = judge(relief, *asked);
  if (verdict == ReliefVerdict::Unjudged) return error_of(verdict, relief, *asked);
  if (std::ranges::any_of(model.landmarks, [](const Landmark& l) { return l.found; })) return std::nullopt;
  return Error{Errc::PoorGeometry,
               "nothing on the surface stands out like a nose: look straight into the cameras"};
}

}  // namespace relievo::pipeline
