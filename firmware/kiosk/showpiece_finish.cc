// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/showpiece_finish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace relievo::firmware {
namespace {

using pipeline::FaceMesh;
using pipeline::FaceModel;
using pipeline::Vec2f;
using pipeline::Vec3d;
using pipeline::Vec3f;

float between(float a, float b, float share) { return a + (b - a) * share; }
Vec2f between(Vec2f a, Vec2f b, float share) { return {between(a.x, b.x, share), between(a.y, b.y, share)}; }
Vec3f between(Vec3f a, Vec3f b, float share) { return {between(a.x, b.x, share), between(a.y, b.y, share), between(a.z, b.z, share)}; }
Vec3f unit(Vec3f v) {
  const float length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  return length > 0 ? Vec3f{v.x / length, v.y / length, v.z / length} : v;
}
double apart(Vec3f a, Vec3f b) { return std::hypot(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y), static_cast<double>(a.z - b.z)); }

// On the way from one vertex to another.
std::uint32_t add_vertex(FaceModel& model, std::uint32_t a, std::uint32_t b, float share) {
  FaceMesh& mesh = model.mesh;
  mesh.vertices_mm.push_back(between(mesh.vertices_mm[a], mesh.vertices_mm[b], share));
  mesh.normals.push_back(unit(between(mesh.normals[a], mesh.normals[b], share)));
  mesh.sigma_mm.push_back(between(mesh.sigma_mm[a], mesh.sigma_mm[b], share));
  mesh.measured.push_back(mesh.measured[a]);
  auto& colours = model.texture.vertex_rgb;
  for (std::size_t c = 0; c < 3 && !colours.empty(); ++c) colours.push_back(std::uint8_t{colours[std::size_t{3} * a + c]});
  return static_cast<std::uint32_t>(mesh.vertices_mm.size() - 1);
}

// An edge that one triangle alone has, in its order, and what of the texture lies at its beginning.
struct RimEdge {
  std::uint32_t to = 0;
  Vec2f uv;
};
using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Rim = std::map<std::uint32_t, RimEdge>;

Rim rim_of(const FaceModel& model) {
  std::map<Edge, Vec2f> edges;
  const auto& triangles = model.mesh.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) edges[{triangles[t][k], triangles[t][(k + 1) % 3]}] = model.texture.uv[3 * t + k];
  Rim rim;
  for (const auto& [edge, uv] : edges)
    if (edges.count({edge.second, edge.first}) == 0) rim[edge.first] = {edge.second, uv};
  return rim;
}

// From a vertex round to itself, taken from the rim; empty where it does not come round.
std::vector<std::uint32_t> take_loop(Rim& rim) {
  const std::uint32_t first = rim.begin()->first;
  std::vector<std::uint32_t> loop;
  for (std::uint32_t at = first; loop.empty() || at != first;) {
    const auto found = rim.find(at);
    if (found == rim.end()) return {};
    loop.push_back(at);
    at = found->second.to;
    rim.erase(found);
  }
  return loop;
}

// A fan round the middle of what surrounds the hole, each blade in the colour of the edge it stands on.
void fill(FaceModel& model, const std::vector<std::uint32_t>& loop, const Rim& rim) {
  FaceMesh& mesh = model.mesh;
  Vec3f middle, normal;
  const auto share = 1 / static_cast<float>(loop.size());
  for (const std::uint32_t v : loop) {
    const Vec3f &at = mesh.vertices_mm[v], &n = mesh.normals[v];
    middle = {middle.x + share * at.x, middle.y + share * at.y, middle.z + share * at.z};
    normal = {normal.x + n.x, normal.y + n.y, normal.z + n.z};
  }
  const std::uint32_t centre = add_vertex(model, loop[0], loop[0], 0);
  mesh.vertices_mm[centre] = middle;
  mesh.normals[centre] = unit(normal);
  mesh.measured[centre] = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
    for (int corner = 0; corner < 3; ++corner) model.texture.uv.push_back(rim.at(loop[i]).uv);
  }
}

struct Corner {
  std::uint32_t vertex = 0;
  Vec2f uv;
  double outside = 0;   // below 0: inside the oval
};

