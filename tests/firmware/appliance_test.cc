// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole enrolments with cameras, stages and a store that do as the test says.
#include "firmware/appliance.h"

#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <thread>

#include "firmware/budget.h"
#include "firmware/view/view_of.h"
#include "hal/monotonic_clock.h"

namespace relievo::firmware {
namespace {

using std::chrono::milliseconds;

class StillCamera final : public hal::Camera {
 public:
  // Exposes when it is pulsed, both cameras at the same moment.
  explicit StillCamera(const hal::Instant& pulsed_at) : pulsed_at_(pulsed_at) {}
  std::deque<Errc> errors;       // one a call, then pictures
  Result<void> on_start{};

 private:
  Result<void> do_open(const hal::CaptureMode&) override { return on_start; }
  Result<void> do_start() override { return on_start; }
  void do_stop() override {}
  Result<hal::Frame> do_next_frame(hal::Instant) override {
    if (!errors.empty()) {
      const Errc code = errors.front();
      errors.pop_front();
      return Error{code, "as the test says"};
    }
    return hal::Frame({pixels_, 16, 4, 4, 4, {}}, {pulsed_at_, ++sequence_}, [](void*, int) {}, this, 0);
  }
  const hal::Instant& pulsed_at_;
  std::byte pixels_[16] = {std::byte{0x5A}};
  std::uint32_t sequence_ = 0;
};

class TestLine final : public hal::TriggerLine {
 public:
  explicit TestLine(const hal::Clock& clock) : TriggerLine(clock), clock_(clock) {}
  hal::Instant pulsed_at;

 private:
  Result<void> do_pulse(std::chrono::microseconds, hal::Light) override {
    pulsed_at = clock_.now();
    return {};
  }
  const hal::Clock& clock_;
};

class TestBoard final : public hal::Board, hal::RemovableMedia, hal::Watchdog {
 public:
  hal::MonotonicClock time;
  TestLine line{time};
  StillCamera left_camera{line.pulsed_at};
  StillCamera right_camera{line.pulsed_at};
  int kicks = 0;
  std::string_view name() const override { return "test"; }
  hal::CaptureMode preferred_mode() const override { return {4, 4, std::chrono::microseconds(1)}; }
  hal::Camera& left() override { return left_camera; }
  hal::Camera& right() override { return right_camera; }
  hal::TriggerLine& trigger() override { return line; }
  bool is_live() const override { return false; }
  hal::RemovableMedia& media() override { return *this; }
  hal::Clock& clock() override { return time; }
  hal::Watchdog& watchdog() override { return *this; }

