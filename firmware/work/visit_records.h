// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The records as a visit needs them. Between the threads go values alone, so that none looks into another's:
//
//   main: VisitRecord, RecordQuestion --> keeper: VisitRecords --> main: KeptVisit, RecordAnswer
//
// Errors: the store's, and MediaFull. Thread: the keeper alone calls VisitRecords.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/work/stage_runner.h"
#include "hal/base/wiped_text.h"
#include "pipeline/calibrate/drift.h"
#include "pipeline/model/face_model.h"
#include "storage/record.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

// All that is stored of a visit beside its model.
struct VisitRecord {
  WipedText name;                           // shown; of the new record, if it is one
  std::optional<storage::SubjectId> whose;  // a record that is there already
  bool renews = false;                      // what it held goes
  storage::Consent consent;
  std::uint32_t calibration = 0;  // revision
  std::string calibration_note;   // as the report calls it
  std::string algorithms;
  std::int32_t least_room_mib = 0;  // the disk keeps so much free
  // Added when it is stored:
  std::vector<StageRecord> stages;
  std::optional<pipeline::DriftJudgement> drift;
};

// In place: on its way to the person nothing can fail any more.
struct KeptVisit {
  storage::EnrolmentId enrolment{};
  ShortWipedText<24> receipt;  // for the person's erasure
  ShortWipedText<32> link;     // for where the operator offers their portrait; erases nothing
  storage::WallTime at{};
};

// Is there a record of this name, or of this code?
struct RecordQuestion {
  WipedText name, code;  // no code: the name is asked about
  bool tells_names = true;
};

struct RecordAnswer {
  ui::Known known = ui::Known::NotAsked;
  storage::SubjectId record{};  // of a code
};

class VisitRecords {
 public:
  virtual ~VisitRecords() = default;
  virtual Result<KeptVisit> keep(const VisitRecord& record, const pipeline::FaceModel& model) = 0;
  virtual Result<RecordAnswer> look_up(const RecordQuestion& question) = 0;
};

}  // namespace relievo::firmware
