// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reconstructions as documents (storage/document) on a stick: reconstructions/NAME.relievo, each whole or not
// there. What was written is read back and compared before it gets its name; then the stick is let go.
// Thread: keeper; between two pieces it looks whether it is to stop. Errors: MediaMissing (no stick),
// MediaFull, Disconnected (pulled out meanwhile), Cancelled, IoFailed (outcome_of_export() says what it
// means), NotFound; the document's.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware/jobs/job_thread.h"
#include "firmware/service/export_records.h"
#include "hal/removable_media.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware {

// A document in memory. It holds a face: the heap wipes it (base/wiping_heap.cc).
using SavedBytes = std::vector<std::byte>;

inline constexpr const char* kSavedFolder = "reconstructions";  // on the stick
inline constexpr const char* kSavedEnding = ".relievo";

Result<void> save_reconstruction(const SavedBytes& document, const std::string& name,
                                 hal::RemovableMedia& media, JobControl& control, ExportTrace& trace);
// Their file names, the newest first, so many at most.
Result<std::vector<std::string>> saved_reconstructions(hal::RemovableMedia& media, std::size_t most);
Result<SavedBytes> read_saved(const std::string& name, hal::RemovableMedia& media, JobControl& control);

// Calibrations on a stick, in both forms: calibrations/NAME/ with rig.yml (OpenCV's) and left.yaml,
// right.yaml (ROS), read back before the folder gets its name; then the stick is let go. Taken from a stick
// is what lies at its top, else in the folder of calibrations whose name comes last; of the two forms
// rig.yml, which says more. Thread: keeper. Errors: MediaMissing (no stick), NotFound (no calibration on it),
// Disconnected (pulled out meanwhile), MediaFull, IoFailed; those of pipeline/calibrate/file.
inline constexpr const char* kCalibrationsFolder = "calibrations";  // on the stick

Result<void> export_calibration(const pipeline::StereoCalibration& calibration, const std::string& name,
                                hal::RemovableMedia& media);

struct StickCalibration {
  pipeline::StereoCalibration calibration;
  std::string file;  // from the stick's top
};
Result<StickCalibration> import_calibration(hal::RemovableMedia& media);

}  // namespace relievo::firmware
