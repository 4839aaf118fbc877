// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/completions.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "pipeline/mesh/completion/generic_head.h"
#include "pipeline/mesh/completion/head_sewing.h"
#include "pipeline/mesh/completion/mesh_laplacian.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

// Not where the border's own triangles still lie.
std::pmr::vector<Addition> additions(const UnrolledHead& head, const RigidTransform& camera_from_head,
                                     const SymmetricCompletion& options, Arena& scratch) {
  std::pmr::vector<Addition> all(&scratch);
  for (int r = 0; r < head.own.rows(); ++r)
    for (int c = 0; c < head.own.columns(); ++c) {
      const float radius = head.added.z(c, r);
      const float away = head.away.z(c, r);
      if (std::isnan(radius) || away < 1.5F * float(options.cell_mm)) continue;
      const double arc = head.own.x_mm(c), y = head.own.y_mm(r);
      const Vec3d at = apply(camera_from_head, rolled(arc, y, double(radius)));
      const double sigma = options.sigma_mm + options.sigma_per_mm * double(away);
      all.push_back({narrow(at), {float(arc), float(y)}, float(sigma)});
    }
  return all;
}

// None where no head is found: then nothing is completed.
Result<std::optional<HeadFrame>> frame_of(const FaceMesh& mesh, const Vec3d& across, StageContext& context) {
  const Result<HeadFrame> frame = find_head_frame(mesh, context, across);
  if (frame) return std::optional(*frame);
  if (frame.error().code == Errc::PoorGeometry) return std::optional<HeadFrame>();
  return frame.error();
}

using Edge = std::array<std::uint32_t, 2>;

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// Of a node's neighbours, each, in Loop's mean.
double neighbour_share(int neighbours) {
  const double c = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / neighbours);
  return (0.625 - c * c) / neighbours;
}

double along(double place, double share, double way) { return place + share * way; }

// A thin plate over a globe: continues values that are known on a part of it, with their slope, and returns
// to zero some 40 mm further on (least squares: squared Laplacians, nearness to the known, smallness
// elsewhere). The values are what is added to a shape, and together they are the surface: beside the known
// part that as a whole goes on without a bend, and over 50 mm it comes to bend as the shape does. Known
// values further than 12 mm inside their part do not count. Memory: the heap, for the sparse factorisation.
// Thread: any; deterministic.

constexpr double kBandMm = 12;    // of known values: what lies further inside cannot tell how they go on
constexpr double kReturnMm = 40;  // to zero
constexpr double kNearMm = 1;     // over which the plate smooths what is known
constexpr double kBentMm = 50;    // from the known part the shape bends as its own does, not on the way there

// How many steps a node lies from those whose value is known, or from those whose is not; at most `most`.
std::vector<int> steps_from(bool known, const MeshLaplacian& bends, std::span<const double> value, int most) {
  std::vector<int> steps(value.size(), most);
  std::vector<int> front;
  for (std::size_t v = 0; v < value.size(); ++v)
    if (std::isnan(value[v]) != known) steps[v] = 0, front.push_back(int(v));
  for (std::size_t next = 0; next < front.size(); ++next) {
    const auto v = std::size_t(front[next]);
    for (const auto& n : bends.neighbours[v])
      if (steps[n.vertex] > steps[v] + 1) steps[n.vertex] = steps[v] + 1, front.push_back(int(n.vertex));
  }
  return steps;
}

// From 0 to 1 without a bend at either end.
double risen(double share) { return share * share * (3 - 2 * share); }

// A term (h / 2 l)^4 beside squared means of neighbours less the node itself acts over the length l.
double weight_of(double step_mm, double length_mm) { return std::pow(step_mm / (2 * length_mm), 4); }

