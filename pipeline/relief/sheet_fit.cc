// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/relief/relief_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMiddleShare = 0.15;  // of the face's width: surface that is surely in its middle
constexpr std::size_t kEnough = 50;
constexpr double kPlaneBendMm = 3;  // what lies further off the plane pulls no harder
constexpr int kPlaneRounds = 8;
constexpr double kMostParts = 40;                                    // of an edge
constexpr int kSide = 2 * int(kReliefRadiusMm / kReliefCellMm) + 1;  // columns and rows of the lattice

struct Sample {
  Vector3d at;  // rectified frame
  double sigma_mm;
};
using Samples = std::pmr::vector<Sample>;

Vector3d rectified(const RectifiedPair& pair, const Vec3f& at) {
  const Vec3d p = apply(pair.rectified_from_left, wide(at));
  return {p.x, p.y, p.z};
}

// Of triangles wider than a cell also places in between: what spans scattered points is measured surface.
void add_between(Samples& all, const FaceMesh& mesh, const RectifiedPair& pair) {
  for (const auto& t : mesh.triangles) {
    if (!all_three(mesh.measured, t)) continue;
    std::array<Vector3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = rectified(pair, mesh.vertices_mm[t[k]]);
    const double longest = std::max(
        {(corner[0] - corner[1]).norm(), (corner[1] - corner[2]).norm(), (corner[2] - corner[0]).norm()});
    const int parts = int(std::min(kMostParts, 2 * longest / kReliefCellMm));
    const double sigma = double(std::max({mesh.sigma_mm[t[0]], mesh.sigma_mm[t[1]], mesh.sigma_mm[t[2]]}));
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        if (i == parts || j == parts || i + j == 0) continue;  // a corner: it is there
        const double a = double(i) / parts, b = double(j) / parts;
        all.push_back({a * corner[0] + b * corner[1] + (1 - a - b) * corner[2], sigma});
      }
  }
}

// Where the face's middle is in space: on the line of sight through it, as deep as the surface around.
// Where no face was looked for, the middle of the surface itself.
Vector3d middle_of(const Samples& all, const RectifiedPair& pair, std::pmr::memory_resource* memory) {
  std::pmr::vector<double> x(memory), y(memory), z(memory);
  x.reserve(all.size()), y.reserve(all.size()), z.reserve(all.size());
  double reach = kMiddleShare * pair.face_width_px / 2;
  while (z.size() < std::min(kEnough, all.size())) {
    reach *= 2;
    x.clear(), y.clear(), z.clear();
    for (const Sample& s : all) {
      const double u = pair.left_centre_px.x + pair.focal_px * s.at.x() / s.at.z() - pair.face_centre_px.x;
      const double v = pair.left_centre_px.y + pair.focal_px * s.at.y() / s.at.z() - pair.face_centre_px.y;
      if (pair.face_width_px > 0 && std::hypot(u, v) > reach) continue;
      x.push_back(s.at.x()), y.push_back(s.at.y()), z.push_back(s.at.z());
    }
  }
  const double depth = median(z);
  if (!(pair.face_width_px > 0)) return {median(x), median(y), depth};
  return {(pair.face_centre_px.x - pair.left_centre_px.x) / pair.focal_px * depth,
          (pair.face_centre_px.y - pair.left_centre_px.y) / pair.focal_px * depth, depth};
}

// Rows: x, y and height (towards the cameras) of the frame on the robust mean plane (Huber's weights).
struct PlaneFrame {
  Vector3d origin = Vector3d::Zero();
  Matrix3d axes = Matrix3d::Identity();
};

PlaneFrame plane_of(const Samples& all, const Vector3d& middle) {
  PlaneFrame frame;
  Vector3d normal(0, 0, -1);
  frame.origin = middle;
  for (int round = 0; round < kPlaneRounds; ++round) {
    double weights = 0;
    Vector3d mean = Vector3d::Zero();
    Matrix3d spread = Matrix3d::Zero();
    for (const Sample& s : all) {
      if ((s.at - middle).norm() > kReliefRadiusMm) continue;
      const double off = std::abs(normal.dot(s.at - frame.origin));
      const double w = round == 0 || off < kPlaneBendMm ? 1 : kPlaneBendMm / off;
      const Vector3d p = s.at - middle;
      weights += w;
      mean += w * p;
      spread += w * p * p.transpose();
    }
    if (!(weights > 0)) return frame;
    mean /= weights;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solved(spread / weights - mean * mean.transpose());
    normal = solved.eigenvectors().col(0);
    if (normal.z() > 0) normal = -normal;
    frame.origin = middle + mean;
  }
  const Vector3d across = Vector3d::UnitX() - normal.x() * normal;
  frame.axes.row(2) = normal;
  frame.axes.row(0) = across.norm() > 1e-3 ? across.normalized() : normal.unitOrthogonal();
  frame.axes.row(1) = frame.axes.row(0).cross(frame.axes.row(2));
  return frame;
}

