// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OutputFolder: results appear whole or not at all. Files are made in a hidden folder beside the
// target; commit() renames it into place, or, where the target exists already, each file over its
// predecessor. Without commit() the destructor leaves nothing behind; what a run that was killed has left
// goes when the next one begins with the same target. Errors: InvalidInput (the target is a file, or a
// store's folder), IoFailed (cannot be made or written), MediaFull. Thread: any, one a target.
#pragma once

#include <filesystem>
#include <string_view>

#include "hal/base/result.h"

namespace relievo::firmware {

class OutputFolder {
 public:
  static Result<OutputFolder> begin(const std::filesystem::path& target);
  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;
  ~OutputFolder();

  const std::filesystem::path& path() const { return work_; }  // where to write until commit()
  Result<void> commit();

 private:
  OutputFolder() = default;
  std::filesystem::path target_;
  std::filesystem::path work_;         // empty once committed or moved from
  std::filesystem::path made_parent_;  // the topmost folder that was missing, if any
};

// A small file, whole or not at all. An error names `place`: what the caller was asked for, not where
// the file lies for the moment.
Result<void> write_text(const std::filesystem::path& file, std::string_view text,
                        const std::filesystem::path& place);

}  // namespace relievo::firmware
