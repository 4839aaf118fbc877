// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StoredVisits: the records of visits in the store. Borrows all it is given. Thread: the keeper; it has
// nothing that another thread writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "firmware/work/jobs.h"
#include "hal/clock.h"
#include "storage/store.h"

namespace relievo::firmware {

class StoredVisits : public VisitRecords {
 public:
  StoredVisits(storage::Store& store, const hal::Clock& clock, std::filesystem::path folder)
      : store_(store), clock_(clock), folder_(std::move(folder)) {}
  Result<KeptVisit> keep(const VisitRecord& record, const pipeline::FaceModel& model) override;
  // False also means that keep() would say MediaFull; a disk that does not tell has room.
  bool has_room(std::int32_t least_mib) const;
  // At most kMostWrongCodes an hour are looked at (CodeGuard).
  Result<RecordAnswer> look_up(const RecordQuestion& question) override;

 private:
  storage::Store& store_;
  const hal::Clock& clock_;
  std::filesystem::path folder_;  // of the store
};

// CodeGuard: how many wrong codes of records are listened to: kMostWrongCodes an hour, whoever types them
// and however often the program is started. Kept in the store's setting "codes", and written before a code
// is looked at, so that pulling the plug gives no further try. A clock that was set back begins the hour
// anew. A setting that cannot be read counts as a full hour. Thread: the keeper, as the store. Errors: the
// store's.
inline constexpr const char* kCodesSetting = "codes";
inline constexpr int kMostWrongCodes = 10;

class CodeGuard {
 public:
  CodeGuard(storage::Store& store, const hal::Clock& clock) : store_(store), clock_(clock) {}

  // May one more be looked at? It counts as wrong until was_right().
  Result<bool> spend();
  Result<void> was_right();

 private:
  struct Record {
    int wrong = 0;
    std::int64_t since_s = 0;  // seconds since 1970, of the first wrong one
  };
  Result<Record> read();
  Result<void> write(const Record& record);

  storage::Store& store_;
  const hal::Clock& clock_;
};

// MovedFaces: how many faces on end have said that the cameras have moved since they were calibrated, kept in
// the store's setting "moved_faces" with the calibration it was said of, and what the last of them said for
// the technician, in English: who switches the device off and on makes no calibration true.
// What was said of another calibration is no more. Thread: main; the store is written on the keeper. Errors
// of read(): the store's.
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
  // Once a turn in which nobody waits for the keeper: writes what has changed; what could not be written is
  // tried again (budget::kMovedFacesRetry).
  void keep(std::uint32_t revision, int faces, std::string_view note, SideTasks& side_tasks, EventLog& log,
            hal::Instant now);

 private:
  storage::Store& store_;
  std::uint32_t revision_ = 0;
  Said kept_;
  std::optional<hal::Instant> retry_at_;  // when what could not be written is tried again
};

// RunMark: a file that is there while the kiosk runs, and gone when it ended as it should. One that is
// found at the start means the power went, or the program did. Until leave() says otherwise it is left as it
// was found: a start that comes to nothing has told nobody. Thread: main. Errors of set(): IoFailed,
// MediaFull.
class RunMark {
 public:
  static Result<std::unique_ptr<RunMark>> set(const std::filesystem::path& folder);
  ~RunMark();
  RunMark& operator=(RunMark&&) = delete;
  void leave(bool stays) { stays_ = stays; }  // there when this goes?
  // Did the run before this one end in the middle?
  bool ended_early() const { return ended_early_; }

 private:
  RunMark(std::filesystem::path file, bool ended_early)
      : file_(std::move(file)), ended_early_(ended_early), stays_(ended_early) {}
  std::filesystem::path file_;
  bool ended_early_, stays_;
};

}  // namespace relievo::firmware
