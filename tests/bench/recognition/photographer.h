// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Photographs visits at half the rig's size: left.png, right.png, rig.yml and the true surface head.ply
// (left camera's frame, mm) in FOLDER/VISIT. What is there already stays, so that a run can be resumed; a
// folder appears only when it is complete.
// The other maker is a program: synth OUT SEED head HEADS --size W H --spp N --yaw D --pitch D --noise S
//   --dist MM --gain G --rig SEED --same-head SEED, which must leave the same four files in OUT.
// Errors: IoFailed; LibraryFailed (the program failed: its own words). Thread: one caller; uses the pool.
#pragma once

#include <filesystem>
#include <memory>

#include "hal/base/result.h"
#include "hal/base/thread_pool.h"
#include "hal/sim/head/head_scene.h"
#include "tests/bench/recognition/population.h"

namespace relievo::bench {

struct OtherMaker {
  std::filesystem::path program, heads;  // both absolute
};

class Photographer {
 public:
  Photographer(std::filesystem::path folder, OtherMaker other, ThreadPool& pool)
      : folder_(std::move(folder)), other_(std::move(other)), pool_(pool) {}

  // All visits of one person. True where something had to be photographed.
  Result<bool> photograph(const Person& person);
  std::filesystem::path folder_of(const Visit& visit) const { return folder_ / visit.name; }

 private:
  Result<void> photograph_own(const Visit& visit, const std::filesystem::path& folder);
  Result<void> photograph_other(const Visit& visit, const std::filesystem::path& folder);

  std::filesystem::path folder_;
  OtherMaker other_;
  ThreadPool& pool_;
  Visit shown_;                                      // whose head is at hand
  std::shared_ptr<const hal::sim::HeadModel> head_;  // making one takes longer than photographing it
};

}  // namespace relievo::bench
