// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The target that RELIEVO_FUZZ_TARGET names, for libFuzzer. Without one it names them all.
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/fuzz_targets.h"
#include "tests/support/temporary_folder.h"

namespace {

relievo::test::FuzzTarget g_target;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* wanted = std::getenv("RELIEVO_FUZZ_TARGET");
  const char* seeds = std::getenv("RELIEVO_FUZZ_SEEDS");  // a folder that gets them
  for (auto& target : relievo::test::fuzz_targets()) {
    if (wanted == nullptr) std::cout << target.name << "\n";
    else if (target.name == wanted) g_target = std::move(target);
  }
  if (g_target.run == nullptr) std::exit(wanted == nullptr ? 0 : 2);
  for (std::size_t i = 0; seeds != nullptr && i < g_target.seeds.size(); ++i)
    relievo::test::write_text(std::filesystem::path(seeds) / ("seed-" + std::to_string(i)),
                              g_target.seeds[i]);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)g_target.run({data, size});
  return 0;
}