// `shape`, `value`: one a node; values that are NaN are not known and are set. `step_mm`: from node to node.
void continue_over_globe(const Globe& globe, double step_mm, std::span<const double> shape,
                         std::span<double> value) {
  // Sharing one sphere, all nodes count alike: h h / 4 times the Laplacian, which in a lattice of equal
  // triangles with sides of h is what a node's neighbours' mean is off.
  std::vector<Eigen::Vector3d> at;
  for (const Vec3d& d : globe.direction) at.emplace_back(d.x, d.y, d.z);
  MeshLaplacian laplacian = laplacian_of(at, globe.triangles);
  for (auto& its : laplacian.neighbours)
    for (auto& n : its) n.weight *= 4 * std::numbers::pi / double(at.size()) / (2 * std::sqrt(3.0));
  const int band = std::max(2, int(std::lround(kBandMm / step_mm)));
  const std::vector<int> depth = steps_from(false, laplacian, value, band + 1);
  const int bent = std::max(1, int(kBentMm / step_mm));
  const std::vector<int> away = steps_from(true, laplacian, value, bent);
  std::vector<int> place(value.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < value.size(); ++v)
    if (depth[v] <= band) place[v] = count++;
  std::vector<Eigen::Triplet<double>> bends, weights;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count), own_bend = Eigen::VectorXd::Zero(count);
  for (std::size_t v = 0; v < value.size(); ++v) {
    if (place[v] < 0) continue;
    const double weight = weight_of(step_mm, depth[v] > 0 ? kNearMm : kReturnMm);
    weights.emplace_back(place[v], place[v], weight);
    if (depth[v] > 0) right[place[v]] = weight * value[v];
    if (depth[v] == band) continue;  // some of its neighbours take no part
    double its_bend = 0;
    for (const auto& [n, share] : laplacian.neighbours[v]) {
      bends.emplace_back(place[v], place[v], -share);
      bends.emplace_back(place[v], place[n], share);
      its_bend += share * (shape[n] - shape[v]);
    }
    own_bend[place[v]] = (1 - risen(double(away[v]) / bent)) * its_bend;
  }
  using Sparse = Eigen::SparseMatrix<double>;
  Sparse bend(count, count), near(count, count);
  bend.setFromTriplets(bends.begin(), bends.end());
  near.setFromTriplets(weights.begin(), weights.end());
  const Sparse normal = Sparse(bend.transpose() * bend) + near;
  const Eigen::VectorXd solved =
      Eigen::SimplicialLDLT<Sparse>(normal).solve(right - bend.transpose() * own_bend);
  for (std::size_t v = 0; v < value.size(); ++v)
    if (depth[v] == 0) value[v] = solved[place[v]];
}

constexpr double kFitCellMm = 2;
constexpr int kFiner = 2;        // how often the generic head's globe is quartered
constexpr double kStepMm = 2.1;  // then from node to node, at 105 mm from the centre
constexpr double kFairedMm = 10;
constexpr double kPlaneMm = 320, kPlaneCellMm = 2;

// Seen from the globe's centre, on a plane: a sphere from its pole behind the head (stereographic, so that
// triangles keep their angles), 100 mm large. That pole itself has no place.
Vec2d plane_of(const Vec3d& direction) {
  const double scale = 200 / std::max(1e-9, 1 + direction.z);
  return {direction.x * scale, direction.y * scale};
}

// 1 where a node shows nothing of its own, nor does a neighbour.
std::vector<char> apart(const Globe& globe, std::span<const double> off) {
  std::vector<char> free(off.size());
  for (std::size_t v = 0; v < off.size(); ++v) free[v] = std::isnan(off[v]) ? 1 : 0;
  const std::vector<char> own = free;
  for (const auto& t : globe.triangles)
    if (own[t[0]] == 0 || own[t[1]] == 0 || own[t[2]] == 0)
      for (const std::uint32_t v : t) free[v] = 0;
  return free;
}

}  // namespace

Result<void> SymmetricCompletion::check() const {
  if (longest_edge_mm < 2 * cell_mm)
    return invalid("longest_edge_mm must be at least two cells").at("symmetric");
  return {};
}

Result<FaceMesh> SymmetricCompletion::complete(FaceMesh mesh, const Vec3d& across,
                                               StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const auto frame, frame_of(mesh, across, context));
  if (!frame) return mesh;
  const Arena::Mark mark(context.scratch);
  UnrolledHead head(mesh, frame->head_from_camera, cell_mm, context.scratch);
  if (context.stop()) return stopped();
  head.add_other_side(context.scratch);
  if (context.stop()) return stopped();
  const auto added = additions(head, inverse(frame->head_from_camera), *this, context.scratch);
  if (added.empty()) return mesh;
  return sew(mesh, head.flat.vertices_mm, added, {longest_edge_mm}, context);
}

Globe::Globe(int times, std::pmr::memory_resource* memory) : direction(memory), triangles(memory) {
  const double height = 1 / std::sqrt(5.0), across = 2 / std::sqrt(5.0);
  direction.push_back({0, 0, -1});
  for (int k = 0; k < 10; ++k) {  // two rings of five, turned against each other
    const double angle = std::numbers::pi * (k % 5 * 2 + k / 5) / 5;
    direction.push_back({across * std::cos(angle), across * std::sin(angle), k < 5 ? -height : height});
  }
  direction.push_back({0, 0, 1});
  for (std::uint32_t k = 0; k < 5; ++k) {
    const std::uint32_t next = (k + 1) % 5;
    triangles.push_back({0, 1 + next, 1 + k});
    triangles.push_back({1 + k, 1 + next, 6 + k});
    triangles.push_back({1 + next, 6 + next, 6 + k});
    triangles.push_back({11, 6 + k, 6 + next});
  }
  for (int k = 0; k < times; ++k) quarter({});
}

