// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/whole_file.h"

#include <gtest/gtest.h>

#include <string_view>

#include "tests/support/temporary_folder.h"

namespace relievo {
namespace {

TEST(WholeFile, GetsItsNameAfterWhatMustBeThereBefore) {
  const test::TemporaryFolder folder;
  const auto bytes = [](std::string_view text) { return std::as_bytes(std::span(text)); };
  bool named = true;
  ASSERT_TRUE(write_whole_file(folder / "a", bytes("new"), [&]() -> Result<void> {
    named = std::filesystem::exists(folder / "a");
    return {};
  }));
  EXPECT_FALSE(named);
  EXPECT_EQ(test::read_text(folder / "a"), "new");
  const auto failed = write_whole_file(folder / "a", bytes("newer"), []() -> Result<void> {
    return Error{Errc::Cancelled, "as the test says"};
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, Errc::Cancelled);
  EXPECT_EQ(test::read_text(folder / "a"), "new");
  EXPECT_EQ(test::listing(folder.path()), "a\n");
  // Nor is that done in vain, where the file cannot get its name.
  named = false;
  std::filesystem::create_directory(folder / "b");
  EXPECT_FALSE(write_whole_file(folder / "b", bytes("new"), [&]() -> Result<void> {
    named = true;
    return {};
  }));
  EXPECT_FALSE(named);
}

}  // namespace
}  // namespace relievo
