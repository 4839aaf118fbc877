// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stores as older versions made them. What fails, fails the test.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/model/calibration.h"
#include "storage/store.h"
#include "tests/storage/sample.h"

namespace relievo::storage::test {

inline constexpr std::int64_t kLastPlain = 6;  // the last version that knew no keys

void make_version(const std::filesystem::path& dir, std::int64_t version);  // empty

// A store whose log is today's, with its key beside it: the log as version 8 wrote it, which had no keyed
// end.
void set_log_back_to_8(const std::filesystem::path& dir);

// A store of version 6 as it was filled: people with models, notes, settings, a log.
struct OfBefore {
  OfBefore(const std::filesystem::path& dir, int people);
  static std::string name_of(int i);

  // All of it is there, sealed, and nothing of it can be read in any file.
  void judge(Store& store, const std::string& when) const;
  long readable() const;

  std::filesystem::path dir_;
  int people_ = 0;
  pipeline::StereoCalibration calibration = sample_calibration();
  std::vector<std::string> traces;
};

}  // namespace relievo::storage::test
