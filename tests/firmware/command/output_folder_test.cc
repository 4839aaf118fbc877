// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/output_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

using test::listing;
using test::write_text;

TEST(OutputFolder, AppearsWholeAtCommit) {
  const test::TemporaryFolder here;
  {
    auto folder = OutputFolder::begin(here / "out");
    ASSERT_TRUE(folder);
    write_text(folder->path() / "a.txt", "a");
    EXPECT_FALSE(std::filesystem::exists(here / "out"));
    ASSERT_TRUE(folder->commit());
  }
  EXPECT_EQ(listing(here.path()), "out\nout/a.txt\n");
}

TEST(OutputFolder, LeavesNothingWithoutCommit) {
  const test::TemporaryFolder here;
  {
    auto folder = OutputFolder::begin(here / "deep/er/out/");
    ASSERT_TRUE(folder);
    write_text(folder->path() / "a.txt", "a");
  }
  EXPECT_EQ(listing(here.path()), "");
}

TEST(OutputFolder, ReplacesFilesOfItsOwnNamesAndTouchesNoOther) {
  const test::TemporaryFolder here;
  std::filesystem::create_directory(here / "out");
  write_text(here / "out/a.txt", "old");
  write_text(here / "out/mine.txt", "mine");
  auto folder = OutputFolder::begin(here / "out");
  ASSERT_TRUE(folder);
  write_text(folder->path() / "a.txt", "new");
  EXPECT_EQ(test::read_text(here / "out/a.txt"), "old");
  ASSERT_TRUE(folder->commit());
  EXPECT_EQ(test::read_text(here / "out/a.txt"), "new");
  EXPECT_EQ(test::read_text(here / "out/mine.txt"), "mine");
}

TEST(OutputFolder, WhatARunThatWasKilledLeftComesIntoNoResult) {
  const test::TemporaryFolder here;
  const auto left = here / (".out.part" + std::to_string(getpid()));
  std::filesystem::create_directory(left);
  write_text(left / "b.txt", "old");
  auto folder = OutputFolder::begin(here / "out");
  ASSERT_TRUE(folder);
  ASSERT_EQ(folder->path(), left) << "the name that another run may have had";
  write_text(folder->path() / "a.txt", "a");
  ASSERT_TRUE(folder->commit());
  EXPECT_EQ(listing(here.path()), "out\nout/a.txt\n");
}

TEST(OutputFolder, WhatOtherRunsLeftGoesUnlessTheyStillRun) {
  const test::TemporaryFolder here;
  const pid_t gone = ::fork();
  if (gone == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(gone, nullptr, 0), gone);
  const auto of = [](const std::string& process) { return ".out.part" + process; };
  const std::string running = of(std::to_string(::getppid()));
  for (const std::string& name :
       {of(std::to_string(gone)), running, of(""), of("1x"), std::string(".out2.part9")}) {
    std::filesystem::create_directory(here / name);
    write_text(here / name / "face.ply", "x");
  }
  ASSERT_TRUE(OutputFolder::begin(here / "out"));
  EXPECT_FALSE(std::filesystem::exists(here / of(std::to_string(gone))));
  for (const std::string& name : {running, of(""), of("1x"), std::string(".out2.part9")})
    EXPECT_TRUE(std::filesystem::exists(here / name / "face.ply")) << name;
}

TEST(OutputFolder, NothingIsWrittenAmongAStoresFiles) {
  for (const char* name : {"relievo.lock", "relievo.key"}) {
    const test::TemporaryFolder here;
    std::filesystem::create_directory(here / "store");
    write_text(here / "store" / name, "x");
    EXPECT_EQ(OutputFolder::begin(here / "store").error().code, Errc::InvalidInput);
    EXPECT_TRUE(OutputFolder::begin(here / "store/consent"));
    EXPECT_EQ(listing(here.path()), "store\nstore/" + std::string(name) + "\n");
  }
}

TEST(OutputFolder, RefusesAFileAndAPlaceThatCannotBe) {
  const test::TemporaryFolder here;
  write_text(here / "file", "x");
  EXPECT_EQ(OutputFolder::begin(here / "file").error().code, Errc::InvalidInput);
  EXPECT_FALSE(OutputFolder::begin(here / "file/below"));
  EXPECT_FALSE(OutputFolder::begin("/proc/nowhere/out"));
  EXPECT_EQ(OutputFolder::begin("").error().code, Errc::IoFailed);
  EXPECT_EQ(listing(here.path()), "file\n");
}

TEST(OutputFolder, WhatCannotBeListedIsNotSaidToBeThere) {
  const test::TemporaryFolder here;
  std::filesystem::create_directory(here / "out");
  auto folder = OutputFolder::begin(here / "out");
  ASSERT_TRUE(folder);
  write_text(folder->path() / "a.txt", "a");
  std::filesystem::remove_all(folder->path());  // somebody tidies up
  EXPECT_EQ(folder->commit().error().code, Errc::IoFailed);
}

}  // namespace
}  // namespace relievo::firmware