struct Sum {
  double x = 0, y = 0, height = 0, sigma = 0;
  int count = 0;
};

constexpr int kSpline = 13;             // cubic B-splines: ten pieces of about 13 mm
constexpr int kUnknowns = kSpline + 1;  // and the slope along the lines
constexpr int kRounds = 6;              // of weights
constexpr double kSoftMm = 0.3;         // below it deviations count squared
constexpr double kStraighten = 1e-3;    // keeps splines that no cell holds on their neighbours' line
constexpr int kDirections = 12;         // the first search; then halved about the best
constexpr std::array<double, 5> kConvergence{0, -1 / 400., 1 / 400., -1 / 200., 1 / 200.};
constexpr int kRefinements = 4;
constexpr double kMostConvergence = 1 / 150.;

using System = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

double soft(double deviation_mm) { return std::sqrt(deviation_mm * deviation_mm + kSoftMm * kSoftMm); }

struct Lines {
  double direction = 0;    // radians
  double convergence = 0;  // per mm
};

// One cell's row of the linear model, and how the height changes along s and t.
struct Row {
  int first = 0;  // of the four splines that reach here
  std::array<double, 4> spline{}, slope{};
  double t = 0, nearer = 1, s = 0;  // nearer: 1 - k t; s: where the line through here crosses t = 0
  double height_mm = 0;
};

using Rows = std::pmr::vector<Row>;

class Sheet {
 public:
  // `rows`: room for a row a cell, lent for the sheet's life.
  Sheet(const HeightCells& cells, Lines lines, Rows& rows) : cells_(cells), lines_(lines), rows_(rows) {
    const double reach = 0.5 * kSide * kReliefCellMm * std::numbers::sqrt2;
    const double widest = reach / (1 - std::min(0.8, std::abs(lines.convergence) * reach));
    begin_ = -widest, step_ = 2 * widest / (kSpline - 3);
    for (std::size_t k = 0; k < cells_.size(); ++k) rows_[k] = row_of(cells_[k]);
  }

  double solve() {
    for (int round = 0; round < kRounds; ++round) improve(round == 0);
    double cost = 0;
    for (const Row& row : rows_) cost += soft(deviation(row)) - kSoftMm;
    return cost / double(cells_.size());
  }

  void deviations(std::pmr::vector<double>& out) const {
    for (const Row& row : rows_) out.push_back(deviation(row));
  }

 private:
  Row row_of(const HeightCell& cell) const {
    Row row;
    row.t = -sin_ * cell.x_mm + cos_ * cell.y_mm;
    row.nearer = std::max(0.1, 1 - lines_.convergence * row.t);
    row.s = (cos_ * cell.x_mm + sin_ * cell.y_mm) / row.nearer;
    const double at = std::clamp((row.s - begin_) / step_, 0.0, kSpline - 3 - 1e-9);
    row.first = int(at);
    const double u = at - row.first, v = 1 - u;
    row.spline = {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6,
                  u * u * u / 6};
    row.slope = {-v * v / 2, (3 * u * u - 4 * u) / 2, -(3 * v * v - 4 * v) / 2, u * u / 2};
    for (double& d : row.slope) d /= step_;
    row.height_mm = cell.height_mm;
    return row;
  }

  // Perpendicular to the sheet, + before it.
  double deviation(const Row& row) const {
    double g = 0, slope = 0;
    for (int k = 0; k < 4; ++k) {
      g += row.spline[std::size_t(k)] * x_[row.first + k];
      slope += row.slope[std::size_t(k)] * x_[row.first + k];
    }
    const double along = x_[kSpline] + lines_.convergence * (slope * row.s - g);
    const double height = x_[kSpline] * row.t + row.nearer * g;
    return (row.height_mm - height) / std::sqrt(1 + slope * slope + along * along);
  }

  void improve(bool first) {
    System a = System::Zero();
    Unknowns b = Unknowns::Zero();
    for (const Row& row : rows_) {
      const double d = first ? 0 : deviation(row);
      const double w = 1 / soft(d);
      std::array<double, 5> value{};
      for (std::size_t k = 0; k < 4; ++k) value[k] = row.nearer * row.spline[k];
      value[4] = row.t;
      const auto unknown = [&](int k) { return k < 4 ? row.first + k : kSpline; };
      for (int i = 0; i < 5; ++i) {
        b[unknown(i)] += w * value[std::size_t(i)] * row.height_mm;
        for (int j = 0; j < 5; ++j)
          a(unknown(i), unknown(j)) += w * value[std::size_t(i)] * value[std::size_t(j)];
      }
    }
    const double stiff = kStraighten * a.topLeftCorner<kSpline, kSpline>().trace() / kSpline;
    for (int k = 0; k + 2 < kSpline; ++k) {
      const Eigen::Vector3d bend(1, -2, 1);
      a.block<3, 3>(k, k) += stiff * bend * bend.transpose();
    }
    a(kSpline, kSpline) += 1e-9 * a.trace();
    x_ = a.ldlt().solve(b);
  }

