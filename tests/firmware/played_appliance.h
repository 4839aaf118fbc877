// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An appliance with cameras, stages and a store that do as the test says.
#pragma once

#include <gtest/gtest.h>
#include <optional>

#include <deque>
#include <string>
#include <thread>

#include "firmware/appliance/appliance.h"
#include "firmware/base/budget.h"
#include "tests/firmware/test_records.h"
#include "tests/support/played_device.h"

namespace relievo::firmware {

using std::chrono::milliseconds;

// Errors are given out one a stage; Cancelled means: run until cancelled.
class TestStages final : public StageRunner {
 public:
  std::deque<std::pair<State, Errc>> errors;
  std::atomic<bool> waiting{false};
  std::optional<pipeline::DriftJudgement> drift;
  std::string ran;
  Result<void> run(State stage, Products& products, pipeline::StageContext& context,
                   StageRecord& record) override {
    ran += name_of(stage).substr(0, 2);
    if (stage == State::Match) products.drift = drift;
    if (!errors.empty() && errors.front().first == stage) {
      const Errc code = errors.front().second;
      errors.pop_front();
      waiting.store(code == Errc::Cancelled);
      while (code == Errc::Cancelled && !context.stop()) std::this_thread::sleep_for(milliseconds(1));
      return Error{code, "as the test says"};
    }
    record.out = 1;
    if (stage == State::Assemble) products.model.emplace(&context.output);
    return {};
  }
  std::deque<Errc> pose_errors;  // of the front and the sides, in their order
  std::atomic<int> measured{0};
  std::optional<Errc> fuse_error;
  Result<void> add_pose(const pipeline::StereoFrame&, const pipeline::FaceModel&,
                        std::vector<pipeline::HeadPose>& poses, pipeline::StageContext&,
                        Arena& kept) override {
    ++measured;
    if (!pose_errors.empty()) {
      const Errc code = pose_errors.front();
      pose_errors.pop_front();
      if (code != Errc::Cancelled) return Error{code, "as the test says"};
    }
    poses.emplace_back(&kept);
    return {};
  }
  Result<pipeline::FusedHead> fuse(const pipeline::FaceModel&, std::span<pipeline::HeadPose> poses,
                                   pipeline::StageContext& context) override {
    if (fuse_error) return Error{*fuse_error, "as the test says"};
    pipeline::FusedHead head{pipeline::FaceModel(&context.output), pipeline::Registration(&context.output)};
    head.model.quality.width_mm = static_cast<double>(poses.size());
    return head;
  }
};

class ApplianceTest : public testing::Test {
 protected:
  ApplianceTest() {
    appliance.expect(named("Ada"));
    appliance.on_change([this](const Transition& change) { path += std::string(name_of(change.to)) + " "; });
  }
  // Turns the main loop until the state is reached; a minute is "never".
  bool reach(State state) {
    for (int turn = 0; turn < 60'000 && appliance.state() != state; ++turn) appliance.step(milliseconds(1));
    return appliance.state() == state;
  }
  bool memory_is_wiped() const {
    for (const std::byte b : memory.all()) {
      if (b != std::byte{0}) return false;
    }
    return true;
  }
  static BootMemory zeroed() {
    BootMemory made(2 * 7 * 16, 1 << 16, 1 << 16);
    std::fill(made.frames().begin(), made.frames().end(), std::byte{0});
    std::fill(made.output().begin(), made.output().end(), std::byte{0});
    std::fill(made.scratch().begin(), made.scratch().end(), std::byte{0});
    return made;
  }

  test::PlayedWorld world;
  test::PlayedDevice device{world, 4, 4};
  TestStages stages;
  BootMemory memory = zeroed();
  ThreadPool pool{1};
  std::deque<Errc> keep_errors;
  std::string kept;
  std::string path;
  TestRecords records{kept, keep_errors};
  Appliance appliance{{device, stages, memory, pool, records}};
};

}  // namespace relievo::firmware
