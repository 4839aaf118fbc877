// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/stored_visits.h"

#include <gtest/gtest.h>

#include <limits>

#include "firmware/records/receipt.h"
#include "tests/firmware/played_appliance.h"
#include "tests/storage/sample.h"
#include "tests/support/faulty_store.h"
#include "tests/support/manual_clock.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

// Whose disk fails by the part: nothing can be read any more, or no setting written.
class FailingStore final : public test::FaultyStore {
 public:
  explicit FailingStore(std::unique_ptr<storage::Store> real) : FaultyStore(std::move(real), none_) {}
  std::atomic<bool> unreadable{false}, unwritable{false};
  Result<storage::Subject> subject(storage::SubjectId id) override {
    if (unreadable) return Error{Errc::IoFailed, "as the test says"};
    return FaultyStore::subject(id);
  }
  Result<storage::Enrolment> enrolment(storage::EnrolmentId id) override {
    if (unreadable) return Error{Errc::IoFailed, "as the test says"};
    return FaultyStore::enrolment(id);
  }
  Result<void> set_setting(std::string_view key, std::string_view value) override {
    if (unwritable) return Error{Errc::MediaFull, "as the test says"};
    return FaultyStore::set_setting(key, value);
  }

 private:
  std::atomic<std::optional<Errc>> none_;
};

class StoredVisitsTest : public ApplianceTest {
 protected:
  StoredVisitsTest() { EXPECT_TRUE(reach(State::Idle)); }
  // Some turns of the kiosk, at that moment.
  void turns(MovedFaces& moved, const MovedFaces::Said& said, hal::Instant at) {
    for (int turn = 0; turn < 200; ++turn) {
      moved.keep(7, said.faces, said.note, side_tasks, log, at);
      side_tasks.turn();
      appliance.step(milliseconds(1));
    }
    while (side_tasks.busy(JobLane::Keeper)) appliance.step(milliseconds(1));
  }
  test::TemporaryFolder folder;
  hal::ManualClock clock;
  FailingStore store{storage::test::opened(folder.path() / "store")};
  SideTasks side_tasks{appliance};
  EventLog log{clock, {}};
};

// Who is told that nothing was stored must have nothing stored; who has, needs the code.
TEST_F(StoredVisitsTest, WhatWasStoredHasItsCodeThoughNothingCanBeReadAfterIt) {
  StoredVisits visits(store, clock, folder.path());
  VisitRecord record = named("Ada");
  record.consent = {"sample-1", "en", {}};
  store.unreadable = true;
  const Result<KeptVisit> told = visits.keep(record, storage::test::sample_model());
  ASSERT_TRUE(told.has_value()) << told.error().what.view();
  store.unreadable = false;
  const auto whom = find_by_receipt(store, told->receipt.view());
  ASSERT_TRUE(whom.has_value());
  EXPECT_EQ(whom->name, "Ada");
  EXPECT_EQ(store.enrolment(told->enrolment)->subject, whom->id);
}

TEST_F(StoredVisitsTest, WhereTheDiskHasNoRoomItIsKnownBeforeAnybodyComes) {
  StoredVisits visits(store, clock, folder.path());
  constexpr auto kMost = std::numeric_limits<std::int32_t>::max();
  EXPECT_TRUE(visits.has_room(1));
  EXPECT_FALSE(visits.has_room(kMost)) << "as many MiB as no disk has";
  VisitRecord record = named("Ada");
  record.least_room_mib = kMost;
  const Result<KeptVisit> refused = visits.keep(record, storage::test::sample_model());
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Errc::MediaFull);
  StoredVisits nowhere(store, clock, folder.path() / "gone");
  EXPECT_TRUE(nowhere.has_room(1)) << "a disk that does not tell keeps nobody out";
}

// Else the record would be erased for an age that it does not have.
TEST_F(StoredVisitsTest, NothingIsStoredByAClockThatWentBackSinceThePersonAgreed) {
  StoredVisits visits(store, clock, folder.path());
  VisitRecord record = named("Ada");
  const auto now = std::chrono::floor<milliseconds>(clock.wall_now());
  record.consent = {"sample-1", "en", now + std::chrono::hours(1)};
  const Result<KeptVisit> refused = visits.keep(record, storage::test::sample_model());
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Errc::InvalidInput) << "and not a fault of the machine";
  EXPECT_EQ(*store.count_subjects(), 0);
  record.consent.given_at = now;
  const Result<KeptVisit> done = visits.keep(record, storage::test::sample_model());
  ASSERT_TRUE(done.has_value());
  EXPECT_EQ(done->at, now);
}

TEST_F(StoredVisitsTest, ThatTheCamerasHaveMovedIsWrittenAgainWhereTheDiskWasFull) {
  MovedFaces moved(store);
  ASSERT_TRUE(moved.read(7).has_value());
  store.unwritable = true;
  const hal::Instant at = clock.now();
  turns(moved, {2, "0.4 px"}, at);
  store.unwritable = false;
  turns(moved, {2, "0.4 px"}, at + std::chrono::seconds(59));
  EXPECT_EQ(*store.setting("moved_faces"), "") << "not in every turn";
  turns(moved, {2, "0.4 px"}, at + std::chrono::seconds(61));
  MovedFaces after(store);
  EXPECT_EQ(after.read(7)->faces, 2);
  EXPECT_EQ(after.read(7)->note, "0.4 px");
}

}  // namespace
}  // namespace relievo::firmware