  const HeightCells& cells_;
  Lines lines_;
  double cos_{std::cos(lines_.direction)}, sin_{std::sin(lines_.direction)};
  Rows& rows_;
  double begin_ = 0, step_ = 1;
  Unknowns x_ = Unknowns::Zero();
};

struct Best {
  Lines lines;
  double cost = 1e300;
  void offer(const HeightCells& cells, Lines lines_offered, Rows& rows) {
    lines_offered.convergence = std::clamp(lines_offered.convergence, -kMostConvergence, kMostConvergence);
    const double c = Sheet(cells, lines_offered, rows).solve();
    if (c < cost) *this = {lines_offered, c};
  }
};

}  // namespace

HeightCells make_height_cells(const FaceMesh& mesh, const RectifiedPair& pair, StageContext& context) {
  HeightCells out(&context.scratch);
  Samples all(&context.scratch);
  all.reserve(mesh.vertices_mm.size());
  for (std::size_t k = 0; k < mesh.vertices_mm.size(); ++k) {
    if (mesh.measured[k] == 0) continue;
    const Vector3d p = rectified(pair, mesh.vertices_mm[k]);
    if (p.z() > 0) all.push_back({p, double(mesh.sigma_mm[k])});
  }
  add_between(all, mesh, pair);
  if (all.size() < kEnough) return out;
  const Vector3d middle = middle_of(all, pair, &context.scratch);
  const PlaneFrame frame = plane_of(all, middle);

  constexpr int kHalf = kSide / 2;
  std::pmr::vector<Sum> sums(std::size_t(kSide * kSide), Sum{}, &context.scratch);
  for (const Sample& s : all) {
    if ((s.at - middle).norm() > kReliefRadiusMm) continue;
    const Vector3d p = frame.axes * (s.at - frame.origin);
    const auto column = int(std::lround(p.x() / kReliefCellMm)) + kHalf,
               row = int(std::lround(p.y() / kReliefCellMm)) + kHalf;
    if (column < 0 || row < 0 || column >= kSide || row >= kSide) continue;
    Sum& sum = sums[std::size_t(row * kSide + column)];
    sum.x += p.x(), sum.y += p.y(), sum.height += p.z(), sum.sigma += s.sigma_mm;
    ++sum.count;
  }
  out.reserve(sums.size());
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const Sum& sum = sums[std::size_t(row * kSide + column)];
      if (sum.count > 0)
        out.push_back(
            {row, sum.x / sum.count, sum.y / sum.count, sum.height / sum.count, sum.sigma / sum.count});
    }
  return out;
}

Result<std::pmr::vector<double>> off_sheet_mm(const HeightCells& cells, StageContext& context) {
  Best best;
  Rows rows(cells.size(), Row{}, &context.scratch);
  for (int k = 0; k < kDirections; ++k) {
    if (context.stop()) return stopped();
    for (const double convergence : kConvergence)
      best.offer(cells, {std::numbers::pi * k / kDirections, convergence}, rows);
  }
  double turn = std::numbers::pi / kDirections / 2, meet = kConvergence[2] / 2;
  for (int round = 0; round < kRefinements; ++round) {
    const Lines from = best.lines;
    for (const int i : {-1, 0, 1})
      for (const int j : {-1, 0, 1})
        best.offer(cells, {from.direction + i * turn, from.convergence + j * meet}, rows);
    turn /= 2, meet /= 2;
  }
  std::pmr::vector<double> off(&context.scratch);
  off.reserve(cells.size());
  Sheet sheet(cells, best.lines, rows);
  sheet.solve();
  sheet.deviations(off);
  return off;
}

std::pmr::vector<double> off_plane_mm(const HeightCells& cells, StageContext& context) {
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  const auto off = [&](const HeightCell& c) {
    return (c.height_mm - plane.dot(Eigen::Vector3d(1, c.x_mm, c.y_mm))) / std::hypot(1, plane[1], plane[2]);
  };
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d a = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const HeightCell& c : cells) {
      const double w = 1 / soft(round == 0 ? 0 : off(c));
      const Eigen::Vector3d row(1, c.x_mm, c.y_mm);
      a += w * row * row.transpose();
      b += w * c.height_mm * row;
    }
    plane = solved<3>(a, b);
  }
  std::pmr::vector<double> all(&context.scratch);
  all.reserve(cells.size());
  for (const HeightCell& c : cells) all.push_back(off(c));
  return all;
}

}  // namespace relievo::pipeline
