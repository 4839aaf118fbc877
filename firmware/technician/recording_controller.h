// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RecordingController: the buttons that put the test capture or all of the reconstruction
// (stick_files.h) on the stick, and bring a saved one back; how far it is, how it ended, and where
// it lies. One at a time; who leaves ends it, and nothing half written stays. Thread: main; the stick is the
// keeper's. Errors: none are returned, view() has them, but what is wrong with a document goes to `refused`.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/jobs/job_thread.h"
#include "firmware/service/export_records.h"
#include "firmware/service/side_tasks.h"
#include "firmware/technician/stick_files.h"
#include "hal/recording/capture_file.h"
#include "hal/removable_media.h"
#include "pipeline/model/stereo_frame.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

// The technician's test capture on a stick: captures/NAME/ with its pair, or a head's pairs (hal/recording),
// which folder:DIR replays bit for bit. It is read back and compared before the folder gets its name, and
// then the stick is let go; what an earlier recording left half written is cleared away. Thread: keeper;
// between two steps it looks whether it is to stop. Memory: CaptureCopy's, wiped with it. Errors:
// MediaMissing (no stick), MediaFull, Disconnected (pulled out meanwhile), Cancelled, IoFailed
// (outcome_of_export() says what it means).

// Pairs of its own, so that the session may be wiped while a slow stick is still being written to.
class CaptureCopy {
 public:
  // Of `as_taken` views and times are replaced.
  CaptureCopy(std::span<const pipeline::StereoFrame> shots, const hal::RecordedPair& as_taken);
  ~CaptureCopy();
  CaptureCopy(const CaptureCopy&) = delete;
  CaptureCopy& operator=(const CaptureCopy&) = delete;
  std::span<const hal::RecordedPair> pairs() const { return pairs_; }

 private:
  std::vector<std::vector<std::byte>> rooms_;
  std::vector<hal::RecordedPair> pairs_;
};

inline constexpr const char* kCapturesFolder = "captures";  // on the stick

Result<void> record_capture(std::span<const hal::RecordedPair> pairs, const std::string& name,
                            hal::RemovableMedia& media, JobControl& control, ExportTrace& trace);

class RecordingController {
 public:
  RecordingController(SideTasks& side_tasks, hal::Device& device)
      : side_tasks_(side_tasks), device_(device) {}
  // The front, then the sides; `as_taken`: exposure and serial numbers.
  void record(std::span<const pipeline::StereoFrame> shots, const hal::RecordedPair& as_taken);
  // `make` runs on the worker: the document of what is in the session.
  void save(std::function<Result<std::vector<std::byte>>()> make);
  // Those on the stick; shown from then on, until hide().
  void list();
  void hide() { names_.reset(); }
  // `read` hears the bytes of a whole document.
  void load(std::size_t row, std::function<void(std::shared_ptr<const SavedBytes>)> read,
            std::function<void(const Error&)> refused);
  void stop();
  // What a capture of this moment is called.
  std::string name_now() const;
  // Of what list() has found: without its ending.
  std::string saved_name(std::size_t row) const;
  // There is another capture now.
  void capture_gone();
  void forget();
  ui::TechnicianRecording view() const;
  ui::TechnicianSaved saved() const {
    return names_ ? ui::TechnicianSaved{true, *names_} : ui::TechnicianSaved{};
  }

 private:
  // Cancelled: it is to stop, before it has come to the stick.
  Result<void> go_on() const;
  // What runs from now on; null: something else does.
  std::shared_ptr<ExportTrace> begin();
  void write(std::shared_ptr<const SavedBytes> document);
  void ended(const std::optional<Error>& error, const ExportTrace& trace, const std::string& where);

  SideTasks& side_tasks_;
  hal::Device& device_;
  std::string where_;
  ui::Outcome outcome_ = ui::Outcome::None;
  bool running_ = false;
  bool making_ = false;               // a document, on the worker: the stick is somebody else's yet
  std::atomic<bool> stopped_{false};  // what runs; read on the keeper, too
  std::optional<std::vector<std::string>> names_;  // on the stick, while they are shown
  std::uint32_t visit_ = 0;  // what a visit to the pages before this one asked for is not told here
};

}  // namespace relievo::firmware
