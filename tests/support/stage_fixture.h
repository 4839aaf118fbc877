// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StageFixture: everything a stage asks for, for tests: arenas of a chosen size, a pool, a switch.
#pragma once

#include "pipeline/base/workspace.h"

namespace relievo::test {

struct StageFixture : pipeline::Workspace {
  explicit StageFixture(std::size_t output_bytes = std::size_t{256} << 20,
                        std::size_t scratch_bytes = std::size_t{512} << 20, int threads = 2)
      : Workspace(threads, output_bytes, scratch_bytes) {}
};

}  // namespace relievo::test
