// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StoredVisits: the records of visits in the store. Borrows all it is given. Thread: the keeper; it has
// nothing that another thread writes.
#pragma once

#include <filesystem>

#include "firmware/work/visit_records.h"
#include "hal/clock.h"
#include "storage/store.h"

namespace relievo::firmware {

class StoredVisits : public VisitRecords {
 public:
  StoredVisits(storage::Store& store, const hal::Clock& clock, std::filesystem::path folder)
      : store_(store), clock_(clock), folder_(std::move(folder)) {}
  Result<KeptVisit> keep(const VisitRecord& record, const pipeline::FaceModel& model) override;
  // At most kMostWrongCodes an hour are looked at (CodeGuard).
  Result<RecordAnswer> look_up(const RecordQuestion& question) override;

 private:
  storage::Store& store_;
  const hal::Clock& clock_;
  std::filesystem::path folder_;  // of the store
};

}  // namespace relievo::firmware
