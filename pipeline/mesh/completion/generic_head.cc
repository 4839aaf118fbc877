// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/generic_head.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "hal/base/assert.h"

// The file becomes part of the library: nothing is looked for when it runs.
asm(R"(.pushsection .rodata
.global relievo_generic_head, relievo_generic_head_end
.hidden relievo_generic_head, relievo_generic_head_end
.balign 8
relievo_generic_head:
.incbin ")" RELIEVO_GENERIC_HEAD_FILE R"("
relievo_generic_head_end:
.popsection)");
extern "C" const std::byte relievo_generic_head[], relievo_generic_head_end[];

namespace relievo::pipeline {
namespace {

// Where a coordinate lies among the cells, and what the four around it count (Catmull and Rom 1974): a head
// has no creases where its cells meet.
struct Taps {
  std::array<std::size_t, 4> cell{};
  std::array<double, 4> weight{};
};

Taps taps_at(double share, int cells) {
  const double at = std::clamp(share, 0.0, 1.0) * (cells - 1);
  const int first = std::min(int(at), cells - 2);
  const double t = at - first;
  Taps taps;
  for (int k = 0; k < 4; ++k)
    taps.cell[std::size_t(k)] = std::size_t(std::clamp(first - 1 + k, 0, cells - 1));
  taps.weight = {0.5 * t * (t * (2 - t) - 1), 0.5 * (t * t * (3 * t - 5) + 2),
                 0.5 * t * (t * (4 - 3 * t) + 1), 0.5 * t * t * (t - 1)};
  return taps;
}

constexpr std::size_t kCells = std::size_t{kHeadColumns} * kHeadRows;

void add_to(HeadPlace& place, const HeadRadii& radii, std::size_t cell, double weight) {
  const std::size_t cells = radii.mean.size();
  place.mean_mm += weight * kHeadMeanUnit * radii.mean[cell];
  place.left_mm += weight * kHeadMeanUnit * radii.left[cell];
  for (std::size_t k = 0; k < kHeadModes; ++k)
    place.mode_mm[k] += weight * kHeadModeUnit * radii.mode[k * cells + cell];
}

}  // namespace

Result<GenericHead> read_generic_head(std::span<const std::byte> file) {
  const Error none{
      Errc::InvalidInput,
      "generic_head.bin is no generic head of this program's size: make it anew (make_generic_head)"};
  constexpr std::size_t kCounts = (kHeadModes + 2) * (kCells + kGlobeNodes);
  GenericHeadHeader header{};
  if (file.size() != sizeof(header) + kCounts * sizeof(std::int16_t)) return none;
  std::memcpy(&header, file.data(), sizeof(header));
  if (header != kGenericHeadHeader) return none;
  const auto* next = reinterpret_cast<const std::int16_t*>(file.data() + sizeof(header));
  const auto take = [&](std::size_t count) { return std::span(std::exchange(next, next + count), count); };
  const auto radii = [&](std::size_t cells) {
    return HeadRadii{take(cells), take(kHeadModes * cells), take(cells)};
  };
  const HeadRadii face = radii(kCells);
  return GenericHead{face, radii(kGlobeNodes)};
}

std::span<const std::byte> generic_head_file() { return {relievo_generic_head, relievo_generic_head_end}; }

const GenericHead& generic_head() {
  static const GenericHead head = [] {
    const Result<GenericHead> read = read_generic_head(generic_head_file());
    RELIEVO_ASSERT(read);
    return *read;
  }();
  return head;
}

HeadPlace head_place(double arc_mm, double y_mm) {
  const Taps across = taps_at((arc_mm + kHalfArc) / (2 * kHalfArc), kHeadColumns);
  const Taps up = taps_at((y_mm + kBelow) / (kBelow + kAbove), kHeadRows);
  HeadPlace place;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t cell = up.cell[j] * kHeadColumns + across.cell[i];
      add_to(place, generic_head().face, cell, up.weight[j] * across.weight[i]);
    }
  return place;
}

HeadPlace globe_place(std::size_t node) {
  HeadPlace place;
  add_to(place, generic_head().globe, node, 1);
  return place;
}

}  // namespace relievo::pipeline