 private:
  std::optional<hal::Medium> current() override { return std::nullopt; }
  Result<void> flush_and_eject() override { return {}; }
  void kick() override { ++kicks; }
};

// Errors are given out one a stage; Cancelled means: run until cancelled.
class TestStages final : public StageRunner {
 public:
  std::deque<std::pair<State, Errc>> errors;
  std::atomic<bool> waiting{false};
  std::optional<pipeline::DriftJudgement> drift;
  std::string ran;
  Result<void> run(State stage, Products& products, pipeline::StageContext& context, StageRecord& record) override {
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
    if (stage == State::Texture) products.model.emplace(&context.output);
    return {};
  }
};

class ApplianceTest : public testing::Test {
 protected:
  ApplianceTest() {
    appliance.set_subject("Ada");
    appliance.on_change([this](const Change& change) { path += std::string(name_of(change.to)) + " "; });
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

  TestBoard board;
  TestStages stages;
  BootMemory memory = zeroed();
  ThreadPool pool{1};
  std::deque<Errc> keep_errors;
  std::string kept;
  std::string path;
  Appliance appliance{{board, stages, memory, pool, [this](std::string_view subject, const pipeline::FaceModel&) {
                         if (!keep_errors.empty()) {
                           const Errc code = keep_errors.front();
                           keep_errors.pop_front();
                           return Result<void>(Error{code, "as the test says"});
                         }
                         kept += subject;
                         return Result<void>();
                       }}};
};

TEST_F(ApplianceTest, OneEnrolmentFromBeginToStored) {
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_FALSE(appliance.session().is_open());
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  const ui::ViewState view = view_of(appliance);
  EXPECT_EQ(view.screen, ui::Screen::Review);
  EXPECT_EQ(view.subject, "Ada");
  EXPECT_NE(view.model, nullptr);
  EXPECT_EQ(kept, "") << "stored without consent";
  appliance.ask(ui::Intent::Accept);
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_EQ(kept, "Ada");
  EXPECT_EQ(path, "Idle Capture Match Reconstruct Mesh Texture Review Store Idle ");
  EXPECT_EQ(stages.ran, "MaReMeTe");
  EXPECT_EQ(appliance.records().size(), 4U);
  EXPECT_FALSE(appliance.problem());
  EXPECT_GT(board.kicks, 0);
  EXPECT_TRUE(memory_is_wiped());
  EXPECT_EQ(view_of(appliance).model, nullptr);
}

TEST_F(ApplianceTest, AfterAFailedStageThePersonTriesAgain) {
  stages.errors = {{State::Match, Errc::NoFace}, {State::Mesh, Errc::PoorGeometry}};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  EXPECT_EQ(path, "Idle Capture Match Capture Match Reconstruct Mesh Capture Match Reconstruct Mesh Texture Review ");
  EXPECT_EQ(appliance.attempt(), 3);
}

TEST_F(ApplianceTest, GivesUpAfterThreeAttemptsAndForgets) {
  stages.errors = {{State::Match, Errc::NoFace}, {State::Match, Errc::NoFace}, {State::Match, Errc::NoFace}};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Capture));
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_EQ(appliance.problem()->code, Errc::NoFace);
  EXPECT_EQ(view_of(appliance).advice, pipeline::Advice::NoFace);
  EXPECT_TRUE(memory_is_wiped());
  EXPECT_EQ(kept, "");
}

TEST_F(ApplianceTest, CancelStopsTheStageUnderWayAndForgets) {
  for (const State stage : {State::Match, State::Reconstruct, State::Mesh, State::Texture}) {
    stages.errors = {{stage, Errc::Cancelled}};
    stages.waiting.store(false);
    ASSERT_TRUE(reach(State::Idle));
    appliance.ask(ui::Intent::Begin);
    while (!stages.waiting.load()) appliance.step(milliseconds(1));
    appliance.ask(ui::Intent::Cancel);
    EXPECT_EQ(appliance.state(), State::Idle) << name_of(stage);
    EXPECT_FALSE(appliance.session().is_open());
    EXPECT_TRUE(memory_is_wiped());
  }
  appliance.ask(ui::Intent::Begin);  // and the next person is served
  EXPECT_TRUE(reach(State::Review));
}

TEST_F(ApplianceTest, CancelAtReviewStoresNothing) {
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Cancel);
  EXPECT_EQ(appliance.state(), State::Idle);
  EXPECT_EQ(kept, "");
  EXPECT_TRUE(memory_is_wiped());
}

TEST_F(ApplianceTest, RetakeMakesANewModel) {
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Retake);
  EXPECT_EQ(appliance.attempt(), 1);
  ASSERT_TRUE(reach(State::Review));
  EXPECT_EQ(stages.ran, "MaReMeTeMaReMeTe");
}

TEST_F(ApplianceTest, AFullDiskLeavesTheModelToBeAcceptedAgain) {
  keep_errors = {Errc::MediaFull};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Accept);
  ASSERT_TRUE(reach(State::Review));
  EXPECT_EQ(appliance.problem()->code, Errc::MediaFull);
  EXPECT_NE(view_of(appliance).model, nullptr);
  appliance.ask(ui::Intent::Accept);
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_EQ(kept, "Ada");
}

TEST_F(ApplianceTest, AStoreThatIsBrokenIsAFault) {
  keep_errors = {Errc::StoreCorrupt};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Accept);
  ASSERT_TRUE(reach(State::Fault));
  EXPECT_TRUE(memory_is_wiped());
}

