// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/selectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

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
    return invalid(
               "the rectangle leaves the left rectified view, whose size is in brackets: give a smaller one")
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
  RELIEVO_TRY(corner_response(pair.left.grey, selectable, {window_px / 2, 3}, harris_measure,
                              float(sensitivity), context, response));
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
    const auto refused = [&](Literal what) { return invalid(what).at(line_name(file.path, line.number)); };
    if (line.count < 2) return refused("is not a line of numbers with commas or blanks between them");
    const double x = line.value[0], y = line.value[1];
    if (!(x >= 0 && y >= 0 && x <= pair.width_px - 1 && y <= pair.height_px - 1))
      return refused("lies outside of the left rectified view; x and y are its pixels, from 0");
    if (selectable(int(std::lround(x)), int(std::lround(y)), 0))
      keypoints.points.push_back({{float(x), float(y)}, 1});
  }
  if (!any) return invalid("holds no line of numbers").at(file.path);
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

namespace {

constexpr std::size_t kMostLevels = 16;

struct Level {
  double quality, distance_px;
};

std::optional<double> number_in(std::string_view text, double least, double most) {
  const std::optional<double> value = pipeline::number_in(text);
  return value && *value >= least && *value <= most ? value : std::nullopt;
}

Result<std::vector<Level>> read_levels(const std::string& text) {
  const Error wrong =
      invalid(
          "levels must be up to 16 QUALITY:DISTANCE_PX joined by '+', such as 0.1:4+0.02:7; quality above 0 to 1, distance 1 to 256")
          .at("good-features.levels = " + text);
  std::vector<Level> levels;
  for (const std::string_view part : split_names(text)) {
    const std::size_t colon = part.find(':');
    if (colon == std::string_view::npos || levels.size() == kMostLevels) return wrong;
    const auto quality = number_in(part.substr(0, colon), 1e-9, 1);
    const auto distance = number_in(part.substr(colon + 1), 1, 256);
    if (!quality || !distance) return wrong;
    levels.push_back({*quality, *distance});
  }
  return levels;
}

Result<std::vector<float>> read_thresholds(const std::string& text) {
  std::vector<float> thresholds;
  if (text == "none") return thresholds;
  for (const std::string& part : split_names(text)) {
    const auto grey = number_in(part, 1, 254);
    if (!grey || thresholds.size() == kMostLevels)
      return invalid(
                 "binary_thresholds must be up to 16 grey levels of 1 to 254 joined by '+', such as 64+128, or none")
          .at("good-features.binary_thresholds = " + text);
    thresholds.push_back(float(*grey));
  }
  return thresholds;
}

}  // namespace

Result<void> GoodFeaturesSelector::check() const {
  RELIEVO_TRY(read_levels(levels));
  RELIEVO_TRY(read_thresholds(binary_thresholds));
  return {};
}

Result<Keypoints> GoodFeaturesSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const auto wanted, read_levels(levels));
  RELIEVO_TRY_ASSIGN(const auto thresholds, read_thresholds(binary_thresholds));
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  const ResponseWindow window{window_px / 2, 1};
  Plane<float> response(&context.scratch, pair.width_px, pair.height_px);
  Plane<float> chosen(&context.scratch, pair.width_px, pair.height_px);

  const auto search = [&](const std::pmr::vector<float>& grey) -> Result<void> {
    RELIEVO_TRY(corner_response(grey, selectable, window, smaller_eigenvalue, 0, context, response));
    for (const Level& level : wanted)
      RELIEVO_TRY(mark_peaks(response, {level.quality, 1, level.distance_px, max_points}, chosen, context));
    return {};
  };
  RELIEVO_TRY(search(pair.left.grey));
  if (!thresholds.empty()) {
    std::pmr::vector<float> binary(pair.left.grey.size(), &context.scratch);
    for (const float threshold : thresholds) {
      for (std::size_t k = 0; k < binary.size(); ++k)
        binary[k] = pair.left.grey[k] > threshold ? 255.0F : 0.0F;
      RELIEVO_TRY(search(binary));
    }
  }
  return keypoints_of(chosen, max_points, context);
}

