// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A machine whose CUPS does not answer has no printer, and says what to do.
#include "hal/linux/device.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "tests/support/temporary_folder.h"

namespace relievo::hal {
namespace {

TEST(CupsPrinter, WithoutAServerThereIsNone) {
  const test::TemporaryFolder folder;
  setenv("CUPS_SERVER", (folder.path() / "no.sock").c_str(), 1);
  setenv("HOME", folder.path().c_str(), 1);  // nobody's own choice of a printer
  const auto printer = make_cups_printer();
  EXPECT_FALSE(printer->is_there());
  const std::array<std::byte, 4> slip{};
  const auto printed = printer->print(slip);
  ASSERT_FALSE(printed);
  EXPECT_EQ(printed.error().code, Errc::NotFound);
  unsetenv("CUPS_SERVER");
}

}  // namespace
}  // namespace relievo::hal
