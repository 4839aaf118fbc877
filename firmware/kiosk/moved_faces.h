// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MovedFaces: how many faces on end have said that the cameras have moved since they were calibrated, kept in
// the store's setting "moved_faces" with the calibration it was said of, and what the last of them said for
// the technician, in English: who switches the device off and on makes no calibration true.
// What was said of another calibration is no more. Thread: main; the store is written on the keeper. Errors
// of read(): the store's.
#pragma once

#include <cstdint>
#include <string>

#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "storage/store.h"

namespace relievo::firmware {

class MovedFaces {
 public:
  explicit MovedFaces(storage::Store& store) : store_(store) {}
  struct Said {
    int faces = 0;
    std::string note;  // empty: nothing against the calibration
    bool operator==(const Said&) const = default;
  };
  // As it was kept of this calibration; nothing: of another. Before any thread uses the store.
  Result<Said> read(std::uint32_t revision);
  // Once a turn in which nobody waits for the keeper: writes what has changed.
  void keep(std::uint32_t revision, const Said& said, SideTasks& side_tasks, EventLog& log);

 private:
  storage::Store& store_;
  std::uint32_t revision_ = 0;
  Said kept_;
};

}  // namespace relievo::firmware
