// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/band_volume.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "hal/base/assert.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

// A cell's corners: bit 0 x, bit 1 y, bit 2 z. Its faces, counter-clockwise seen from outside.
constexpr std::array<std::array<int, 4>, 6> kFaces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

// Where the surface crosses an edge: the lower voxel and the direction, in one number.
using Crossing = std::uint64_t;
constexpr Crossing kCentre = Crossing{1} << 63;  // and above: a vertex of our own amid a cell

struct Cell {
  std::array<float, 8> value{};
  std::size_t voxel = 0;  // of corner 0
};

class Walker {
 public:
  Walker(const BandVolume& volume, std::pmr::memory_resource* memory) : volume_(volume), memory_(memory) {}

  Polygonised walk() {
    std::size_t sides = 0, centres = 0;
    for_each_cell([&](const Cell& cell) {
      cells_.push_back(cell.voxel);
      follow(cell, [&](std::span<const Crossing> loop, bool ambiguous) {
        sides += loop.size();
        centres += ambiguous;
      });
    });
    corners_.reserve(3 * sides);
    centres_.reserve(centres);
    crossed_.assign(4 * volume_.value.size() / kWordBits + 1, 0);
    for (const std::size_t voxel : cells_)
      follow(cell_at(voxel), [&](std::span<const Crossing> loop, bool ambiguous) {
        for (const Crossing c : loop) crossed_[c / kWordBits] |= std::uint64_t{1} << c % kWordBits;
        ambiguous&& loop.size() > 3 ? cut_to_centre(loop) : cut(loop);
      });
    number_crossings();
    result_.triangles.reserve(corners_.size() / 3);
    for (std::size_t i = 0; i < corners_.size(); i += 3)
      result_.triangles.push_back({number(corners_[i]), number(corners_[i + 1]), number(corners_[i + 2])});
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kWordBits = 64;

  Cell cell_at(std::size_t voxel) const {
    Cell cell{{}, voxel};
    for (std::size_t k = 0; k < 8; ++k)
      cell.value[k] =
          volume_.value[voxel + (k & 1) * strides_[0] + (k >> 1 & 1) * strides_[1] + (k >> 2) * strides_[2]];
    return cell;
  }
  template <typename Visit>
  void for_each_cell(Visit&& visit) const {
    for (int z = 0; z + 1 < volume_.nz; ++z)
      for (int y = 0; y + 1 < volume_.ny; ++y)
        for (int x = 0; x + 1 < volume_.nx; ++x) {
          const std::size_t voxel = volume_.index(x, y, z);
          if (std::isnan(volume_.value[voxel])) continue;
          const Cell cell = cell_at(voxel);
          int outside = 0, unknown = 0;
          for (const float value : cell.value) outside += value >= 0, unknown += std::isnan(value);
          if (unknown == 0 && outside > 0 && outside < 8) visit(cell);
        }
  }

  static bool out(const Cell& cell, int corner) { return cell.value[std::size_t(corner)] >= 0; }

  // An edge of the cell by the two corners it joins, 0 to 11: direction times four and the other two bits.
  static std::size_t edge(int a, int b) {
    const int bit = a ^ b;
    const int low = a & b;
    const std::size_t way = bit == 1 ? 0 : bit == 2 ? 1 : 2;
    const int others = way == 0 ? low >> 1 : way == 1 ? (low & 1) | (low >> 1 & 2) : low & 3;
    return 4 * way + std::size_t(others);
  }
  Crossing crossing(const Cell& cell, std::size_t edge) const {
    const std::size_t way = edge / 4, others = edge % 4;
    const std::size_t low = way == 0 ? others << 1 : way == 1 ? (others & 1) | (others & 2) << 1 : others;
    return 4 * (cell.voxel + (low & 1) * strides_[0] + (low >> 1 & 1) * strides_[1] +
                (low >> 2) * strides_[2]) +
           way;
  }

  // Each face joins its crossings in pairs, from where one enters the outside to where one leaves it, going
  // round; every crossing begins in one of its two faces and ends in the other, so that they form loops.
  template <typename Visit>
  void follow(const Cell& cell, Visit&& visit) const {
    constexpr std::size_t kNowhere = 12;
    std::array<std::size_t, 12> next;
    next.fill(kNowhere);
    bool ambiguous = false;
    for (const auto& face : kFaces) ambiguous |= join_face(cell, face, next);
    for (std::size_t start = 0; start < 12; ++start) {
      if (next[start] == kNowhere) continue;
      std::array<Crossing, 12> loop{};
      std::size_t count = 0;
      for (std::size_t e = start; next[e] != kNowhere;) {
        loop[count++] = crossing(cell, e);
        const std::size_t after = next[e];
        next[e] = kNowhere;
        e = after;
      }
      if (count >= 3) visit(std::span<const Crossing>(loop.data(), count), ambiguous);
    }
  }

  // Whether the face is ambiguous.
  static bool join_face(const Cell& cell, const std::array<int, 4>& face, std::array<std::size_t, 12>& next) {
    std::array<std::size_t, 4> entering{}, leaving{};  // edges of the face, in its order
    std::size_t crossings = 0, enters = 0, leaves = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const bool here = out(cell, face[i]), there = out(cell, face[(i + 1) % 4]);
      if (here == there) continue;
      ++crossings;
      (there ? entering[enters++] : leaving[leaves++]) = i;
    }
    const auto edge_of = [&](std::size_t i) { return edge(face[i], face[(i + 1) % 4]); };
    if (crossings == 2) next[edge_of(entering[0])] = edge_of(leaving[0]);
    if (crossings != 4) return false;
    const auto v = [&](std::size_t i) { return double(cell.value[std::size_t(face[i])]); };
    const bool outside_joined =
        (v(0) * v(2) - v(1) * v(3)) * (v(0) + v(2) - v(1) - v(3)) >= 0;  // the saddle's sign
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t e = entering[k];
      // Around the outside's corner just entered, or, where the outside goes across, around the corner just
      // left.
      next[edge_of(e)] = edge_of(outside_joined ? (e + 3) % 4 : (e + 1) % 4);
    }
    return true;
  }

  // A diagonal between two crossings of one ambiguous face would lie in the neighbour's way.
  void cut_to_centre(std::span<const Crossing> loop) {
    Vec3f sum{};
    for (const Crossing c : loop) sum = plus(sum, place(c));
    const Crossing centre = kCentre + centres_.size();
    centres_.push_back(times(sum, 1 / float(loop.size())));
    for (std::size_t k = 0; k < loop.size(); ++k)
      for (const Crossing c : {centre, loop[(k + 1) % loop.size()], loop[k]}) corners_.push_back(c);
  }

  // A fan from the corner that gives the best angles.
  void cut(std::span<const Crossing> loop) {
    const std::size_t n = loop.size();
    std::array<Vec3f, 12> at;
    for (std::size_t i = 0; i < n; ++i) at[i] = place(loop[i]);
    std::size_t best = 0;
    float least = std::numeric_limits<float>::max();
    for (std::size_t i = 0; n > 3 && i < n; ++i) {
      float sum = 0;  // of the diagonals
      for (std::size_t k = 2; k + 1 < n; ++k) sum += squared_distance(at[i], at[(i + k) % n]);
      if (sum >= least) continue;
      least = sum;
      best = i;
    }
    for (std::size_t k = 1; k + 1 < n; ++k)
      for (const std::size_t i : {best, (best + k + 1) % n, (best + k) % n}) corners_.push_back(loop[i]);
  }

  Vec3f place(Crossing c) const {
    if (c >= kCentre) return centres_[c - kCentre];
    const std::size_t voxel = c / 4, way = c % 4;
    const double a = double(volume_.value[voxel]), b = double(volume_.value[voxel + strides_[way]]);
    // Never on a voxel itself: there other edges' crossings lie, and triangles without area arise.
    const float share = float(std::clamp(a / (a - b), 0.02, 0.98));
    const int x = int(voxel % strides_[1]), y = int(voxel % strides_[2] / strides_[1]),
              z = int(voxel / strides_[2]);
    Vec3f p = volume_.at(x, y, z);
    (way == 0 ? p.x : way == 1 ? p.y : p.z) += share * volume_.voxel_mm;
    return p;
  }

  // In their order; how many come before a word's is kept.
  void number_crossings() {
    before_.reserve(crossed_.size());
    std::size_t count = 0;
    for (const std::uint64_t word : crossed_) {
      before_.push_back(std::uint32_t(count));
      count += std::size_t(std::popcount(word));
    }
    result_.vertices_mm.reserve(count + centres_.size());
    for (std::size_t i = 0; i < crossed_.size(); ++i)
      for (std::uint64_t word = crossed_[i]; word != 0; word &= word - 1)
        result_.vertices_mm.push_back(place(kWordBits * i + std::size_t(std::countr_zero(word))));
    crossings_ = count;
    result_.vertices_mm.insert(result_.vertices_mm.end(), centres_.begin(), centres_.end());
  }
  std::uint32_t number(Crossing c) const {
    if (c >= kCentre) return std::uint32_t(crossings_ + (c - kCentre));
    const std::uint64_t lower = (std::uint64_t{1} << c % kWordBits) - 1;
    return before_[c / kWordBits] + std::uint32_t(std::popcount(crossed_[c / kWordBits] & lower));
  }

  const BandVolume& volume_;
  std::pmr::memory_resource* memory_;
  std::array<std::size_t, 3> strides_{1, std::size_t(volume_.nx),
                                      std::size_t(volume_.nx) * std::size_t(volume_.ny)};
  std::pmr::vector<std::size_t> cells_{memory_};      // that the surface passes through
  std::pmr::vector<Crossing> corners_{memory_};       // of the triangles
  std::pmr::vector<std::uint64_t> crossed_{memory_};  // a bit for each crossing there is
  std::pmr::vector<std::uint32_t> before_{memory_};   // how many there are before a word of these
  std::size_t crossings_ = 0;
  std::pmr::vector<Vec3f> centres_{memory_};
  Polygonised result_{memory_};
};

