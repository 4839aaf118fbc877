// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/selectors.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "pipeline/match/file/match_text.h"
#include "pipeline/match/select/response/corner_response.h"

namespace relievo::pipeline {
namespace {

// Its last pixel; `length` 0 reaches to the view's edge.
int last_of(int first, int length, int view) { return length == 0 ? view - 1 : first + length - 1; }

}  // namespace

Result<Keypoints> DenseSelector::select(const RectifiedPair& pair, StageContext& context) const {
  return lattice_keypoints(pair, step_px, {0, 0, pair.width_px - 1, pair.height_px - 1}, context);
}

Result<Keypoints> GridSelector::select(const RectifiedPair& pair, StageContext& context) const {
  const LatticeArea area{left_px, top_px, last_of(left_px, width_px, pair.width_px),
                         last_of(top_px, height_px, pair.height_px)};
  if (area.left > area.right || area.top > area.bottom || area.right >= pair.width_px ||
      area.bottom >= pair.height_px)
    return Error{
        Errc::InvalidInput,
        "the rectangle leaves the left rectified view, whose size is in brackets: give a smaller one"}
        .at("grid-points (" + std::to_string(pair.width_px) + " x " + std::to_string(pair.height_px) + ")");
  auto chosen = lattice_keypoints(pair, step_px, area, context);
  const bool part = left_px + top_px + width_px + height_px > 0;
  if (part && !chosen && chosen.error().code == Errc::NoFace)
    return Error{
        Errc::NoFace,
        "no place of the rectangle lies in the face region: choose another one, or take the whole view (--region all)"}
        .at("grid-points");
  return chosen;
}

Result<Keypoints> HarrisSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  Plane<float> response(&context.scratch, pair.width_px, pair.height_px);
  if (!corner_response(pair.left.grey, selectable, {window_px / 2, 3}, harris_measure, float(sensitivity),
                       context, response))
    return selection_stopped();
  return peak_keypoints(response, {std::pow(quality, 4), 1, double(min_distance_px), max_points}, context);
}

Result<Keypoints> RandomSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  std::size_t left = selectable.count();
  std::size_t wanted = std::min(left, std::size_t(max_points));
  Keypoints keypoints(&context.output);
  keypoints.points.reserve(wanted);
  // The engine's numbers are fixed by the standard; its distributions are not.
  std::mt19937_64 engine{std::uint64_t(seed)};
  const auto unit = [&] { return double(engine() >> 11) * 0x1p-53; };
  for (int y = 0; y < pair.height_px && wanted > 0; ++y)
    for (int x = 0; x < pair.width_px && wanted > 0; ++x) {
      if (!selectable(x, y, 0)) continue;
      if (unit() * double(left--) >= double(wanted)) continue;
      keypoints.points.push_back({{float(x), float(y)}, 1});
      --wanted;
    }
  return keypoints;
}

Result<Keypoints> FileSelector::select(const RectifiedPair& pair, StageContext& context) const {
  if (file.path.empty())
    return Error{Errc::NotFound, "no file of keypoints is named: --set file-points.path=FILE"}.at(
        "file-points.path");
  if (file.text == nullptr)
    return Error{Errc::NotFound, "this file of keypoints could not be read; check its name"}.at(file.path);
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  Keypoints keypoints(&context.output);
  keypoints.points.reserve(lines_of(*file.text));
  NumberLines lines(*file.text, 2);
  NumberLine line;
  bool any = false;
  while (lines.next(line)) {
    any = true;
    const auto refused = [&](Literal what) {
      return Error{Errc::InvalidInput, what}.at(line_name(file.path, line.number));
    };
    if (line.count < 2) return refused("is not a line of numbers with commas or blanks between them");
    const double x = line.value[0], y = line.value[1];
    if (!(x >= 0 && y >= 0 && x <= pair.width_px - 1 && y <= pair.height_px - 1))
      return refused("lies outside of the left rectified view; x and y are its pixels, from 0");
    if (selectable(int(std::lround(x)), int(std::lround(y)), 0))
      keypoints.points.push_back({{float(x), float(y)}, 1});
  }
  if (!any) return Error{Errc::InvalidInput, "holds no line of numbers"}.at(file.path);
  std::ranges::sort(keypoints.points, [](const Keypoint& a, const Keypoint& b) {
    return a.at_px.y != b.at_px.y ? a.at_px.y < b.at_px.y : a.at_px.x < b.at_px.x;
  });
  const auto same = [](const Keypoint& a, const Keypoint& b) {
    return a.at_px.x == b.at_px.x && a.at_px.y == b.at_px.y;
  };
  keypoints.points.erase(std::unique(keypoints.points.begin(), keypoints.points.end(), same),
                         keypoints.points.end());
  if (keypoints.points.empty())
    return Error{Errc::NoFace, "no keypoint of the file lies in the face region"}.at(file.path);
  return keypoints;
}

}  // namespace relievo::pipeline
