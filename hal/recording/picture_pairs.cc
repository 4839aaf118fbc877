// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/recording/capture_file.h"

#include <map>
#include <system_error>

#include "hal/picture_file.h"

namespace relievo::hal {

Result<std::vector<PicturePairFiles>> find_picture_pairs(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::directory_iterator entries(folder, failed);
  if (failed)
    return Error{Errc::NotFound, "no such folder; give the one with the left* and right* pictures",
                 failed.value()}
        .at(folder.native());
  std::map<std::string, PicturePairFiles> by_rest;
  for (const std::filesystem::directory_iterator end; entries != end && !failed; entries.increment(failed)) {
    const std::filesystem::path& file = entries->path();
    const std::string stem = file.stem().native(), extension = lower_extension(file);
    const bool picture = extension == ".png" || extension == ".jpg" || extension == ".jpeg";
    const bool left = stem.starts_with("left"), right = stem.starts_with("right");
    if (!picture || (!left && !right) || !entries->is_regular_file(failed)) continue;
    const std::string rest = stem.substr(left ? 4 : 5);
    PicturePairFiles& pair = by_rest[rest];
    std::filesystem::path& mine = left ? pair.left : pair.right;
    if (!mine.empty())
      return invalid("two pictures with this name differ in their ending only; remove one").at(file.native());
    mine = file;
    const auto first = rest.find_first_not_of("_- ");
    pair.name = first == std::string::npos ? "left/right" : rest.substr(first);
  }
  if (failed) return Error{Errc::IoFailed, "the folder cannot be read", failed.value()}.at(folder.native());
  if (by_rest.empty())
    return Error{Errc::NotFound, "holds no pictures named left* and right* (png or jpg)"}.at(folder.native());
  std::vector<PicturePairFiles> pairs;
  for (auto& [rest, pair] : by_rest) {
    if (pair.right.empty())
      return invalid("has no partner right* of the same name; add it or remove this one")
          .at(pair.left.native());
    if (pair.left.empty())
      return invalid("has no partner left* of the same name; add it or remove this one")
          .at(pair.right.native());
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace relievo::hal
