// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/whole_file.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <fstream>
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

TEST(WholeFile, IsNobodyElsesWhereThatIsAsked) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "own") << "as an older version wrote it";
  ASSERT_TRUE(write_whole_file(folder / "own", {}, {}, 0600));
  ASSERT_TRUE(write_whole_file(folder / "other", {}));
  const auto mode = [&](const char* name) { return std::filesystem::status(folder / name).permissions(); };
  EXPECT_EQ(mode("own"), std::filesystem::perms(0600));
  const auto umask = ::umask(0);
  ::umask(umask);
  EXPECT_EQ(mode("other"), std::filesystem::perms(0666 & ~umask)) << "as the umask says";
}

TEST(WholeFile, OfItsOwnTheProgramReadsNoLinkAndNothingEndless) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "empty", "");
  test::write_text(folder / "some", "text");
  EXPECT_TRUE(read_own_file(folder / "empty", 10)->empty());
  EXPECT_EQ(read_own_file(folder / "some", 4)->size(), 4U);
  EXPECT_EQ(read_own_file(folder / "some", 3).error().code, Errc::InvalidInput);
  EXPECT_EQ(read_own_file(folder / "none", 10).error().code, Errc::NotFound);
  std::filesystem::create_symlink("some", folder / "link");
  EXPECT_FALSE(read_own_file(folder / "link", 10));
  EXPECT_TRUE(read_whole_file(folder / "link", 10));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const auto& place : {folder / "pipe", folder.path(), std::filesystem::path("/dev/zero")})
    EXPECT_EQ(read_own_file(place, 10).error().code, Errc::InvalidInput) << place;
  EXPECT_EQ(read_whole_file(folder / "empty", 10).error().code, Errc::InvalidInput);
}

}  // namespace
}  // namespace relievo