namespace {

constexpr int kOctaveBands = 16;
constexpr int kSizes = 4;

// One octave: responses of four filter sizes on every step-th pixel.
struct Octave {
  int step_px;
  PlaneShape shape;
  std::array<Plane<float>, kSizes> response{Plane<float>(shape), Plane<float>(shape), Plane<float>(shape),
                                            Plane<float>(shape)};
  int size_px(std::size_t k) const { return 3 * (2 * step_px * (int(k) + 1) + 1); }
};

// Of equal ones the first in size, row and column.
bool is_peak(const Octave& octave, std::size_t k, int i, int j) {
  const float here = octave.response[k].row(j)[i];
  for (std::size_t l = k - 1; l <= k + 1; ++l)
    for (int b = j - 1; b <= j + 1; ++b)
      for (int a = i - 1; a <= i + 1; ++a) {
        if (l == k && b == j && a == i) continue;
        const bool before = l != k ? l < k : b != j ? b < j : a < i;
        const float there = octave.response[l].row(b)[a];
        if (before ? there >= here : there > here) return false;
      }
  return true;
}

// The top of the quadratic through a peak and its neighbours, in steps from the peak along x, y and size;
// where it would lie further away than the neighbours the samples say no more than the peak itself.
std::array<double, 2> top_of(const Octave& octave, std::size_t k, int i, int j) {
  const auto at = [&](int di, int dj, int dk) {
    return double(octave.response[std::size_t(int(k) + dk)].row(j + dj)[i + di]);
  };
  const double here = at(0, 0, 0);
  const double gx = 0.5 * (at(1, 0, 0) - at(-1, 0, 0)), gy = 0.5 * (at(0, 1, 0) - at(0, -1, 0)),
               gs = 0.5 * (at(0, 0, 1) - at(0, 0, -1));
  const double xx = at(1, 0, 0) + at(-1, 0, 0) - 2 * here, yy = at(0, 1, 0) + at(0, -1, 0) - 2 * here,
               ss = at(0, 0, 1) + at(0, 0, -1) - 2 * here;
  const double xy = 0.25 * (at(1, 1, 0) - at(-1, 1, 0) - at(1, -1, 0) + at(-1, -1, 0));
  const double xs = 0.25 * (at(1, 0, 1) - at(-1, 0, 1) - at(1, 0, -1) + at(-1, 0, -1));
  const double ys = 0.25 * (at(0, 1, 1) - at(0, -1, 1) - at(0, 1, -1) + at(0, -1, -1));
  const double det = xx * (yy * ss - ys * ys) - xy * (xy * ss - ys * xs) + xs * (xy * ys - yy * xs);
  if (!(std::abs(det) > 1e-12 * here * here * here)) return {0, 0};
  const double x = -(gx * (yy * ss - ys * ys) - xy * (gy * ss - ys * gs) + xs * (gy * ys - yy * gs)) / det;
  const double y = -(xx * (gy * ss - gs * ys) - gx * (xy * ss - ys * xs) + xs * (xy * gs - gy * xs)) / det;
  if (!(std::abs(x) <= 1 && std::abs(y) <= 1)) return {0, 0};
  return {x, y};
}

// Marks the octave's peaks at full size; a pixel keeps its strongest.
void mark_peaks(const Octave& octave, const Selectable& selectable, Plane<float>& found) {
  for (std::size_t k = 1; k + 1 < kSizes; ++k)
    for (int j = 1; j + 1 < octave.response[k].height; ++j)
      for (int i = 1; i + 1 < octave.response[k].width; ++i) {
        const float here = octave.response[k].row(j)[i];
        if (!(here > 0) || !is_peak(octave, k, i, j)) continue;
        const auto [dx, dy] = top_of(octave, k, i, j);
        const int x = int(std::lround((i + dx) * octave.step_px));
        const int y = int(std::lround((j + dy) * octave.step_px));
        if (selectable(x, y, 0)) found.row(y)[x] = std::max(found.row(y)[x], here);
      }
}

}  // namespace

Result<Keypoints> HaarSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  const FastHessian hessian(pair.left.grey, pair.width_px, pair.height_px, &context.scratch);
  Plane<float> found(&context.scratch, pair.width_px, pair.height_px);
  for (int step = 1; step < 1 << octaves; step *= 2) {
    Arena::Mark mark(context.scratch);
    Octave octave{step,
                  {&context.scratch, (pair.width_px + step - 1) / step, (pair.height_px + step - 1) / step}};
    context.pool.for_each(octave.response[0].height, kOctaveBands, [&](int j) {
      for (std::size_t k = 0; k < kSizes; ++k)
        for (int i = 0; i < octave.response[k].width; ++i)
          if (selectable(i * step, j * step, octave.size_px(k) / 2))
            octave.response[k].row(j)[i] =
                std::max(0.0F, hessian.determinant(i * step, j * step, octave.size_px(k)));
    });
    if (context.stop()) return stopped();
    mark_peaks(octave, selectable, found);
  }
  return peak_keypoints(found, {quality * quality, 0, double(min_distance_px), max_points}, context);
}

namespace {

constexpr int kBands = 16;

// Bands of whole blocks of the coarsest scale: no track leaves its band.
void mark_ends(const SalientTracks& tracks, const Selectable& selectable, ThreadPool& pool,
               Plane<float>& saliency) {
  const int block = 1 << tracks.scales();
  pool.for_each_band((saliency.height + block - 1) / block, kBands, [&](int begin, int end, int) {
    for (int scale = 1; scale <= tracks.scales(); ++scale) {
      const int side = 1 << scale;
      const int last = std::min(tracks.rows(scale), end * (block / side));
      for (int row = begin * (block / side); row < last; ++row)
        for (int column = 0; column < tracks.columns(scale); ++column) {
          if (!selectable.valid_block(column * side, row * side, side)) continue;
          for (int orientation = 0; orientation < SalientTracks::kOrientations; ++orientation) {
            if (!(tracks.magnitude(scale, orientation, column, row) > 0)) continue;
            const Candidate found = tracks.follow(scale, orientation, column, row);
            if (!selectable(found.x, found.y, 1)) continue;
            float& there = saliency.row(found.y)[found.x];
            there = std::max(there, found.strength);
          }
        }
    }
  });
}

}  // namespace

Result<Keypoints> WaveletSalientSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  const SalientTracks tracks(pair.left.grey, pair.width_px, pair.height_px, scales, &context.scratch);
  Plane<float> saliency(&context.scratch, pair.width_px, pair.height_px);
  mark_ends(tracks, selectable, context.pool, saliency);
  if (context.stop()) return stopped();
  return peak_keypoints(saliency, {quality, 0, double(min_distance_px), max_points}, context);
}

}  // namespace relievo::pipeline
