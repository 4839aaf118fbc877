// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// relievo calibrate DIR --corners 10x7 --square-mm 20 [--pattern chessboard|charuco] -o rig.yml
//           [--report DIR] [--baseline-mm N]
//
// Reads left*.png|jpg and right*.png|jpg in name order, finds the board in each, calibrates, writes rig.yml
// and, where asked for, a folder with the report. One line a pair and the reasons of the verdict are told.
// Nothing half-written stays; a calibration that is refused is not written, its report is.
// Errors: NotFound (folder, pictures), InvalidInput (a name without its partner, pictures of
// different sizes, no board in any pair), PoorGeometry (too few pairs, refused), the files' own.
// args.store is the caller's business: the calibration comes back. Thread: main.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "hal/base/result.h"
#include "pipeline/calibrate/calibrator.h"
#include "storage/record.h"

namespace relievo::firmware {

struct PicturePairFiles {
  std::string name;  // what follows left and right, without _ or - before it
  Path left;
  Path right;
};

pipeline::BoardPattern pattern_of(const BoardArgs& board);

Result<std::vector<PicturePairFiles>> find_picture_pairs(const Path& folder);

// Can the file be written? Asked before the work begins.
Result<void> check_calibration_output(const Path& output);

// A line for a person. An error ends the work, which leaves nothing behind: nobody waits for it any more.
using Tell = std::function<Result<void>(const std::string& line)>;

// One line a view, then the verdict and its reasons.
Result<void> tell_quality(const pipeline::CalibrationQuality& quality, const Tell& tell);

// What the caller knows of the rig and the day.
struct RigToday {
  std::string made_at;  // for the report
  // Whose baseline is expected where --baseline-mm is not given.
  std::optional<pipeline::StereoCalibration> in_use{};
};

Result<pipeline::CalibratorOutput> run_calibrate(const CalibrateArgs& args, const Tell& tell,
                                                 const RigToday& today = {});

// The folder that `relievo calibrate --report DIR` writes: index.html for people, report.json for
// programs, and of each pair a picture with its corners and one with both views rectified.
// Whole or not at all. One line a pair is told. Thread: main.
// Errors: the pictures' (they are read once more), the disk's; each names its place.
Result<void> write_calibration_report(const Path& folder, const std::vector<PicturePairFiles>& pairs,
                                      const pipeline::CalibratorInput& input,
                                      const pipeline::CalibratorOutput& result, const std::string& made_at,
                                      const Tell& tell);

// How a calibration stands in the store's history, and how the history is told: a table, the heading and a
// line for each. What nobody knows is a dash. Thread: any.
storage::CalibrationFigures figures_of(const pipeline::CalibrationQuality& quality);
std::string history_heading();
std::string line_of(const storage::CalibrationInfo& calibration);

}  // namespace relievo::firmware
