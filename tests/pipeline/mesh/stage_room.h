// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StageRoom: a fixture in which a stage is run as the pipeline runs it.
#pragma once

#include <utility>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline::test {

struct StageRoom : relievo::test::StageFixture {
  explicit StageRoom(std::size_t output_bytes = std::size_t{64} << 20,
                     std::size_t scratch_bytes = std::size_t{192} << 20)
      : StageFixture(output_bytes, scratch_bytes) {}

  template <typename Work>
  auto run(Work&& work) {
    return run_stage(context, std::forward<Work>(work));
  }
};

}  // namespace relievo::pipeline::test
