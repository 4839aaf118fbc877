// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MovedFaces: how many faces on end have said that the cameras have moved since they were calibrated, kept in
// the store's setting "moved_faces" with the calibration it was said of: who switches the device off and on makes
// no calibration true. Counts of another calibration are no more.
// Thread: main; the store is written on the keeper. Errors of read(): the store's.
#pragma once

#include <cstdint>

#include "firmware/service/errands.h"
#include "firmware/service/event_log.h"
#include "storage/store.h"

namespace relievo::firmware {

class MovedFaces {
 public:
  explicit MovedFaces(storage::Store& store) : store_(store) {}
  // As it was kept of this calibration; 0: nothing was, or of another. Before any thread uses the store.
  Result<int> read(std::uint32_t revision);
  // Once a turn in which nobody waits for the keeper: writes what has changed.
  void keep(std::uint32_t revision, int faces, Errands& errands, EventLog& log);

 private:
  storage::Store& store_;
  std::uint32_t revision_ = 0;
  int faces_ = 0;
};

}  // namespace relievo::firmware
