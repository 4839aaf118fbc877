// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ChainRecord: what the default chain made of a pair of pictures, stage by stage, so that two machines, two
// builds or two numbers of threads can be compared by their files. Rectified pixels and millimetres in the
// left camera's frame. A file of a record is for this machine's own use. Errors: NotFound, InvalidInput,
// IoFailed, those of the pipeline. Thread: one caller.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/geometry.h"
#include "pipeline/model/point_cloud.h"

namespace relievo::bench {

struct RecordedMatch {  // of every match, judged; no byte of it is padding
  float x_px = 0, y_px = 0, disparity_px = 0, sigma_px = 0;
  std::uint32_t rejected_by = 0;
};

struct ChainRecord {
  std::vector<float> left_grey, right_grey;  // 0..255, of the rectified views
  std::vector<RecordedMatch> matches;
  std::vector<pipeline::CloudPoint> points;
  std::vector<pipeline::Vec3f> vertices_mm;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint8_t> rgb;  // of the texture
};

struct ChainPictures {
  std::filesystem::path left, right, calibration;
};

Result<ChainRecord> record_chain(const ChainPictures& pictures, int threads);

Result<void> write_record(const std::filesystem::path& file, const ChainRecord& record);
Result<ChainRecord> read_record(const std::filesystem::path& file);

}  // namespace relievo::bench
