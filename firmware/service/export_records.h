// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Records on a stick: relievo/CODE/ with the newest portrait's files, record.txt and what another store
// takes in (records/bundle_manifest.h), one folder a person, each whole or not there; read back once more
// after the stick was let go and taken up again. What was written is read back and compared before a folder
// gets its name; what an earlier export left half written is cleared away by the next. Thread: the keeper;
// between two people and two steps it looks whether it is to stop. Errors: MediaMissing (no stick),
// MediaFull, Disconnected (pulled out meanwhile), Cancelled, NotFound, IoFailed (outcome_of_export() says
// what it means), the store's.
#pragma once

#include <vector>

#include "firmware/arguments/command_line.h"
#include "firmware/jobs/job_thread.h"
#include "hal/clock.h"
#include "hal/removable_media.h"
#include "storage/store.h"
#include "ui/view/service_view.h"

namespace relievo::firmware {

enum class ExportStep : std::uint8_t { Find, Load, Write, ReadBack, LetGo, Again };

// How far an export came. Written by the keeper; main reads it when the side task has ended.
struct ExportTrace {
  ExportStep step = ExportStep::Find;
  int asked = 0;  // records it is of
  int whole = 0;  // of these, on the stick, read back and under their names
};

// `further`: what stands beside each portrait's files (service/further_models.h).
Result<void> export_records(storage::Store& store, const hal::Clock& clock, hal::RemovableMedia& media,
                            const std::vector<storage::SubjectId>& subjects, const FurtherModels& further,
                            JobControl& control, ExportTrace& trace);

// What its error means to who asked: the same error is another thing at another step.
ui::Outcome outcome_of_export(const Error& error, const ExportTrace& trace);

}  // namespace relievo::firmware
