// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RecordingController: the buttons that put the test capture or all of the reconstruction
// (stick_files.h) on the stick, and bring a saved one back; how far it is, how it ended, and where
// it lies. One at a time; who leaves ends it, and nothing half written stays; an end that comes later is not
// heard (SideTasks::cancel()). Thread: main; the stick is the keeper's. Errors: none are returned, view() has
// them, but what is wrong with a document goes to `refused`.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/service/export_records.h"
#include "firmware/service/side_tasks.h"
#include "firmware/technician/stick_files.h"
#include "hal/recording/capture_file.h"
#include "pipeline/model/stereo_frame.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

class RecordingController {
 public:
  RecordingController(SideTasks& side_tasks, hal::Device& device)
      : side_tasks_(side_tasks), device_(device) {}
  // The front, then the sides; `as_taken`: exposure and serial numbers.
  void record(std::span<const pipeline::StereoFrame> shots, const hal::RecordedPair& as_taken);
  // `make` runs on the worker: the document of what is in the session.
  void save(std::function<Result<SavedBytes>()> make);
  // Those on the stick; shown from then on, until hide().
  void list();
  void hide() { files_.reset(); }
  // `read` hears the bytes of a whole document.
  void load(std::size_t row, std::function<void(SavedBytes)> read, std::function<void(const Error&)> refused);
  void stop();
  // Of what list() has found: without its ending, as shown_name().
  std::string saved_name(std::size_t row) const;
  // There is another capture now.
  void capture_gone();
  void forget();
  ui::TechnicianRecording view() const;
  ui::TechnicianSaved saved() const {
    return files_ ? ui::TechnicianSaved{true, shown_} : ui::TechnicianSaved{};
  }

 private:
  // False: something else runs.
  bool begin();
  void write(SavedBytes document);
  void ended(const std::optional<Error>& error, const ExportTrace& trace, const std::string& where);

  SideTasks& side_tasks_;
  hal::Device& device_;
  std::string where_;
  ui::Outcome outcome_ = ui::Outcome::None;
  bool running_ = false;
  bool stopped_ = false;    // a document whose making does not look at it: then it is not written
  std::uint32_t task_ = 0;  // what runs
  std::optional<std::vector<std::string>> files_;  // on the stick, while they are shown ...
  std::vector<std::string> shown_;                 // ... under these names
};

}  // namespace relievo::firmware
