// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The system's own calls for a stick, on a folder that is none.
#include <errno.h>
#include <gtest/gtest.h>

#include "hal/linux/mounted_stick.h"
#include "tests/support/temporary_folder.h"

namespace relievo::hal {
namespace {

TEST(RealMounts, AFolderThatIsNoStickIsToldAsItIs) {
  const test::TemporaryFolder folder;
  Mounts& mounts = real_mounts();
  EXPECT_FALSE(mounts.is_mounted(folder.path())) << "nothing is mounted there";
  EXPECT_EQ(mounts.flush(folder.path()), 0);
  EXPECT_EQ(mounts.flush(folder.path() / "gone"), -ENOENT);
  EXPECT_LT(mounts.unmount(folder.path()), 0);
  MountSource nothing;
  nothing.device = "/dev/no such stick";
  nothing.type = "vfat";
  EXPECT_LT(mounts.mount_read_only(nothing, folder.path() / "again"), 0);
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "again")) << "made anew, as udisks takes it away";
}

}  // namespace
}  // namespace relievo::hal
