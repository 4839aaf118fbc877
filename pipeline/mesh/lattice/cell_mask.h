// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CellMask: which cells of a lattice are in, one byte each, 0 or 1, row by row; and MaskShaper, the
// shapes one makes of masks (Serra 1982) with discs that are round in millimetres as the camera sees
// them, whatever the lattice's cells. Distances run from centre to centre; beyond the border nothing
// is in. Thread: any; deterministic. Throws std::bad_alloc when `memory` is used up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/base/parts.h"

namespace relievo::pipeline {

using CellMask = std::pmr::vector<std::uint8_t>;

// Calls place(k, each) for every cell of `free` that is reached from known ones through cells of `free`,
// corners included: ring by ring, and a ring counts as known when all of it is placed. each(look) calls
// look(n) for the known cells beside the one to be placed.
template <typename Place>
void spread_inwards(int columns, int rows, std::span<const std::uint32_t> free, CellMask& known,
                    Place&& place, std::pmr::memory_resource* memory) {
  const auto around = [&](std::uint32_t k, auto&& visit) {
    for_each_around(int(k) % columns, int(k) / columns, columns, rows, visit);
  };
  CellMask open(known.size(), 0, memory);  // free, and in no ring yet
  std::pmr::vector<std::uint32_t> ring(memory), next(memory);
  ring.reserve(free.size());
  next.reserve(free.size());
  for (const std::uint32_t k : free) open[k] = known[k] == 0;
  for (const std::uint32_t k : free) {
    bool beside = false;
    if (open[k]) around(k, [&](std::uint32_t n) { beside = beside || known[n]; });
    if (beside) ring.push_back(k);
  }
  for (const std::uint32_t k : ring) open[k] = 0;
  while (!ring.empty()) {
    for (const std::uint32_t k : ring)
      place(k, [&](auto&& look) {
        around(k, [&](std::uint32_t n) {
          if (known[n]) look(n);
        });
      });
    for (const std::uint32_t k : ring) known[k] = 1;
    next.clear();
    for (const std::uint32_t k : ring)
      around(k, [&](std::uint32_t n) {
        if (open[n]) next.push_back(n);
        open[n] = 0;
      });
    std::swap(ring, next);
  }
}

class MaskShaper {
 public:
  MaskShaper(int columns, int rows, float cell_width_mm, float cell_height_mm,
             std::pmr::memory_resource* memory)
      : columns_(columns),
        rows_(rows),
        cell_width_mm_(cell_width_mm),
        cell_height_mm_(cell_height_mm),
        memory_(memory) {
    piece_.reserve(along_row_.size());
  }

  void dilate(CellMask& mask, float radius_mm);
  void erode(CellMask& mask, float radius_mm);
  // Puts in what lies between: dilates, then erodes by `back_mm`; what was in stays in.
  void close(CellMask& mask, float radius_mm, float back_mm);
  void open(CellMask& mask, float radius_mm);
  // Keeps, or puts in, where at least this share of what lies around (a Gaussian) is in: waves of the
  // border shorter than about four sigmas go. At a half as much is given as taken.
  void straighten(CellMask& mask, float sigma_mm, float share);

  // Puts in whatever is out and cannot be reached from the border, corners included.
  void fill_holes(CellMask& mask);
  // Takes out every piece (joined through sides) of fewer than `least` cells, or all but the largest.
  void drop_pieces_below(CellMask& mask, std::size_t least);
  void keep_largest_piece(CellMask& mask);

 private:
  // Cells that are `wanted`, in or out, and those near them become 1, all others 0.
  void mark_within(CellMask& mask, std::uint8_t wanted, float radius_mm);
  void measure_rows(const CellMask& mask, std::uint8_t wanted);
  template <bool Corners>
  void flood(CellMask& mask, std::uint32_t seed, std::uint8_t from, std::uint8_t to);

  int columns_, rows_;
  float cell_width_mm_, cell_height_mm_;
  std::pmr::memory_resource* memory_;
  // Squared distance to the nearest wanted cell of the row, mm2; of one row: the same, of all rows.
  std::pmr::vector<float> along_row_{std::size_t(columns_) * std::size_t(rows_), 0.0F, memory_};
  std::pmr::vector<float> nearest_{std::size_t(columns_), 0.0F, memory_};
  std::pmr::vector<std::uint32_t> piece_{memory_};  // cells of the flood at hand
  CellMask before_{along_row_.size(), 0, memory_};
};

}  // namespace relievo::pipeline
