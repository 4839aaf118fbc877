// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/selectors.h"

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "pipeline/match/select/response/corner_response.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kMostLevels = 16;

struct Level {
  double quality, distance_px;
};

std::optional<double> number_in(std::string_view text, double least, double most) {
  double value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || read.ec != std::errc{} || read.ptr != text.data() + text.size() ||
      !(value >= least && value <= most))
    return {};
  return value;
}

// Parts joined by '+'; empty where there are none or too many.
std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  while (parts.size() <= kMostLevels) {
    const std::size_t plus = text.find('+');
    parts.push_back(text.substr(0, plus));
    if (plus == std::string_view::npos) return parts;
    text.remove_prefix(plus + 1);
  }
  return {};
}

Result<std::vector<Level>> read_levels(const std::string& text) {
  const Error wrong =
      Error{
          Errc::InvalidInput,
          "levels must be up to 16 QUALITY:DISTANCE_PX joined by '+', such as 0.1:4+0.02:7; quality above 0 to 1, distance 1 to 256"}
          .at("good-features.levels = " + text);
  std::vector<Level> levels;
  for (const std::string_view part : parts_of(text)) {
    const std::size_t colon = part.find(':');
    if (colon == std::string_view::npos) return wrong;
    const auto quality = number_in(part.substr(0, colon), 1e-9, 1);
    const auto distance = number_in(part.substr(colon + 1), 1, 256);
    if (!quality || !distance) return wrong;
    levels.push_back({*quality, *distance});
  }
  if (levels.empty()) return wrong;
  return levels;
}

Result<std::vector<float>> read_thresholds(const std::string& text) {
  std::vector<float> thresholds;
  if (text == "none") return thresholds;
  for (const std::string_view part : parts_of(text)) {
    const auto grey = number_in(part, 1, 254);
    if (!grey) {
      thresholds.clear();
      break;
    }
    thresholds.push_back(float(*grey));
  }
  if (thresholds.empty())
    return Error{
        Errc::InvalidInput,
        "binary_thresholds must be up to 16 grey levels of 1 to 254 joined by '+', such as 64+128, or none"}
        .at("good-features.binary_thresholds = " + text);
  return thresholds;
}

}  // namespace

Result<void> GoodFeaturesSelector::check() const {
  if (const auto read = read_levels(levels); !read) return read.error();
  if (const auto read = read_thresholds(binary_thresholds); !read) return read.error();
  return {};
}

Result<Keypoints> GoodFeaturesSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const auto wanted, read_levels(levels));
  RELIEVO_TRY_ASSIGN(const auto thresholds, read_thresholds(binary_thresholds));
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  const CornerWindow window{window_px / 2, 1};
  Plane<float> response(&context.scratch, pair.width_px, pair.height_px);
  Plane<float> chosen(&context.scratch, pair.width_px, pair.height_px);

  const auto search = [&](const std::pmr::vector<float>& grey) {
    if (!corner_response(grey, selectable, window, smaller_eigenvalue, 0, context, response)) return false;
    for (const Level& level : wanted)
      if (!mark_peaks(response, {level.quality, 1, level.distance_px, max_points}, chosen, context))
        return false;
    return true;
  };
  if (!search(pair.left.grey)) return selection_stopped();
  if (!thresholds.empty()) {
    std::pmr::vector<float> binary(pair.left.grey.size(), &context.scratch);
    for (const float threshold : thresholds) {
      for (std::size_t k = 0; k < binary.size(); ++k)
        binary[k] = pair.left.grey[k] > threshold ? 255.0F : 0.0F;
      if (!search(binary)) return selection_stopped();
    }
  }
  return keypoints_of(chosen, max_points, context);
}

}  // namespace relievo::pipeline
