// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A process that is killed in the middle of a pulse: its last will is done nonetheless.
#include "hal/linux/wire/gpio_trigger_line.h"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <string>
#include <utility>

#include <sys/wait.h>
#include <unistd.h>

namespace relievo::hal {
namespace {

// What the will writes here, the test reads.
struct Wire {
  std::array<int, 2> ends{};
  Wire() { EXPECT_EQ(::pipe(ends.data()), 0); }
  ~Wire() {
    ::close(ends[0]);
    if (ends[1] >= 0) ::close(ends[1]);
  }
  void write(char c) const { EXPECT_EQ(::write(ends[1], &c, 1), 1); }
  // Everything until nobody can write any more.
  std::string all() {
    ::close(std::exchange(ends[1], -1));
    std::string text;
    for (char c = 0; ::read(ends[0], &c, 1) == 1;) text += c;
    return text;
  }
};

TEST(LastWill, IsDoneAtTheObjectsEnd) {
  Wire wire;
  {
    auto will = LastWill::make([&] { wire.write('w'); });
    ASSERT_TRUE(will);
    const LastWill moved = *std::move(will);
    wire.write('a');
  }
  EXPECT_EQ(wire.all(), "aw") << "once, and after everything else";
}

TEST(LastWill, IsDoneWhenTheProcessIsKilled) {
  for (const int signal : {SIGKILL, SIGTERM, SIGABRT}) {
    Wire wire;
    const pid_t victim = ::fork();
    ASSERT_GE(victim, 0);
    if (victim == 0) {
      std::signal(SIGABRT, SIG_DFL);
      const auto will = LastWill::make([&] { wire.write('0'); });
      wire.write(will ? '1' : '?');  // the line is active
      ::kill(::getpid(), signal);
      ::pause();
    }
    EXPECT_EQ(::waitpid(victim, nullptr, 0), victim);
    EXPECT_EQ(wire.all(), "10") << signal;
  }
}

// From the keyboard a signal goes to all of a terminal's processes: the child must outlive its parent.
TEST(LastWill, TheKeyboardDoesNotStopItFirst) {
  Wire wire;
  const pid_t victim = ::fork();
  ASSERT_GE(victim, 0);
  if (victim == 0) {
    ::setpgid(0, 0);
    std::signal(SIGINT, SIG_IGN);
    const auto will = LastWill::make([&] { wire.write('0'); });
    ::usleep(100'000);
    wire.write('1');
    ::kill(0, SIGINT);
    ::usleep(100'000);
    wire.write('1');
    ::kill(::getpid(), SIGKILL);
  }
  EXPECT_EQ(::waitpid(victim, nullptr, 0), victim);
  EXPECT_EQ(wire.all(), "110");
}

}  // namespace
}  // namespace relievo::hal
