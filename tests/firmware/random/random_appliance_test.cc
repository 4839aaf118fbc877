// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The appliance under random intents, times and faults: its machine, its session, its three threads and all
// that is asked of them, before cameras, stages and records that do as chance says. After every event: the
// change is a row of the table, no state lasts longer than its limit, a session that is closed has left
// nothing. Left alone and mended it comes back to Idle.
#include <string.h>

#include <map>

#include "firmware/capture/live_judge.h"
#include "hal/sim/optics/rig.h"
#include "tests/firmware/machine/event_names.h"
#include "tests/firmware/played_appliance.h"
#include "tests/firmware/random/random_events.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"

namespace relievo::firmware {
namespace {

constexpr double kTiny = 1.0 / 30;  // of the rig's pictures: 64 x 40

// What chance lets the three threads meet; nothing: all goes well.
struct Luck {
  std::atomic<std::optional<Errc>> stage, keep, look_up, pose;
  std::atomic<bool> works_on{false};  // a stage, until it is told to stop
  std::atomic<bool> fuses{true};
  std::atomic<pipeline::DriftVerdict> drift{pipeline::DriftVerdict::Ok};
  std::atomic<int> kept{0};
  void mend() {
    stage = keep = look_up = pose = std::nullopt;
    works_on = false;
    fuses = true;
    drift = pipeline::DriftVerdict::Ok;
  }
};

class LuckyStages final : public StageRunner {
 public:
  explicit LuckyStages(Luck& luck) : luck_(luck) {}
  Result<void> run(State stage, Products& products, pipeline::StageContext& context,
                   StageRecord& record) override {
    record.out = 1;
    std::fill_n(static_cast<unsigned char*>(context.output.allocate(64)), 64, 0x77);
    std::fill_n(static_cast<unsigned char*>(context.scratch.allocate(64)), 64, 0x77);
    while (luck_.works_on.load()) {
      if (context.stop()) return Error{Errc::Cancelled, "as chance says"};
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    if (stage == State::Match)
      products.drift = pipeline::DriftJudgement{.verdict = luck_.drift.load(), .residual_px = 0.5};
    if (const auto error = luck_.stage.exchange(std::nullopt)) return Error{*error, "as chance says"};
    if (stage == State::Assemble) products.model.emplace(&context.output);
    return {};
  }
  Result<void> add_pose(const pipeline::StereoFrame&, const pipeline::FaceModel&,
                        std::vector<pipeline::HeadPose>& poses, pipeline::StageContext&,
                        Arena& kept) override {
    if (const auto error = luck_.pose.exchange(std::nullopt)) return Error{*error, "as chance says"};
    poses.emplace_back(&kept);
    return {};
  }
  Result<pipeline::FusedHead> fuse(const pipeline::FaceModel&, std::span<pipeline::HeadPose>,
                                   pipeline::StageContext& context) override {
    if (!luck_.fuses.load()) return Error{Errc::PoorGeometry, "as chance says"};
    return pipeline::FusedHead{pipeline::FaceModel(&context.output), pipeline::Registration(&context.output)};
  }

 private:
  Luck& luck_;
};

class LuckyRecords final : public VisitRecords {
 public:
  explicit LuckyRecords(Luck& luck) : luck_(luck) {}
  Result<KeptVisit> keep(const VisitRecord&, const pipeline::FaceModel&) override {
    if (const auto error = luck_.keep.exchange(std::nullopt)) return Error{*error, "as chance says"};
    ++luck_.kept;
    KeptVisit visit;
    visit.receipt = std::string_view("receipt");
    return visit;
  }
  Result<RecordAnswer> look_up(const RecordQuestion&) override {
    if (const auto error = luck_.look_up.exchange(std::nullopt)) return Error{*error, "as chance says"};
    return RecordAnswer{ui::Known::Nobody};
  }

