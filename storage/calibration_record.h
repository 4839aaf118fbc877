// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stored form of a calibration: never YAML, whose truncation reads as a wrong number.
//
// Little-endian: "RCALIB\0\0" u16 form, u32 revision, the doubles and sizes in the order of
// StereoCalibration, the figures (u8 grade, three doubles), the cameras' names (each u8 length, 255 bytes);
// SHA-256 of all before it. One length; every double comes back bit for bit.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/calibration.h"
#include "storage/record.h"

namespace relievo::storage {

// InvalidInput: numbers that are not finite, no focal length, no size, no baseline, no rotation.
Result<void> check_calibration(const pipeline::StereoCalibration& calibration);

std::vector<std::byte> encode_calibration(const pipeline::StereoCalibration& calibration,
                                          const CalibrationFigures& figures = {});

struct StoredCalibration {
  pipeline::StereoCalibration calibration;
  CalibrationFigures figures;
};

// StoreCorrupt: not such a record, cut, changed. StoreNewer: a form not known here.
Result<StoredCalibration> decode_calibration(std::span<const std::byte> bytes);

}  // namespace relievo::storage