class OvalCut {
 public:
  OvalCut(FaceModel& model, const ShowpieceOval& oval) : model_(model) {
    for (const Vec3f& p : model.mesh.vertices_mm) {
      const Vec3d q = pipeline::apply(model.head_from_camera, Vec3d{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
      const double y = q.y - oval.middle_mm, x = q.x / oval.half_width_mm, v = y / (y > 0 ? oval.up_mm : oval.down_mm);
      outside_.push_back(std::pow(std::abs(x), oval.power) + std::pow(std::abs(v), oval.power) - 1);
    }
  }

  void cut() {
    const std::vector<std::array<std::uint32_t, 3>> triangles(model_.mesh.triangles.begin(), model_.mesh.triangles.end());
    const std::vector<Vec2f> uv(model_.texture.uv.begin(), model_.texture.uv.end());
    model_.mesh.triangles.clear();
    model_.texture.uv.clear();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      std::array<Corner, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = {triangles[t][k], uv[3 * t + k], outside_[triangles[t][k]]};
      keep(corners);
    }
    tidy();
  }

 private:
  // What of a triangle lies inside: nothing, three corners or four.
  void keep(const std::array<Corner, 3>& corners) {
    std::array<Corner, 4> inside;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner &a = corners[k], &b = corners[(k + 1) % 3];
      if (a.outside <= 0) inside[count++] = a;
      if ((a.outside <= 0) != (b.outside <= 0)) inside[count++] = crossing(a, b);
    }
    for (std::size_t k = 2; k < count; ++k) {
      model_.mesh.triangles.push_back({inside[0].vertex, inside[k - 1].vertex, inside[k].vertex});
      for (const std::size_t at : {std::size_t{0}, k - 1, k}) model_.texture.uv.push_back(inside[at].uv);
    }
  }

  Corner crossing(const Corner& a, const Corner& b) {
    const auto share = static_cast<float>(a.outside / (a.outside - b.outside));
    const Edge edge = std::minmax(a.vertex, b.vertex);
    const auto [found, fresh] = cuts_.try_emplace(edge, 0U);
    if (fresh) found->second = add_vertex(model_, a.vertex, b.vertex, share);
    return {found->second, between(a.uv, b.uv, share), 0};
  }

  // Vertices that no triangle has.
  void tidy() {
    FaceMesh& mesh = model_.mesh;
    auto& colours = model_.texture.vertex_rgb;
    std::vector<std::uint32_t> place(mesh.vertices_mm.size(), 0);
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t) place[v] = 1;
    std::uint32_t used = 0;
    for (std::size_t v = 0; v < place.size(); ++v) {
      if (place[v] == 0) continue;
      mesh.vertices_mm[used] = mesh.vertices_mm[v], mesh.normals[used] = mesh.normals[v];
      mesh.sigma_mm[used] = mesh.sigma_mm[v], mesh.measured[used] = mesh.measured[v];
      for (std::size_t c = 0; c < 3 && !colours.empty(); ++c) colours[std::size_t{3} * used + c] = colours[3 * v + c];
      place[v] = used++;
    }
    mesh.vertices_mm.resize(used), mesh.normals.resize(used), mesh.sigma_mm.resize(used), mesh.measured.resize(used);
    if (!colours.empty()) colours.resize(std::size_t{3} * used);
    for (auto& t : mesh.triangles)
      for (std::uint32_t& v : t) v = place[v];
  }

  FaceModel& model_;
  std::vector<double> outside_;
  std::map<Edge, std::uint32_t> cuts_;
};

}  // namespace

void close_holes(FaceModel& model, double longest_mm) {
  const Rim rim = rim_of(model);
  for (Rim left = rim; !left.empty();) {
    const std::vector<std::uint32_t> loop = take_loop(left);
    double length = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) length += apart(model.mesh.vertices_mm[loop[i]], model.mesh.vertices_mm[loop[(i + 1) % loop.size()]]);
    if (loop.size() >= 3 && length <= longest_mm) fill(model, loop, rim);
  }
}

void cut_to_oval(FaceModel& model, const ShowpieceOval& oval) { OvalCut(model, oval).cut(); }

}  // namespace relievo::firmware
