// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/disparity_truth.h"

#include <algorithm>

#include "firmware/measure/disparity_map.h"
#include "hal/picture_file.h"

namespace relievo::firmware::compare {
namespace {

constexpr float kHidesPx = 1;  // a surface nearer by more than this, on the same pixel of the right view

Result<DisparityMap> read_map(const std::filesystem::path& file, double scale) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".pfm") return read_pfm(file);
  RELIEVO_TRY_ASSIGN(const hal::Picture picture, hal::read_picture(file));
  if (picture.format == PixelFormat::Rgb8)
    return Error{Errc::InvalidInput, "is a colour picture: a disparity map is grey, or a PFM"}.at(
        file.string());
  DisparityMap map(picture.width_px, picture.height_px);
  const ImageView view = picture.view();
  for (int y = 0; y < map.height_px; ++y) {
    const std::uint8_t* row = view.row(y);
    const auto* wide = reinterpret_cast<const std::uint16_t*>(row);
    for (int x = 0; x < map.width_px; ++x) {
      const int grey = picture.format == PixelFormat::Grey16 ? wide[x] : row[x];
      if (grey != 0) map.values[map.index(x, y)] = static_cast<float>(grey / scale);
    }
  }
  return map;
}

}  // namespace

std::vector<std::uint8_t> seen_by_both(const DisparityMap& map) {
  std::vector<std::uint8_t> seen(map.values.size(), 0);
  std::vector<float> nearest(static_cast<std::size_t>(map.width_px));
  for (int y = 0; y < map.height_px; ++y) {
    std::fill(nearest.begin(), nearest.end(), -std::numeric_limits<float>::infinity());
    const auto partner = [&](int x) { return std::lround(static_cast<float>(x) - map.at(x, y)); };
    for (int x = 0; x < map.width_px; ++x) {
      if (!map.known(x, y)) continue;
      const long at = partner(x);
      if (at >= 0 && at < map.width_px)
        nearest[static_cast<std::size_t>(at)] = std::max(nearest[static_cast<std::size_t>(at)], map.at(x, y));
    }
    for (int x = 0; x < map.width_px; ++x) {
      if (!map.known(x, y)) continue;
      const long at = partner(x);
      if (at < 0 || at >= map.width_px) continue;
      seen[map.index(x, y)] = nearest[static_cast<std::size_t>(at)] <= map.at(x, y) + kHidesPx ? 1 : 0;
    }
  }
  return seen;
}

Result<DisparityTruth> read_disparity_truth(const std::filesystem::path& file, double scale) {
  DisparityTruth truth;
  RELIEVO_TRY_ASSIGN(truth.map, read_map(file, scale));
  if (std::all_of(truth.map.values.begin(), truth.map.values.end(), [](float d) { return std::isnan(d); }))
    return Error{Errc::InvalidInput, "holds no disparity at all: is it the truth's file?"}.at(file.string());
  truth.seen = seen_by_both(truth.map);
  return truth;
}

DisparityTruth truth_of_view(const measure::TruthView& view, const pipeline::RectifiedPair& pair) {
  DisparityTruth truth;
  truth.map = DisparityMap(pair.width_px, pair.height_px);
  const pipeline::Rotation left_from_rectified = pipeline::transposed(pair.rectified_from_left);
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      const pipeline::Vec3d ray{(x - pair.left_centre_px.x) / pair.focal_px,
                                (y - pair.left_centre_px.y) / pair.focal_px, 1};
      const auto point = view.judged_point_along(pipeline::apply(left_from_rectified, ray));
      if (!point) continue;
      const double z = pipeline::apply(pair.rectified_from_left, *point).z;
      truth.map.values[truth.map.index(x, y)] = static_cast<float>(pair.disparity_px(z));
    }
  truth.seen.resize(truth.map.values.size());
  std::transform(truth.map.values.begin(), truth.map.values.end(), truth.seen.begin(),
                 [](float d) { return static_cast<std::uint8_t>(std::isnan(d) ? 0 : 1); });
  return truth;
}

}  // namespace relievo::firmware::compare