TEST_F(ApplianceTest, APulledCameraIsAFaultAndForgets) {
  ASSERT_TRUE(reach(State::Idle));
  board.right_camera.errors = {Errc::Disconnected};
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Fault));
  EXPECT_EQ(appliance.problem()->code, Errc::Disconnected);
  EXPECT_TRUE(memory_is_wiped());
}

TEST_F(ApplianceTest, ACameraThatMovedIsTheTechniciansBusiness) {
  using pipeline::DriftVerdict;
  const auto enrol = [this] {
    EXPECT_TRUE(reach(State::Idle));
    appliance.ask(ui::Intent::Begin);
    EXPECT_TRUE(reach(State::Review));
    appliance.ask(ui::Intent::Cancel);
  };
  const auto note = [this] { return std::string(view_of(appliance).calibration_note); };
  enrol();
  EXPECT_FALSE(appliance.drift()) << "nothing was judged";
  EXPECT_EQ(note(), "");
  stages.drift = {.verdict = DriftVerdict::Warn, .residual_px = 0.31, .expected_px = 0.02};
  enrol();
  EXPECT_EQ(appliance.drift()->verdict, DriftVerdict::Warn);
  EXPECT_NE(note().find("0.31 px"), std::string::npos) << note();
  EXPECT_EQ(view_of(appliance).problem, "") << "the person is not bothered";
  stages.drift->verdict = DriftVerdict::Unknown;  // the next face cannot tell
  enrol();
  EXPECT_NE(note(), "");
  stages.drift->verdict = DriftVerdict::Ok;
  enrol();
  EXPECT_EQ(note(), "");
}

TEST_F(ApplianceTest, ACameraThatMovedTooFarIsAFault) {
  stages.drift = {.verdict = pipeline::DriftVerdict::Refuse, .residual_px = 2.5, .expected_px = 0.02};
  stages.errors = {{State::Match, Errc::NotCalibrated}};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Fault));
  EXPECT_EQ(appliance.problem()->code, Errc::NotCalibrated);
  EXPECT_NE(std::string(view_of(appliance).calibration_note).find("calibrate again"), std::string::npos);
  EXPECT_TRUE(memory_is_wiped());
  EXPECT_EQ(kept, "");
}

TEST_F(ApplianceTest, ATechnicianComesAndGoes) {
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::OpenTechnician);
  appliance.ask(ui::Intent::Begin);  // not heard here
  EXPECT_EQ(appliance.state(), State::Technician);
  appliance.ask(ui::Intent::Calibrate);
  EXPECT_EQ(appliance.state(), State::Calibrate);
  appliance.end_service_state(true);
  EXPECT_EQ(appliance.state(), State::Technician);
  appliance.ask(ui::Intent::LeaveTechnician);
  EXPECT_EQ(appliance.state(), State::Idle);
}

TEST_F(ApplianceTest, ANameThatIsTooLongIsToldAndNothingBegins) {
  ASSERT_TRUE(reach(State::Idle));
  appliance.set_subject(std::string(500, 'x'));
  appliance.ask(ui::Intent::Begin);
  EXPECT_EQ(appliance.state(), State::Idle);
  EXPECT_EQ(appliance.problem()->code, Errc::InvalidInput);
}

TEST(ApplianceSelfTest, ACameraThatDoesNotOpenIsAFault) {
  TestBoard board;
  board.left_camera.on_start = Error{Errc::IoFailed, "as the test says"};
  TestStages stages;
  const BootMemory memory(2 * 7 * 16, 1 << 16, 1 << 16);
  ThreadPool pool(1);
  Appliance appliance({board, stages, memory, pool, [](std::string_view, const pipeline::FaceModel&) { return Result<void>(); }});
  while (appliance.state() == State::SelfTest) appliance.step(milliseconds(1));
  EXPECT_EQ(appliance.state(), State::Fault);
  EXPECT_EQ(appliance.problem()->code, Errc::IoFailed);
}

}  // namespace
}  // namespace relievo::firmware
