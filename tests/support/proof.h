// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A test that judges figures over many trials. The release build runs it. Sanitized it takes a minute or two
// and touches no line that its shorter neighbours do not touch as well: there it skips and says so.
#pragma once

#include <gtest/gtest.h>

namespace relievo::test {

#ifdef RELIEVO_SANITIZED
// So many of the trials.
constexpr unsigned trials(unsigned all) { return all < 10 ? 1 : all / 10; }
#define RELIEVO_MANY_TRIALS() GTEST_SKIP() << "many trials: the release build runs them"
#else
constexpr unsigned trials(unsigned all) { return all; }
#define RELIEVO_MANY_TRIALS() static_cast<void>(0)
#endif

}  // namespace relievo::test
