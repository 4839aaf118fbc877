// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Folders of ours on a stick, on which a hand may pull at any moment: what is in them is replaced as a
// whole, and what a pulled stick has left is put in order when it comes back.
// Thread: the keeper. Errors: IoFailed, MediaFull; of put_on_stick() also MediaMissing, Disconnected (pulled
// out meanwhile), Cancelled and those of `write`.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "firmware/base/output_folder.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/records/bundle_manifest.h"
#include "firmware/service/export_records.h"
#include "hal/removable_media.h"

namespace relievo::firmware {

// Where `place` is on the stick. IoFailed (ELOOP): a link is on the way, which would lead to files of the
// device.
Result<std::filesystem::path> place_on_stick(const std::filesystem::path& root,
                                             const std::filesystem::path& place);
// How far the work on a stick has come, for who waits and for who may stop it between two steps, the last
// excepted: then it is there.
struct StickWork {
  JobControl& control;
  ExportTrace& trace;
  Result<void> reach(ExportStep step, float share);
};
// What is in `made` is read back once it lies on the stick; then `made` becomes `target`. A folder that has
// this name already goes when the new one is there, not before. `work` may be missing; `done` of all of it is
// done before, and this is `share` of it. Gives the sums of the files.
Result<Sums> keep_folder(OutputFolder& made, const std::filesystem::path& target, hal::RemovableMedia& media,
                         StickWork* work, float done = 0, float share = 1);
// `write` makes the file or folder `place` of the stick, whole or not at all and read back; then the stick is
// let go. `work` may be missing.
Result<void> put_on_stick(hal::RemovableMedia& media, const std::filesystem::path& place, StickWork* work,
                          const std::function<Result<void>(const std::filesystem::path& target)>& write);
// The stick that is there, or MediaMissing.
Result<std::filesystem::path> plugged_in(hal::RemovableMedia& media);
Error pulled_too_early();
// What `write` says where it read back something else.
Error not_as_written(const std::filesystem::path& file);
// Clears away what is half written (".NAME.part…"), and brings back a folder whose successor did not come.
// Names that are not `ours` are somebody else's.
void tidy_folder(
    const std::filesystem::path& folder,
    bool (*ours)(std::string_view name) = [](std::string_view) { return true; });

}  // namespace relievo::firmware
