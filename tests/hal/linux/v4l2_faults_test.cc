// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every system call of a camera fails in every way; and the names of the formats.
#include <gtest/gtest.h>

#include <cerrno>
#include <map>
#include <set>

#include <linux/videodev2.h>
#include <poll.h>

#include "tests/hal/linux/v4l2_fixture.h"

namespace relievo::hal {
namespace {

using std::chrono::milliseconds;

using V4l2FaultsTest = V4l2Fixture;

TEST_F(V4l2FaultsTest, WhatIsAnnouncedAndDoesNotComeEndsAtTheDeadline) {
  run();
  for (const short told : {short(POLLERR), short(POLLIN)}) {
    kernel.announced = told;
    EXPECT_EQ(error_of_next(), Errc::Timeout) << told;
    kernel.announced = 0;
    kernel.expose({});
    EXPECT_TRUE(next()) << "it goes on";
  }
}

// Every call of opening, starting and taking, failing the first, second … time with every number a driver
// may give: an error in words or a picture, never a crash, a device left open or a buffer queued twice;
// and afterwards a healthy camera works.
TEST(V4l2CameraFaults, EveryCallMayFailWithEveryNumber) {
  const int numbers[] = {EINVAL, EIO,     ENODEV,    ENXIO,   ENOMEM,    EBUSY,  EACCES, EPERM,
                         ENOTTY, ENOLINK, ENOLCK,    ERANGE,  ENOSPC,    EPIPE,  EPROTO, ETIMEDOUT,
                         EFAULT, EAGAIN,  ESHUTDOWN, ENODATA, EOVERFLOW, ENOENT, EINTR};
  std::set<KernelCall> seen;
  for (int c = 0; c < static_cast<int>(KernelCall::Count); ++c)
    for (const int number : numbers)
      for (int after = 0; after < 4; ++after) {
        const auto which = static_cast<KernelCall>(c);
        FakeKernel kernel;
        kernel.has_timings = number % 2 == 0;
        {
          V4l2Camera camera({"x", {}, 0, true}, kernel, kernel.clock);
          kernel.fail(which, number, after);
          Result<void> done = camera.open(kMode);
          if (done) done = camera.start();
          if (done) {  // nothing has been exposed yet: it has to wait
            const auto none = camera.next_frame(kernel.clock.now() + milliseconds(50));
            ASSERT_FALSE(none);
            if (none.error().code != Errc::Timeout) done = none.error();
          }
          for (int i = 0; i < 4 && done; ++i) {
            kernel.expose({});
            const auto frame = camera.next_frame(kernel.clock.now() + milliseconds(50));
            if (!frame) done = frame.error();
          }
          if (!done) {
            seen.insert(which);
            EXPECT_FALSE(done.error().what.view().empty());
            if (number == ENODEV && which != KernelCall::Open && which != KernelCall::Map) {
              EXPECT_EQ(done.error().code, Errc::Disconnected) << c << ' ' << after;
            }
          }
          camera.close();
          kernel.fail(which, 0, 1'000'000);
          ASSERT_TRUE(camera.open(kMode) && camera.start()) << c << ' ' << number;
          kernel.expose({});
          ASSERT_TRUE(camera.next_frame(kernel.clock.now() + milliseconds(50)));
        }
        ASSERT_EQ(kernel.open_files + kernel.mapped, 0) << c << ' ' << number << ' ' << after;
        ASSERT_TRUE(kernel.complaints.empty()) << kernel.complaints.front() << ' ' << c << ' ' << number;
      }
  // All but the call that ends the stream, which nobody can help.
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(KernelCall::Count) - 1);
}

TEST(V4l2Formats, EveryNameIsThereOnce) {
  std::map<std::uint32_t, RawFormat> formats;
  for (const V4l2Format& format : v4l2_formats())
    EXPECT_TRUE(formats.emplace(format.fourcc, format.raw).second);
  EXPECT_EQ(formats.size(), 31U);
  EXPECT_FALSE(formats.contains(V4L2_PIX_FMT_H264));
  EXPECT_EQ(formats.at(V4L2_PIX_FMT_SBGGR10P), (RawFormat{RawCoding::Packed10, ColourFilter::Bggr}));
}

}  // namespace
}  // namespace relievo::hal
