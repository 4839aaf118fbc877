// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stored form of a calibration: never YAML, whose truncation reads as a wrong number.
//
// Little-endian: "RCALIB\0\0" u16 version, u32 revision, the doubles and sizes in the order of
// StereoCalibration, SHA-256 of all before it. One length only; every double comes back bit for bit.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/calibration.h"

namespace relievo::storage {

// InvalidInput: numbers that are not finite, no focal length, no size, no baseline, no rotation.
Result<void> check_calibration(const pipeline::StereoCalibration& calibration);

std::vector<std::byte> encode_calibration(const pipeline::StereoCalibration& calibration);

// StoreCorrupt: not such a record, cut, changed. StoreNewer: a version of the form not known here.
Result<pipeline::StereoCalibration> decode_calibration(std::span<const std::byte> bytes);

}  // namespace relievo::storage
