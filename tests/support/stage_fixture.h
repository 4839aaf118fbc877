// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StageFixture: everything a stage asks for, for tests: arenas of a chosen size, a pool, a switch; and the
// heap.
#pragma once

#include <memory_resource>

#include "pipeline/base/workspace.h"

namespace relievo::test {

inline std::pmr::memory_resource* heap() { return std::pmr::new_delete_resource(); }

struct StageFixture : pipeline::Workspace {
  explicit StageFixture(std::size_t output_bytes = std::size_t{256} << 20,
                        std::size_t scratch_bytes = std::size_t{512} << 20, int threads = 2)
      : Workspace(threads, output_bytes, scratch_bytes) {}
};

}  // namespace relievo::test
