// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/compared_pair.h"

#include <algorithm>

#include "firmware/measure/true_surface.h"

namespace relievo::firmware::compare {
namespace {

// "aloeL" of aloeL.jpg, but "d1" of d1/left.png; none twice.
std::string name_of(const Path& left, const std::vector<ComparedPair>& others) {
  const Path folder = std::filesystem::absolute(left).lexically_normal().parent_path().filename();
  const std::string name = (left.stem() == "left" && !folder.empty() ? folder : left.stem()).string();
  std::string free = name;
  const auto taken = [&](const ComparedPair& pair) { return pair.name == free; };
  for (int i = 2; std::any_of(others.begin(), others.end(), taken); ++i)
    free = name + " " + std::to_string(i);
  return free;
}

Result<void> read_truth(const Path& truth, const CompareArgs& args, ComparedPair& pair) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(truth, ignored)) {
    if (!args.rectified)
      return Error{
          Errc::InvalidInput,
          "is a disparity map, which fits rectified pictures: give --rectified, or a folder of 'relievo simulate face --truth'"}
          .at(truth.string());
    RELIEVO_TRY_ASSIGN(pair.disparities, read_disparity_truth(truth, args.truth_scale));
    const DisparityMap& map = pair.disparities->map;
    if (map.width_px == pair.pictures.left.width_px && map.height_px == pair.pictures.left.height_px)
      return {};
    return Error{Errc::InvalidInput, "has another size than the left picture: give the truth of this pair"}
        .at(truth.string());
  }
  if (args.rectified)
    return Error{Errc::InvalidInput,
                 "is a folder of the simulated rig, whose pictures are not rectified: give --calibration"}
        .at(truth.string());
  RELIEVO_TRY_ASSIGN(pair.view, measure::TruthView::read(truth));
  RELIEVO_TRY_ASSIGN(pair.head, measure::read_true_surface(truth / "head.ply"));
  return {};
}

}  // namespace

Result<std::vector<ComparedPair>> read_pairs(const CompareArgs& args) {
  const std::size_t count = args.pictures.size() / 2;
  std::vector<ComparedPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const Path& left = args.pictures[2 * i];
    ComparedPair pair;
    pair.name = name_of(left, pairs);
    RELIEVO_TRY_ASSIGN(pair.pictures, read_pair(left, args.pictures[2 * i + 1]));
    const auto of_pair = [i](const std::vector<Path>& given) {
      return given.size() == 1 ? given[0] : given[i];
    };
    if (args.rectified) {
      pair.range = {args.least_disparity_px, args.most_disparity_px};
    } else {
      RELIEVO_TRY_ASSIGN(pair.calibration,
                         read_calibration_for(pair.pictures, of_pair(args.calibrations), left));
    }
    if (!args.truths.empty()) RELIEVO_TRY(read_truth(of_pair(args.truths), args, pair));
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace relievo::firmware::compare
