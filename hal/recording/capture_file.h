// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// capture.json: what a recording knows about its frames beside the pictures.
//
//   { "cameras": {"left": {"serial": "A"}, "right": {"serial": "B"}},
//     "frames": [ {"number": 0, "left_ns": 0, "right_ns": 180000, "exposure_us": 4000, "gain": 1.0} ],
//     "head": true }
//
// "head": the frames are one head, from in front, then turned to its sides; without it, false.
// Times are nanoseconds from any common origin. "number" is the NNNNNN of left_NNNNNN.png.
// Errors: NotFound, InvalidInput (says what is wrong), IoFailed, OutOfMemory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace relievo::hal {

// record_pair(): puts one captured pair behind those that a folder holds already; make_folder_device()
// replays it bit for bit, with its skew, exposure and serial numbers. The pictures are written before
// capture.json names them: a pair whose writing was cut short is written over by the next. Thread: keeper,
// one writer a folder. Errors: InvalidInput (a picture without pixels, views of different sizes or formats, a
// folder whose capture.json cannot be read), IoFailed.
struct RecordedPair {
  ImageView left, right;
  std::int64_t left_ns = 0, right_ns = 0;  // of the exposures, from any common origin
  std::int64_t exposure_us = 0;
  double gain = 1;
  std::string left_serial, right_serial;
  bool of_head = false;  // so are all of its folder
};

// "left_NNNNNN.png"; `side` is left or right.
std::string recorded_name(const char* side, std::int64_t number);

// The folder is made when it is not there, the way to it is not: where a stick was pulled out, nothing is
// written in its place. The number under which the pair stands: left_NNNNNN.png.
Result<std::int64_t> record_pair(const std::filesystem::path& folder, const RecordedPair& pair);

struct CaptureRecord {
  std::int64_t number = 0;
  std::int64_t left_ns = 0, right_ns = 0;
  std::int64_t exposure_us = 0;
  double gain = 1;
};

struct CaptureFile {
  std::string left_serial, right_serial;
  std::vector<CaptureRecord> frames;
  bool head = false;
};

Result<CaptureFile> read_capture_file(const std::filesystem::path& file);
// A folder's capture.json; an empty one where there is none.
Result<CaptureFile> capture_file_in(const std::filesystem::path& folder);
Result<void> write_capture_file(const std::filesystem::path& file, const CaptureFile& capture);
// left, right, left, right ... of the frames that capture.json names, in its order. NotFound: one is missing.
Result<std::vector<std::filesystem::path>> recorded_pictures(const std::filesystem::path& folder);

struct PicturePairFiles {
  std::string name;  // what follows "left" and "right", without _ or - before it; nothing does: "left/right"
  std::filesystem::path left, right;
};

// The left* and right* pictures (png, jpg) of a folder, paired by what follows in their names, in the order
// of their names. Errors: NotFound (no folder, no picture), InvalidInput (no partner, two of one name),
// IoFailed. Thread: any.
Result<std::vector<PicturePairFiles>> find_picture_pairs(const std::filesystem::path& folder);

}  // namespace relievo::hal
