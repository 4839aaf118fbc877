// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of the store put into it.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hal/clock.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/recognition_images.h"
#include "storage/sqlite/sqlite_store.h"

namespace relievo::storage::test {

// Stands still until told otherwise.
class StillClock final : public hal::Clock {
 public:
  hal::Instant now() const override { return {}; }
  std::chrono::system_clock::time_point wall_now() const override { return at; }
  std::chrono::system_clock::time_point at{std::chrono::milliseconds(1'772'000'000'123)};
};

// A curved surface of side x side vertices in the camera frame, 600 mm away, with a seam in its
// texture down the middle, awkward floats, and numbers that differ by `seed`.
pipeline::FaceModel sample_model(int side = 12, unsigned seed = 1);
pipeline::RecognitionImages sample_images();  // a few pixels of every kind
pipeline::StereoCalibration sample_calibration();
NewEnrolment sample_enrolment(const pipeline::FaceModel& model);

// Every bit of every field.
bool identical(const pipeline::FaceModel& a, const pipeline::FaceModel& b);

// Fails the test where there is none.
std::unique_ptr<Store> opened(const std::filesystem::path& dir, const SqliteStoreOptions& options = {});
inline const SqliteStoreOptions kNoReserve{.reserve_bytes = 0};

// Of what must fail.
template <typename T>
Errc code_of(const Result<T>& result) {
  EXPECT_FALSE(result);
  return result ? Errc::Cancelled : result.error().code;
}

std::string all_bytes(const std::filesystem::path& dir);  // of every file in it

}  // namespace relievo::storage::test
