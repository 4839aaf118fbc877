// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Folders of ours on a stick, on which a hand may pull at any moment: a folder in them is replaced as a
// whole, and what a pulled stick has left is put in order when it comes back.
// Thread: the keeper. Errors: IoFailed, MediaFull.
#pragma once

#include <filesystem>
#include <string_view>

#include "firmware/base/output_folder.h"

namespace relievo::firmware {

// `made` becomes `target`; a folder that has this name already goes when the new one is there, not before.
Result<void> replace_folder(OutputFolder& made, const std::filesystem::path& target);
// Clears away what is half written (".NAME.part…"), and brings back a folder whose successor did not come.
// Names that are not `ours` are somebody else's.
void tidy_folder(
    const std::filesystem::path& folder,
    bool (*ours)(std::string_view name) = [](std::string_view) { return true; });

}  // namespace relievo::firmware
