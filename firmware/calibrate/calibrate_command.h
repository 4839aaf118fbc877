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

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/device.h"
#include "hal/recording/capture_file.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/calibrator.h"
#include "pipeline/calibrate/live/live_state.h"
#include "pipeline/model/calibration.h"
#include "storage/record.h"

namespace relievo::firmware {

pipeline::BoardPattern pattern_of(const BoardArgs& board);

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
Result<void> write_calibration_report(const Path& folder, const std::vector<hal::PicturePairFiles>& pairs,
                                      const pipeline::CalibratorInput& input,
                                      const pipeline::CalibratorOutput& result, const std::string& made_at,
                                      const Tell& tell);

// How a calibration stands in the store's history, and how the history is told: a table, the heading and a
// line for each. What nobody knows is a dash. Thread: any.
storage::CalibrationFigures figures_of(const pipeline::CalibrationQuality& quality);
std::string history_heading();
std::string line_of(const storage::CalibrationInfo& calibration);

// relievo calibrate --print-pattern chessboard|charuco --corners 10x7 --square-mm 20 -o board.pdf
//
// A page at true size: the board in the middle of the smallest ISO paper that holds it with a white
// margin of at least a square, below it a ruler to check the print with, and what it is. PDF or SVG.
// Page coordinates: from the top left, x right, y down, mm.
// Thread: any.

struct PatternPage {
  const char* paper = "";  // "A4"
  double width_mm = 0, height_mm = 0;
  double board_x_mm = 0, board_y_mm = 0;    // of the outer squares
  double ruler_x_mm = 0, ruler_y_mm = 0;    // left end; the line itself
  double ruler_mm = 0;                      // true length
  double text_x_mm = 0, text_width_mm = 0;  // beside the ruler
  std::vector<std::string> text;
};

// Errors: InvalidInput (wrong pattern, larger than A0).
Result<PatternPage> lay_out_pattern(const pipeline::BoardPattern& pattern);

enum class PageFormat { Pdf, Svg };

// By the ending of the file's name. InvalidInput: another one.
Result<PageFormat> page_format(std::string_view file_name);

// The page as a file's bytes. Errors: the pattern's, LibraryFailed.
Result<std::vector<std::byte>> draw_page(const PatternPage& page, const pipeline::BoardPattern& pattern,
                                         PageFormat format);

// relievo calibrate --live --board sim|folder:DIR|linux:FILE --corners 10x7 --square-mm 20 -o rig.yml
//   [--goal-mm 0.1] [--baseline-mm N]
//
// A live calibration without a screen: one line a pair says what was decided and what to do next, then
// how many pairs a second it kept up with, then the verdict as calibrate gives it. A pair that cannot be
// used ends it. Nothing half-written stays; a calibration that is refused is not written.
// Errors: the board's, LiveCalibration's, calibrate()'s, PoorGeometry (refused). Thread: main.

// Where a live calibration without a screen gets its pairs from: a board held before the simulated rig
// by a hand that follows the advice, or the cameras of a device (hal/device.h). Of a folder every pair is
// shown once, or, where no capture.json says that it is a recording, twice: a photograph is a board that
// is held still.
struct LivePair {
  ImageView left;  // until the next one is asked for
  ImageView right;
  std::chrono::nanoseconds at{0};
};

class LivePairs {
 public:
  virtual ~LivePairs() = default;
  // What the cameras see after the person has seen `state`. No value: there are no more.
  virtual Result<std::optional<LivePair>> next(const pipeline::LiveState& state) = 0;
  // Which cameras they are; empty before the first pair, and of cameras that say nothing of themselves.
  virtual pipeline::RigCameras cameras() const { return {}; }
};

// Errors: the folder's own (of "folder:DIR").
Result<std::unique_ptr<LivePairs>> make_device_pairs(std::unique_ptr<hal::Device> device,
                                                     std::string_view name);

Result<pipeline::CalibratorOutput> run_calibrate_live(const CalibrateLiveArgs& args, LivePairs& pairs,
                                                      const Tell& tell, const RigToday& today = {});

}  // namespace relievo::firmware
