// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FileMatcher ("file-matches"): matches made by hand or elsewhere, read from a text file. One match a line:
//
//   # left x, left y, disparity, and one standard deviation of the disparity where it is known
//   512.5 300 41.25
//   600, 310.5, 40, 0.2
//
// full-size rectified pixels; blanks, tabs or one comma between numbers; '#' begins a comment; a point as
// decimal sign. The file says where: keypoints are not asked, and the result is scattered whatever they are.
// cost is one minus the correlation of 9 x 9 pixels at the match; sigma_px the file's, else the option's.
// Errors: NotFound or IoFailed (the file), InvalidInput (a line that is none of the above, a place outside
// the pictures, a sigma that is not positive, more than 4 MiB), each with the file and the line; as Matcher.
#pragma once

#include <string>

#include "pipeline/base/options.h"
#include "pipeline/match/matcher.h"

namespace relievo::pipeline {

struct FileMatcherOptions {
  std::string path;       // none: matching fails and says so
  float sigma_px = 0.5F;  // where the file has none: what a careful hand reaches
  Result<void> check() const;
};

template <typename Field>
void describe(FileMatcherOptions& o, Field&& field) {
  field("path", o.path, OptionRange{0, 0},
        "text file, a match a line: x y disparity [sigma], rectified pixels");
  field("sigma_px", o.sigma_px, OptionRange{0.001, 100},
        "standard deviation of matches whose line has none, pixels");
}

class FileMatcher final : public Matcher {
 public:
  explicit FileMatcher(const FileMatcherOptions& options) : options_(options) {}
  std::string_view name() const override { return "file-matches"; }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints,
                         StageContext& context) const override;

 private:
  FileMatcherOptions options_;
};

}  // namespace relievo::pipeline
