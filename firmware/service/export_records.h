// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Records on a stick: relievo/CODE/ with the newest portrait's files, record.txt and what another store
// takes in (records/bundle_manifest.h), one folder a person, each whole or not there; read back once more
// after the stick was let go and taken up again. What was written is read back and compared before a folder
// gets its name; what an earlier export left half written is cleared away by the next. Who has no portrait is
// left out, and told of when all others are there. Thread: the keeper; between two people and two steps it
// looks whether it is to stop. Errors: MediaMissing (no stick), MediaFull, Disconnected (pulled out
// meanwhile), Cancelled, NotFound, IoFailed (outcome_of_export() says what it means), the store's.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "firmware/base/output_folder.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/records/bundle_manifest.h"
#include "hal/base/result.h"
#include "hal/clock.h"
#include "hal/removable_media.h"
#include "pipeline/model/face_model.h"
#include "storage/export/format/export_mesh.h"
#include "storage/store.h"
#include "ui/view/service_view.h"

namespace relievo::firmware {

// What may stand beside a model's files: a lighter model (light.*), a solid for printing (solid.*). Each
// leaves a line that says what it is. Errors: those of lighten(), make_solid() and the files, with `place`
// for what the caller was asked for; Cancelled, of a solid. That takes memory of its own while it is made
// (budget::kSolidBytes). Thread: any.
Result<std::vector<std::string>> write_further_models(
    const pipeline::FaceModel& model, const FurtherModels& wanted, const std::filesystem::path& folder,
    storage::ExportFrame frame, const std::filesystem::path& place, const std::atomic<bool>& cancelled);

enum class ExportStep : std::uint8_t { Find, Load, Note, Write, ReadBack, LetGo, Again };

// How far an export came. Written by the keeper; main reads it when the side task has ended.
struct ExportTrace {
  ExportStep step = ExportStep::Find;
  int asked = 0;                  // records it is of
  int whole = 0;                  // of these, on the stick, read back and under their names
  std::optional<Error> left_out;  // why the last one that has nothing to export is not there
};

// `further`: what stands beside each portrait's files.
Result<void> export_records(storage::Store& store, const hal::Clock& clock, hal::RemovableMedia& media,
                            const std::vector<storage::SubjectId>& subjects, const FurtherModels& further,
                            JobControl& control, ExportTrace& trace);

// What its error means to who asked: the same error is another thing at another step.
ui::Outcome outcome_of_export(const Error& error, const ExportTrace& trace);

// Folders of ours on a stick, on which a hand may pull at any moment: what is in them is replaced as a
// whole, and what a pulled stick has left is put in order when it comes back.
// Thread: the keeper. Errors: IoFailed, MediaFull; of put_on_stick() also MediaMissing, Disconnected (pulled
// out meanwhile), Cancelled and those of `write`.

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
