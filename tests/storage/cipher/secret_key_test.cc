// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/cipher/seal.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace relievo::storage {
namespace {

// The next of its size may be the same room.
TEST(LockedBytes, BeginAsZerosAlsoWhereAKeyLayBefore) {
  for (int time = 0; time < 3; ++time) {
    auto key = SecretKey::make();
    ASSERT_TRUE(key.has_value());
    EXPECT_TRUE(std::ranges::all_of(key->bytes(), [](std::byte b) { return b == std::byte{0}; }));
    key->draw();
  }
}

#ifndef RELIEVO_SANITIZED  // a sanitizer's mlock() does nothing and says that it did
TEST(LockedBytes, AreRefusedEachTimeWhereNothingCanBeLocked) {
  const auto without = [] {
    const rlimit none{0, 0};
    // Root may lock what it likes.
    if (::setrlimit(RLIMIT_MEMLOCK, &none) != 0 || (::geteuid() == 0 && ::setuid(65534) != 0)) ::_exit(2);
    int refused = 0;
    for (int time = 0; time < 2; ++time) refused += LockedBytes::make(48).has_value() ? 0 : 1;
    ::_exit(refused == 2 ? 0 : 1);
  };
  EXPECT_EXIT(without(), testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace relievo::storage
