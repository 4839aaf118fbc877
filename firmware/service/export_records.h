// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Records on a stick: relievo/CODE/ with the newest portrait's files and record.txt, one folder a
// person, each whole or not there. What was written is read back and compared before the stick is let go.
// Thread: the keeper; between two people and two steps it looks whether it is to stop.
// Errors: MediaMissing (no stick), MediaFull, Disconnected (pulled out meanwhile), Cancelled, NotFound,
// IoFailed (what was read back is not what was written), the store's.
#pragma once

#include <vector>

#include "firmware/work/job_thread.h"
#include "hal/removable_media.h"
#include "storage/store.h"

namespace relievo::firmware {

Result<void> export_records(storage::Store& store, hal::RemovableMedia& media, const std::vector<storage::SubjectId>& subjects, JobControl& control);

}  // namespace relievo::firmware
