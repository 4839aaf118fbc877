// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The folder "relievo" of a stick, on which a hand may pull at any moment: a record's folder is replaced as a
// whole, and what a pulled stick has left is put in order when it comes back.
// Thread: the keeper. Errors: IoFailed, MediaFull.
#pragma once

#include <filesystem>

#include "firmware/command/output_folder.h"

namespace relievo::firmware {

// `made` becomes `target`; a folder that has this name already goes when the new one is there, not before.
Result<void> replace_folder(OutputFolder& made, const std::filesystem::path& target);
// Clears away what is half written (".CODE.part…"), and brings back a folder whose successor did not come.
void tidy_folder(const std::filesystem::path& folder);

}  // namespace relievo::firmware