// Of the voxels about a point along one axis: how far each lies from it, and the Gaussian's factor.
struct AxisNear {
  static constexpr int kMost = 12;
  int first = 0, count = 0;
  std::array<float, kMost> from_mm{}, factor{};

  AxisNear(float at_mm, float corner_mm, float voxel_mm, float radius_mm) {
    const float at = (at_mm - corner_mm) / voxel_mm, reach = radius_mm / voxel_mm;
    first = int(at - reach) + 1;
    for (; count < kMost && float(first + count) <= at + reach; ++count) {
      const float voxels = float(first + count) - at;
      from_mm[std::size_t(count)] = voxel_mm * voxels;
      factor[std::size_t(count)] = std::exp(-voxels * voxels / 2);
    }
  }
};

}  // namespace

BandVolume volume_around(std::span<const Vec3f> points, float voxel_mm, int margin,
                         std::pmr::memory_resource* memory) {
  BandVolume volume(memory);
  Vec3f low{1e9F, 1e9F, 1e9F}, high{-1e9F, -1e9F, -1e9F};
  for (const Vec3f& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const float more = voxel_mm * float(margin);
  volume.voxel_mm = voxel_mm;
  volume.corner_mm = {low.x - more, low.y - more, low.z - more};
  const auto count = [&](float from, float to) { return int((to - from + 2 * more) / voxel_mm) + 2; };
  volume.nx = count(low.x, high.x);
  volume.ny = count(low.y, high.y);
  volume.nz = count(low.z, high.z);
  volume.value.assign(std::size_t(volume.nx) * std::size_t(volume.ny) * std::size_t(volume.nz),
                      std::numeric_limits<float>::quiet_NaN());
  return volume;
}

// A band of slices each: every voxel sees the points in their order.
void fill_field(std::span<const FieldPoint> points, float radius_mm, BandVolume& volume,
                StageContext& context) {
  constexpr int kBands = 32;
  RELIEVO_ASSERT(2 * radius_mm < float(AxisNear::kMost - 1) * volume.voxel_mm);
  const Arena::Mark mark(context.scratch);
  std::pmr::vector<float> weight(volume.value.size(), 0.0F, &context.scratch);
  std::ranges::fill(volume.value, 0.0F);
  context.pool.for_each_band(volume.nz, kBands, [&](int begin, int end, int) {
    const float low = volume.at(0, 0, begin).z - radius_mm, high = volume.at(0, 0, end - 1).z + radius_mm;
    for (const FieldPoint& p : points) {
      if (context.stop()) return;
      if (p.at_mm.z < low || p.at_mm.z > high) continue;
      const AxisNear x(p.at_mm.x, volume.corner_mm.x, volume.voxel_mm, radius_mm),
          y(p.at_mm.y, volume.corner_mm.y, volume.voxel_mm, radius_mm),
          z(p.at_mm.z, volume.corner_mm.z, volume.voxel_mm, radius_mm);
      for (int k = std::max(begin - z.first, 0); k < std::min(z.count, end - z.first); ++k)
        for (int j = 0; j < y.count; ++j) {
          const float dz = z.from_mm[std::size_t(k)], dy = y.from_mm[std::size_t(j)];
          const float off = dy * p.normal.y + dz * p.normal.z;
          const float w_yz = p.weight * z.factor[std::size_t(k)] * y.factor[std::size_t(j)];
          const float left = radius_mm * radius_mm - dy * dy - dz * dz;
          const std::size_t row = volume.index(x.first, y.first + j, z.first + k);
          for (std::size_t i = 0; i < std::size_t(x.count); ++i) {
            const float dx = x.from_mm[i];
            if (dx * dx > left) continue;
            const float w = w_yz * x.factor[i];
            volume.value[row + i] += w * (off + dx * p.normal.x);
            weight[row + i] += w;
          }
        }
    }
  });
  for (std::size_t k = 0; k < weight.size(); ++k)
    volume.value[k] = weight[k] > 0 ? std::clamp(volume.value[k] / weight[k], -radius_mm, radius_mm)
                                    : std::numeric_limits<float>::quiet_NaN();
}

Polygonised polygonise(const BandVolume& volume, std::pmr::memory_resource* memory) {
  return Walker(volume, memory).walk();
}

}  // namespace relievo::pipeline
