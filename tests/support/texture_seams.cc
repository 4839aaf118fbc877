// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/texture_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hal/base/statistics.h"
#include "tests/support/colour_difference.h"

namespace relievo::test {
namespace {

using pipeline::Vec2d;

class Reader {
 public:
  Reader(const pipeline::FaceMesh& mesh, const pipeline::TextureAtlas& atlas) : mesh_(mesh), atlas_(atlas) {}

  Vec2d texel(std::size_t triangle, std::size_t corner) const {
    const auto& uv = atlas_.uv[3 * triangle + corner];
    return {static_cast<double>(uv.x) * atlas_.width_px - 0.5,
            static_cast<double>(uv.y) * atlas_.height_px - 0.5};
  }

  std::array<double, 3> read(Vec2d at) const {
    const double x = std::clamp(at.x, 0.0, atlas_.width_px - 1.001),
                 y = std::clamp(at.y, 0.0, atlas_.height_px - 1.001);
    const auto u = static_cast<std::size_t>(x), v = static_cast<std::size_t>(y);
    std::array<double, 3> sum{0, 0, 0};
    for (std::size_t dy = 0; dy < 2; ++dy)
      for (std::size_t dx = 0; dx < 2; ++dx) {
        const double w = std::abs(1.0 - static_cast<double>(dx) - (x - static_cast<double>(u))) *
                         std::abs(1.0 - static_cast<double>(dy) - (y - static_cast<double>(v)));
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += w * atlas_.rgb[3 * ((v + dy) * static_cast<std::size_t>(atlas_.width_px) + u + dx) + c];
      }
    return sum;
  }

  std::uint8_t origin(Vec2d at) const {
    const auto x = static_cast<std::size_t>(std::clamp(std::lround(at.x), 0L, atlas_.width_px - 1L));
    const auto y = static_cast<std::size_t>(std::clamp(std::lround(at.y), 0L, atlas_.height_px - 1L));
    return atlas_.origin[y * static_cast<std::size_t>(atlas_.width_px) + x];
  }

  // 0 filled, 1 mostly the left photograph, 2 mostly the right one; by the triangle's middle.
  int side(std::size_t t) const {
    const Vec2d a = texel(t, 0), b = texel(t, 1), c = texel(t, 2);
    const std::uint8_t o = origin({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
    return o < pipeline::kLeftPhotographTexel ? 0 : o < 129 ? 1 : 2;
  }

  double texels_per_mm(std::size_t t) const {
    const auto& v = mesh_.triangles[t];
    const auto& p = mesh_.vertices_mm[v[0]];
    const auto& q = mesh_.vertices_mm[v[1]];
    const double mm = std::hypot(double{q.x - p.x}, double{q.y - p.y}, double{q.z - p.z});
    return mm > 0 ? std::hypot(texel(t, 1).x - texel(t, 0).x, texel(t, 1).y - texel(t, 0).y) / mm : 0;
  }

 private:
  const pipeline::FaceMesh& mesh_;
  const pipeline::TextureAtlas& atlas_;
};

struct Side {
  std::uint32_t low, high, triangle, corner;
};  // the edge opposite `corner`

// Mean colour along the edge, a tenth of the way towards the opposite corner.
Lab beside(const Reader& reader, const Side& s) {
  const Vec2d p = reader.texel(s.triangle, (s.corner + 1) % 3),
              q = reader.texel(s.triangle, (s.corner + 2) % 3), r = reader.texel(s.triangle, s.corner);
  std::array<double, 3> sum{0, 0, 0};
  for (const double t : {0.25, 0.5, 0.75}) {
    const Vec2d on{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
    const auto rgb = reader.read({on.x + 0.1 * (r.x - on.x), on.y + 0.1 * (r.y - on.y)});
    for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[c] / 3;
  }
  return lab_of(sum);
}

// Means over two squares of a millimetre, 1.5 mm before and behind an edge; none where they leave the
// photographs.
std::optional<std::array<Lab, 2>> both_sides(const Reader& reader, const Side& s) {
  const Vec2d p = reader.texel(s.triangle, (s.corner + 1) % 3),
              q = reader.texel(s.triangle, (s.corner + 2) % 3);
  const double length = std::hypot(q.x - p.x, q.y - p.y), scale = reader.texels_per_mm(s.triangle);
  if (!(length > 1e-6) || !(scale > 0)) return {};
  const Vec2d along{(q.x - p.x) / length, (q.y - p.y) / length}, normal{-along.y, along.x};
  std::array<Lab, 2> mean;
  for (std::size_t k = 0; k < 2; ++k) {
    std::array<double, 3> sum{0, 0, 0};
    for (double u = -0.5; u <= 0.5; u += 0.25)
      for (double v = 1; v <= 2; v += 0.25) {
        const double w = k == 0 ? v : -v;
        const Vec2d at{(p.x + q.x) / 2 + scale * (u * along.x + w * normal.x),
                       (p.y + q.y) / 2 + scale * (u * along.y + w * normal.y)};
        if (reader.origin(at) < pipeline::kLeftPhotographTexel) return {};
        const auto rgb = reader.read(at);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[c] / 25;
      }
    mean[k] = lab_of(sum);
  }
  return mean;
}

// From what the near side's colour should have become on the far side to what it is there.
std::optional<double> across(const Reader& judged, const std::optional<Reader>& reference, const Side& s) {
  const auto is = both_sides(judged, s);
  if (!is) return {};
  Lab expected = (*is)[0];
  if (reference) {
    const auto nature = both_sides(*reference, s);
    if (!nature) return {};
    expected = {expected.l + (*nature)[1].l - (*nature)[0].l, expected.a + (*nature)[1].a - (*nature)[0].a,
                expected.b + (*nature)[1].b - (*nature)[0].b};
  }
  return ciede2000(expected, (*is)[1]);
}

SeamFigures figures_of(std::vector<double>& all) {
  if (all.empty()) return {};
  return {all.size(), median(all), percentile(all, 0.95)};
}

}  // namespace

SeamReport measure_seams(const pipeline::FaceMesh& mesh, const pipeline::TextureAtlas& atlas,
                         const pipeline::TextureAtlas* one_photograph) {
  const Reader reader(mesh, atlas);
  std::optional<Reader> reference;
  if (one_photograph != nullptr) reference.emplace(mesh, *one_photograph);
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t a = mesh.triangles[t][(c + 1) % 3], b = mesh.triangles[t][(c + 2) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, c});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  std::vector<double> step, over;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[i + 1];
    if (a.low != b.low || a.high != b.high) continue;
    const auto near = [&](std::size_t ca, std::size_t cb) {
      const Vec2d p = reader.texel(a.triangle, ca), q = reader.texel(b.triangle, cb);
      return std::hypot(p.x - q.x, p.y - q.y) < 0.01;
    };
    const bool one_chart =
        near((a.corner + 1) % 3, (b.corner + 2) % 3) && near((a.corner + 2) % 3, (b.corner + 1) % 3);
    const int side_a = reader.side(a.triangle), side_b = reader.side(b.triangle);
    if (one_chart && side_a == side_b) continue;
    step.push_back(ciede2000(beside(reader, a), beside(reader, b)));
    if (one_chart && side_a != 0 && side_b != 0)
      if (const auto d = across(reader, reference, a)) over.push_back(*d);
  }
  return {figures_of(step), figures_of(over)};
}

}  // namespace relievo::test