void Globe::quarter(std::span<std::pmr::vector<double>> fields) {
  std::pmr::memory_resource* const memory = direction.get_allocator().resource();
  const std::size_t before = direction.size();
  std::pmr::vector<Edge> edges(memory);
  edges.reserve(3 * triangles.size());
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_of(t[k], t[(k + 1) % 3]));
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), edge_of(a, b));
    return std::uint32_t(before) + std::uint32_t(at - edges.begin());
  };
  std::pmr::vector<int> neighbours(before, 0, memory);
  for (const Edge& e : edges) ++neighbours[e[0]], ++neighbours[e[1]];
  const auto smoothed = [&](const auto& field, auto fine) {
    fine.resize(before + edges.size());
    const auto add = [&fine](std::uint32_t to, double share, const auto& value) {
      fine[to] = along(fine[to], share, value);
    };
    for (std::uint32_t v = 0; v < before; ++v)
      add(v, 1 - neighbours[v] * neighbour_share(neighbours[v]), field[v]);
    for (const Edge& e : edges) {
      add(e[0], neighbour_share(neighbours[e[0]]), field[e[1]]);
      add(e[1], neighbour_share(neighbours[e[1]]), field[e[0]]);
    }
    for (const auto& t : triangles)  // an edge has two of them
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3], at = middle(a, b);
        add(at, 3.0 / 16, field[a]), add(at, 3.0 / 16, field[b]), add(at, 2.0 / 16, field[t[(k + 2) % 3]]);
      }
    return fine;
  };
  for (auto& field : fields) field = smoothed(field, std::pmr::vector<double>(memory));
  if (fields.empty()) {
    direction.resize(before + edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k)
      direction[before + k] = plus(direction[edges[k][0]], direction[edges[k][1]]);
  } else {
    direction = smoothed(direction, std::pmr::vector<Vec3d>(memory));
  }
  for (Vec3d& d : direction) d = along(Vec3d{}, 1 / std::hypot(d.x, d.y, d.z), d);
  std::pmr::vector<Triangle> fine(memory);
  fine.reserve(4 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.insert(fine.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  triangles = std::move(fine);
}

Result<FaceMesh> GenericHeadCompletion::complete(FaceMesh mesh, const Vec3d& across,
                                                 StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const auto frame, frame_of(mesh, across, context));
  if (!frame) return mesh;
  Arena& scratch = context.scratch;
  const Arena::Mark mark(scratch);
  const UnrolledHead face(mesh, frame->head_from_camera, kFitCellMm, scratch);
  std::array<std::pmr::vector<double>, 2> fields = fit_generic_globe(face, misfit_mm, &scratch);
  if (context.stop()) return stopped();
  Globe globe(kGlobeTimes, &scratch);
  for (int k = 0; k < kFiner; ++k) globe.quarter(fields);
  const auto &radius = fields[0], &sigma = fields[1];  // clang 14's lambdas take no structured bindings

  // The surface as it is, in the plane; the radius is its height.
  const FaceMesh flat = laid_flat(mesh, scratch, [&](const Vec3f& v) {
    const Vec3d from = minus(apply(frame->head_from_camera, wide(v)), kGlobeCentre);
    const double radius_mm = std::hypot(from.x, from.y, from.z);
    const Vec2d at = plane_of({from.x / radius_mm, from.y / radius_mm, from.z / radius_mm});
    return Vec3f{float(at.x), float(at.y), float(radius_mm)};
  });
  FaceRelief own({-kPlaneMm, kPlaneMm, -kPlaneMm, kPlaneMm, kPlaneCellMm}, &scratch);
  own.add(flat, {}, true);  // gaps that the mesher closed are surface here
  std::pmr::vector<double> off(radius.size(), std::numeric_limits<double>::quiet_NaN(), &scratch);
  for (std::size_t v = 1; v < off.size(); ++v) {  // the first is the pole
    const Vec2d at = plane_of(globe.direction[v]);
    off[v] = own.at(at.x, at.y) - radius[v];
  }
  const std::vector<char> free = apart(globe, off);
  if (free[0] == 0) return mesh;  // surface behind the head: no face
  continue_over_globe(globe, kStepMm, radius, off);
  if (context.stop()) return stopped();

  const RigidTransform camera_from_head = inverse(frame->head_from_camera);
  const auto addition = [&](std::size_t v) {
    const Vec3d& d = globe.direction[v];
    const Vec3d at = apply(camera_from_head, along(kGlobeCentre, radius[v] + off[v], d));
    const Vec2d plane = plane_of(d);
    return Addition{narrow(at), {float(plane.x), float(plane.y)}, float(sigma[v])};
  };
  std::pmr::vector<Addition> added(&scratch);
  for (std::size_t v = 1; v < off.size(); ++v)
    if (free[v] != 0) added.push_back(addition(v));
  return sew(mesh, flat.vertices_mm, added, {std::numeric_limits<float>::max(), addition(0), kFairedMm},
             context);
}

}  // namespace relievo::pipeline
