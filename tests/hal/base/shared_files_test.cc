// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/shared_files.h"

#include <gtest/gtest.h>

#include <stdlib.h>

#include "tests/support/temporary_folder.h"

namespace relievo {
namespace {

namespace fs = std::filesystem;

TEST(SharedFiles, LieWhereTheEnvironmentSaysElseBesideTheProgramElseWhereTheyWereBuilt) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "bin");
  test::write_text(folder / "bin/relievo", "");
  fs::create_symlink(folder / "bin/relievo", folder / "link");
  const auto found = [&] { return shared_files("RELIEVO_TEST_FILES", "words", "/built", folder / "link"); };
  EXPECT_EQ(found(), "/built");
  fs::create_directories(folder / "share/relievo/words");
  EXPECT_EQ(found(), fs::canonical(folder / "share/relievo/words"));
  ::setenv("RELIEVO_TEST_FILES", "/named", 1);
  EXPECT_EQ(found(), "/named");
  ::unsetenv("RELIEVO_TEST_FILES");
  EXPECT_EQ(shared_files("RELIEVO_TEST_FILES", "words", "/built", folder / "none"), "/built");
}

}  // namespace
}  // namespace relievo
