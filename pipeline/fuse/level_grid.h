// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LevelGrid: a colour difference that varies slowly over a head, averaged in cells of 8 mm of its box and
// smoothed. Grey levels. Memory: the resource's, 32 bytes a cell. Thread: one. Throws std::bad_alloc.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <utility>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/texture/blend/view_blend.h"

namespace relievo::pipeline {

class LevelGrid {
 public:
  LevelGrid(const FaceMesh& mesh, std::pmr::memory_resource* memory) : cells_(memory), spare_(memory) {
    Vec3f high{-1e9F, -1e9F, -1e9F};
    low_ = {1e9F, 1e9F, 1e9F};
    for (const Vec3f& v : mesh.vertices_mm) {
      low_ = {std::min(low_.x, v.x), std::min(low_.y, v.y), std::min(low_.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    const auto count = [](float from, float to) { return int(double(to - from) / kCellMm) + 3; };
    size_ = {count(low_.x, high.x), count(low_.y, high.y), count(low_.z, high.z)};
    cells_.resize(std::size_t(size_[0]) * std::size_t(size_[1]) * std::size_t(size_[2]));
    spare_.resize(cells_.size());
  }
  void clear() { std::fill(cells_.begin(), cells_.end(), LevelSum{}); }
  void add(const Vec3f& at, const Level& difference, float weight) {
    for_corners(at, [&](std::size_t k, float share) { cells_[k].add({difference, 1}, share * weight); });
  }
  // A binomial along each axis, three times.
  void smooth() {
    for (int round = 0; round < kBlurs; ++round)
      for (std::size_t axis = 0; axis < 3; ++axis) blur(axis);
  }
  Level at(const Vec3f& place) const {
    LevelSum mean{{}, 1e-6F};
    for_corners(place, [&](std::size_t k, float share) { mean.add(cells_[k], share); });
    for (float& c : mean.sum) c /= mean.weight;
    return mean.sum;
  }

 private:
  static constexpr double kCellMm = 8;
  static constexpr int kBlurs = 3;
  template <typename Visit>
  void for_corners(const Vec3f& place, Visit&& visit) const {
    const std::array<float, 3> p{(place.x - low_.x), (place.y - low_.y), (place.z - low_.z)};
    std::array<std::size_t, 3> first{};
    std::array<float, 3> f{};
    for (std::size_t a = 0; a < 3; ++a) {
      const float x = std::max(p[a] / float(kCellMm), 0.0F);
      first[a] = std::min(std::size_t(x), std::size_t(size_[a] - 2));
      f[a] = std::min(x - float(first[a]), 1.0F);
    }
    for (std::size_t i = 0; i < 8; ++i) {
      const std::size_t dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
      const float share =
          (dx != 0 ? f[0] : 1 - f[0]) * (dy != 0 ? f[1] : 1 - f[1]) * (dz != 0 ? f[2] : 1 - f[2]);
      visit(((first[2] + dz) * std::size_t(size_[1]) + first[1] + dy) * std::size_t(size_[0]) + first[0] + dx,
            share);
    }
  }
  void blur(std::size_t axis) {
    const std::array<std::size_t, 3> stride{1, std::size_t(size_[0]),
                                            std::size_t(size_[0]) * std::size_t(size_[1])};
    const std::size_t n = std::size_t(size_[axis]), step = stride[axis];
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const std::size_t at = k / step % n;
      LevelSum sum;
      sum.add(cells_[k], 0.5F);
      sum.add(cells_[at > 0 ? k - step : k], 0.25F);
      sum.add(cells_[at + 1 < n ? k + step : k], 0.25F);
      spare_[k] = sum;
    }
    std::swap(cells_, spare_);
  }
  Vec3f low_;
  std::array<int, 3> size_{};
  std::pmr::vector<LevelSum> cells_, spare_;
};

}  // namespace relievo::pipeline
