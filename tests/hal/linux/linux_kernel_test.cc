// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real kernel's calls, on files that every machine has: what they give and how they fail.
#include <errno.h>
#include <gtest/gtest.h>
#include <poll.h>

#include "hal/linux/kernel.h"
#include "tests/support/temporary_folder.h"

namespace relievo::hal {
namespace {

TEST(RealKernel, OpensMapsAndWaitsForAFile) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "frame").string();
  test::write_text(file, std::string(4096, 'x'));
  Kernel& kernel = real_kernel();
  const int opened = kernel.open(file.c_str());
  ASSERT_GE(opened, 0);
  EXPECT_EQ(kernel.poll(opened, 0) & POLLIN, POLLIN);
  auto* mapped = static_cast<char*>(kernel.map(opened, 4096, 0));
  ASSERT_NE(mapped, nullptr);
  EXPECT_EQ(mapped[4095], 'x');
  mapped[0] = 'y';
  kernel.unmap(mapped, 4096);
  EXPECT_EQ(test::read_text(file)[0], 'y') << "shared with whoever fills it";
  EXPECT_EQ(kernel.close(opened), 0);
}

TEST(RealKernel, SaysWhyACallFailed) {
  Kernel& kernel = real_kernel();
  EXPECT_EQ(kernel.open("/dev/no such camera"), -ENOENT);
  EXPECT_EQ(kernel.close(-1), -EBADF);
  EXPECT_EQ(kernel.map(-1, 4096, 0), nullptr);
  const int nothing = kernel.open("/dev/null");
  ASSERT_GE(nothing, 0);
  EXPECT_EQ(kernel.ioctl(nothing, 0x5401, nullptr), -ENOTTY) << "it is no such device";
  EXPECT_EQ(kernel.close(nothing), 0);
}

TEST(RealKernel, KnowsNoSerialNumberOfWhatIsNoCamera) {
  EXPECT_EQ(real_kernel().serial_of("/dev/no such camera"), "");
  EXPECT_EQ(real_kernel().serial_of("/dev/null"), "");
}

}  // namespace
}  // namespace relievo::hal
