// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/replay/picture_pairs.h"

#include <cctype>
#include <map>
#include <system_error>

namespace relievo::hal {
namespace {

bool is_picture(const std::filesystem::path& file) {
  std::string e = file.extension().native();
  for (char& c : e) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return e == ".png" || e == ".jpg" || e == ".jpeg";
}

}  // namespace

Result<std::vector<PicturePairFiles>> find_picture_pairs(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::directory_iterator entries(folder, failed);
  if (failed)
    return Error{Errc::NotFound, "there is no such folder of pictures", failed.value()}.at(folder.native());
  std::map<std::string, PicturePairFiles> by_rest;  // sorted by name
  for (const auto& entry : entries) {
    const std::string stem = entry.path().stem().native();
    if (!is_picture(entry.path()) || !entry.is_regular_file(failed)) continue;
    const bool left = stem.starts_with("left"), right = stem.starts_with("right");
    if (!left && !right) continue;
    const std::string rest = stem.substr(left ? 4 : 5);
    PicturePairFiles& pair = by_rest[rest];
    std::filesystem::path& mine = left ? pair.left : pair.right;
    if (!mine.empty())
      return Error{Errc::InvalidInput, "two pictures share this name; keep one of them"}.at(
          entry.path().native());
    mine = entry.path();
    pair.rest = rest;
  }
  if (by_rest.empty())
    return Error{Errc::NotFound, "this folder holds no left* and right* pictures (png or jpg)"}.at(
        folder.native());
  std::vector<PicturePairFiles> pairs;
  for (auto& [rest, pair] : by_rest) {
    if (pair.right.empty())
      return Error{Errc::InvalidInput, "this left picture has no right partner of the same name"}.at(
          pair.left.native());
    if (pair.left.empty())
      return Error{Errc::InvalidInput, "this right picture has no left partner of the same name"}.at(
          pair.right.native());
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace relievo::hal