 private:
  Luck& luck_;
};

// Of the staff's pages.
class SideJob final : public Job {
 public:
  std::atomic<bool> waits{false};
  std::atomic<std::optional<Errc>> error{};
  Result<void> run(JobControl& control) override {
    while (waits.load() && !control.cancelled.load())
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    if (const auto e = error.load()) return Error{*e, "as chance says"};
    return {};
  }
};

class RandomAppliance : public testing::Test {
 protected:
  RandomAppliance() {
    std::fill(memory.frames().data(), memory.follow().data() + memory.follow().size(), std::byte{0});
    judge.use(test::true_calibration(hal::sim::make_rig(rig)));
    appliance.on_change([this](const Transition& change) { changed(change); });
  }
  hal::Instant now() { return device.time.now(); }
  // A state in which there is nothing to do is left before anybody is told of it.
  static bool left_at_once(State before, State state) {
    const bool may = state == State::Position || state == State::Capture || state == State::Fuse;
    return may && std::any_of(kTransitions.begin(), kTransitions.end(),
                              [&](const Transition& row) { return row.from == before && row.to == state; });
  }
  void changed(const Transition& change) {
    EXPECT_TRUE(change.from == in || left_at_once(in, change.from))
        << "told of " << name_of(change.from) << " " << name_of(change.event) << " in " << name_of(in);
    EXPECT_EQ(next(change.from, change.event), change.to)
        << name_of(change.from) << " " << name_of(change.event) << " " << name_of(change.to);
    ++walked[{change.from, change.event}];
    in = change.to;
    since = now();
    if (change.from != State::Store) return;
    const int kept = luck.kept.load() - stored;
    EXPECT_EQ(kept, change.event == Event::StageDone ? 1 : 0) << "told so: " << name_of(change.event);
    stored = luck.kept.load();
  }
  void is_well() {
    EXPECT_EQ(appliance.state(), in) << "a change nobody was told of";
    const auto limit = limit_of(in);
    EXPECT_TRUE(!limit || now() - since <= *limit + milliseconds(200))
        << "longer than its limit in " << name_of(in);
    const bool in_a_visit = in != State::SelfTest && in != State::Idle && in != State::Fault &&
                            in != State::Staff && in != State::Calibrate && in != State::Export;
    EXPECT_EQ(appliance.session().is_open(), in_a_visit) << name_of(in);
    EXPECT_GE(appliance.progress(), 0);
    EXPECT_LE(appliance.progress(), 1);
    EXPECT_TRUE(in == State::Store || stored == luck.kept.load()) << "kept what nobody accepted";
  }
  void nothing_is_left() {
    if (appliance.session().is_open()) return;
    appliance.end_side_job(JobLane::Capture);
    const auto all = memory.all();
    EXPECT_TRUE(all[0] == std::byte{0} && memcmp(all.data(), all.data() + 1, all.size() - 1) == 0)
        << "left by a visit";
  }

  ui::Intent intent() {
    static constexpr std::array kIntents{ui::Intent::LookUp,    ui::Intent::Pose,      ui::Intent::Begin,
                                         ui::Intent::Begin,     ui::Intent::Enough,    ui::Intent::Accept,
                                         ui::Intent::Accept,    ui::Intent::Retake,    ui::Intent::Cancel,
                                         ui::Intent::StillHere, ui::Intent::OpenStaff, ui::Intent::LeaveStaff,
                                         ui::Intent::Begin,     ui::Intent::Calibrate, ui::Intent::Calibrate,
                                         ui::Intent::Export,    ui::Intent::Export,    ui::Intent::StillHere};
    return events.any(kIntents);
  }
  Errc error() {
    static constexpr std::array kErrors{
        Errc::Disconnected,  Errc::NotCalibrated, Errc::InvalidState,  Errc::StoreCorrupt,
        Errc::InvalidInput,  Errc::NotFound,      Errc::Timeout,       Errc::NoFace,
        Errc::TooFewMatches, Errc::PoorGeometry,  Errc::LibraryFailed, Errc::OutOfMemory,
        Errc::MediaFull,     Errc::IoFailed,      Errc::Cancelled,     Errc::Unsupported};
    return events.any(kErrors);
  }
  void ask() {
    const ui::Intent wanted = intent();
    events.note("intent " + std::to_string(static_cast<int>(wanted)));
    // Who looks at a live picture waits for the camera's next one: dear, and so is seldom.
    if (wanted == ui::Intent::Pose && !events.one_in(40) && in == State::Idle) return;
    if (wanted == ui::Intent::StillHere &&
        (in == State::Position || in == State::Review || in == State::Staff || in == State::Export))
      since = now();
    appliance.ask(wanted);
  }
  void let_in() {
    switch (events.of(12)) {
      case 0:
        world.pulled = events.one_in(20);  // waited for, so seldom
        break;
      case 1: device.right_camera.held = events.one_in(20); break;
      case 2:
      case 3: luck.stage = error(); break;
      case 4: luck.works_on = events.one_in(4); break;
      case 5: luck.keep = error(); break;
      case 6: luck.look_up = error(); break;
      case 7:
        luck.pose = error();
        luck.fuses = events.one_in(2);
        break;
      case 8:
        luck.drift = events.any(std::array{pipeline::DriftVerdict::Ok, pipeline::DriftVerdict::Warn,
                                           pipeline::DriftVerdict::Refuse, pipeline::DriftVerdict::Unknown});
        break;
      case 9: world.wall_shift_s = events.of(200) * 86'400 - 100 * 86'400; break;
      default: mend();
    }
    events.note("a fault, or mended");
  }
  void work_beside() {
    const auto lane = static_cast<JobLane>(events.of(static_cast<int>(kJobLanes)));
    SideJob& job = side[static_cast<std::size_t>(lane)];
    switch (events.of(3)) {
      case 0:
        appliance.end_side_job(lane);
        job.waits = events.one_in(2);
        job.error = events.one_in(4) ? std::optional(error()) : std::nullopt;
        (void)appliance.start_side_job(lane, job);
        break;
      case 1: appliance.cancel_side_job(lane); break;
      default: appliance.end_side_job(lane);
    }
  }
  // A moment for the threads; now and then a long one, so that slow sanitizers' walks come as far as others.
  void let_work() {
    const bool works =
        in == State::SelfTest || (in >= State::Capture && in <= State::Fuse) || in == State::Store;
    if (events.one_in(4) && works) return appliance.step(milliseconds(2));
    std::this_thread::yield();
  }
  void event() {
    const int kind = events.of(100);
    if (kind < 45) return ask();
    if (kind < 49) return let_in();
    if (kind < 72) {  // and else only time goes by for the threads
      if (kind >= 56) return let_work();
      const int jump_s = events.one_in(10) ? events.of(700) : events.of(4);
      events.note("time " + std::to_string(jump_s));
      world.ahead_s += jump_s;
    } else if (kind < 78) {
      work_beside();
    } else if (kind < 80) {
      appliance.expect(named(std::string(static_cast<std::size_t>(events.of(140)), 'x')));
    } else if (kind < 82) {
      appliance.ask_records({WipedText("Ada"), WipedText(events.one_in(2) ? "4821" : ""), events.one_in(2)});
    } else if (kind < 84) {
      events.one_in(2) ? appliance.forget_answer() : appliance.forget_kept();
    } else if (kind < 87) {
      appliance.set_attempts(1 + events.of(4));
      appliance.ask_for_sides(events.one_in(2));
    } else if (kind == 87) {
      if (appliance.session().is_open()) appliance.give_up({Errc::OutOfMemory, "as chance says"});
    } else if (kind < 90) {
      if (in == State::Calibrate || in == State::Export) appliance.end_service_state(events.one_in(2));
    } else if (kind == 90) {
      appliance.calibrated_anew();
    }
  }
  void mend() {
    world.pulled = false;
    device.right_camera.held = false;
    world.wall_shift_s = 0;
    luck.mend();
  }
  // Nobody touches anything, and what failed is mended: the states' own limits bring it back.
  void comes_back() {
    events.note("left alone");
    if (!events.one_in(3)) mend();
    world.pulled = false;
    const hal::Instant begun = now();
    constexpr milliseconds kLongest = budget::kCalibrateLimit + budget::kStaffLimit + budget::kTurnLimit +
                                      budget::kFuseLimit + 5 * budget::kStageLimit;
    while (in != State::Idle && now() - begun < kLongest && !HasFailure()) {
      world.ahead_s += 1;
      appliance.step(milliseconds(1));  // the threads need some real time, too
      is_well();
      if (in == State::Fault) mend();
    }
    EXPECT_EQ(in, State::Idle) << "no way back from there";
    nothing_is_left();
  }

  RandomEvents events{20'000};
  State in = State::SelfTest;
  hal::Instant since = std::chrono::steady_clock::now();
  int stored = 0;
  std::map<std::pair<State, Event>, std::uint64_t> walked;
  Luck luck;
  std::array<SideJob, kJobLanes> side;  // of the appliance's threads, so before it
  hal::sim::RigOptions rig = test::small_rig(kTiny);
  test::PlayedWorld world;
  test::PlayedDevice device{world, rig.width_px, rig.height_px};
  LuckyStages stages{luck};
  LuckyRecords records{luck};
  LiveJudge judge = *LiveJudge::open(rig.width_px);
  BootMemory memory{std::size_t{2} * 7 * 64 * 40, 1 << 20, 1 << 20, 1 << 18, 1 << 20};
  ThreadPool pool{1};
  Appliance appliance{{device, stages, memory, pool, records, &judge}};
};

TEST_F(RandomAppliance, WalksOnlyTheTableAndComesBackFromEverywhere) {
  while (events.go_on()) {
    event();
    appliance.step(milliseconds(events.one_in(20) ? 1 : 0));
    is_well();
    if (in == State::Idle && events.one_in(200)) nothing_is_left();
    if (events.one_in(2'000)) comes_back();
  }
  mend();
  std::printf("%lu events from seed %lu: %zu of %zu rows of the table walked, %d models stored\n",
              events.step(), events.seed(), walked.size(), kTransitions.size(), stored);
  for (const Transition& row : kTransitions)
    if (!walked.contains({row.from, row.event}))
      std::printf("  not walked: %s %s\n", name_of(row.from).data(), name_of(row.event).data());
  EXPECT_GT(stored, 0);
}

}  // namespace
}  // namespace relievo::firmware
