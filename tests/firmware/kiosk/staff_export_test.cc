// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An export that goes wrong, through the operator's page: each way has words of its own and a way on, nothing
// half-written passes for an export, and the records stay.
#include <unistd.h>

#include "firmware/base/budget.h"
#include "firmware/service/export_records.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/faulty_stick.h"
#include "tests/support/faulty_store.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

using test::FaultyStick;
using ui::Outcome;

class StaffExportTest : public StaffHands {
 protected:
  // Without the page: as its job does.
  Result<void> exported(storage::Store& store, const std::vector<storage::SubjectId>& who,
                        const FurtherModels& further = {}) {
    const std::atomic<bool> cancelled{false};
    pipeline::Progress progress;
    JobControl control{cancelled, progress};
    return export_records(store, wall(), faulty, who, further, control, trace);
  }
  ExportTrace trace;
  StaffExportTest() { changes.media = &faulty; }
  Outcome outcome() const { return kiosk->view().service->work.outcome; }
  bool ended() {
    return until([this] { return outcome() != Outcome::None; });
  }
  Outcome export_all() {
    tap("export all");
    EXPECT_TRUE(ended());
    return outcome();
  }
  // What the page says, and that it can be tried again from there.
  std::string said() {
    kiosk->turn();
    EXPECT_EQ(kiosk->appliance().state(), State::Staff);
    EXPECT_NE(find("export all"), nullptr) << "no way on";
    const ui::Node* node = find("outcome");
    return node == nullptr ? std::string() : std::string(node->name.empty() ? node->text : node->name);
  }
  std::string whole() const {
    const ui::Node* node = find("whole");
    std::string words(node == nullptr ? std::string_view() : node->text);
    for (const char* mark : {"\u2066", "\u2068", "\u2069"})  // what keeps the figures' direction
      for (std::size_t at = words.find(mark); at != std::string::npos; at = words.find(mark))
        words.erase(at, 3);
    return words;
  }
  // The codes under which something can be taken for an export.
  std::string exported_on(const Path& root) const {
    std::string codes;
    for (std::int64_t number = 1; number <= 2; ++number) {
      const Path record = root / "relievo" / code_of(number);
      if (!std::filesystem::exists(record)) continue;
      EXPECT_TRUE(std::filesystem::exists(record / "record.txt") &&
                  std::filesystem::exists(record / "model.ply"))
          << "half a record under its name";
      codes += std::to_string(number);
    }
    return codes;
  }
  static std::size_t entries_of(const Path& at) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(at), {}));
  }
  // Once more, and now nothing is wrong: everything is there, and nothing else.
  void ends_well_the_next_time(const Path& root) {
    faulty.fail(FaultyStick::Fault::None);
    faulty.plug_in_again();
    EXPECT_EQ(export_all(), Outcome::Done);
    EXPECT_EQ(exported_on(root), "12");
    EXPECT_EQ(entries_of(root / "relievo"), 2U) << "something was left behind";
    kiosk.reset();
    auto store = storage::open_sqlite_store(args.store, wall(), {});
    ASSERT_TRUE(store.has_value());
    EXPECT_EQ((*store)->subjects({})->size(), 2U) << "an export takes nobody away";
  }
  hal::ManualClock time;  // of the test that lends it
  FaultyStick faulty{stick()};
  std::unique_ptr<test::TinyDisk> disk;
  std::unique_ptr<FaultyStick> on_disk;
};

TEST_F(StaffExportTest, AStickThatIsPulledOutCountsForNothingUntilItIsExportedToAgain) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::Pulled, 2);
  EXPECT_EQ(export_all(), Outcome::StickGone);
  EXPECT_NE(said().find("pulled out too early"), std::string::npos) << said();
  EXPECT_EQ(whole(), "") << "nobody knows what a pulled stick has kept";
  EXPECT_EQ(exported_on(stick().string() + " in a hand"), "2")
      << "the second was not finished: it has no name";
  ends_well_the_next_time(stick());
}

// Somebody prepared it: what is written would lie on the device, for whoever set the trap.
TEST_F(StaffExportTest, NothingIsWrittenThroughALinkOnTheStick) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  const Path elsewhere = folder.path() / "elsewhere", ours = stick() / "relievo";
  std::filesystem::create_directory(elsewhere);
  std::filesystem::create_directory_symlink(elsewhere, ours);
  EXPECT_EQ(export_all(), Outcome::StickBad);
  std::filesystem::remove(ours);
  std::filesystem::create_directory(ours);
  std::filesystem::create_directory_symlink(elsewhere, ours / code_of(2));
  std::filesystem::create_directory_symlink(elsewhere,
                                            ours / ("." + code_of(1) + ".part" + std::to_string(::getpid())));
  EXPECT_EQ(export_all(), Outcome::StickBad);
  EXPECT_EQ(entries_of(elsewhere), 0U);
  std::filesystem::remove(ours / code_of(2));
  ends_well_the_next_time(stick());
  EXPECT_EQ(entries_of(elsewhere), 0U);
}

TEST_F(StaffExportTest, TheStickIsReadOnceMoreAfterItWasLetGo) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  EXPECT_EQ(export_all(), Outcome::Done);
  EXPECT_EQ(faulty.taken_up(), 1);
  EXPECT_FALSE(faulty.current().has_value()) << "and let go again";
  ends_well_the_next_time(stick());
}

TEST_F(StaffExportTest, WhatTheStickForgetsWhenItIsLetGoIsNoticed) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::ForgetsLater);
  EXPECT_EQ(export_all(), Outcome::StickBad);
  EXPECT_NE(said().find("does not keep what is written"), std::string::npos) << said();
  EXPECT_NE(whole().find("1 of 2"), std::string::npos) << whole();
  EXPECT_FALSE(faulty.current().has_value()) << "a bad one is let go, too";
  ends_well_the_next_time(stick());
}

TEST_F(StaffExportTest, AStickPulledBeforeItsLastReadingIsNotPromised) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::PulledLater);
  EXPECT_EQ(export_all(), Outcome::StickGone);
  EXPECT_NE(said().find("pulled out too early"), std::string::npos) << said();
  ends_well_the_next_time(stick());
}

TEST_F(StaffExportTest, AStickThatCannotBeOpenedOnceMoreIsSaidToBeUnchecked) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::NotAgain);
  EXPECT_EQ(export_all(), Outcome::StickUnchecked);
  EXPECT_NE(said().find("cannot open the stick once more"), std::string::npos) << said();
  EXPECT_EQ(exported_on(stick()), "12") << "what was read back once stays";
  ends_well_the_next_time(stick());
}

TEST_F(StaffExportTest, WhatAnEarlierExportLeftIsReplacedAsAWholeOrStays) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  ASSERT_EQ(export_all(), Outcome::Done);
  faulty.plug_in_again();
  const std::string before = text_of_file(stick() / "relievo" / code_of(1) / "record.txt");
  faulty.fail(FaultyStick::Fault::Pulled, 1);
  EXPECT_EQ(export_all(), Outcome::StickGone);
  EXPECT_EQ(exported_on(stick().string() + " in a hand"), "12");
  EXPECT_EQ(text_of_file(Path(stick().string() + " in a hand") / "relievo" / code_of(1) / "record.txt"),
            before);
  // The power went between the old folder's going and the new one's coming.
  faulty.plug_in_again();
  std::filesystem::rename(stick() / "relievo" / code_of(2),
                          stick() / "relievo" / ("." + code_of(2) + ".before"));
  faulty.fail(FaultyStick::Fault::Forgets, 1);
  EXPECT_EQ(export_all(), Outcome::StickBad);
  EXPECT_EQ(exported_on(stick()), "12") << "it was brought back";
  ends_well_the_next_time(stick());
}

TEST_F(StaffExportTest, AStickThatGivesBackOtherBytesIsFoundOut) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::Forgets, 2);
  EXPECT_EQ(export_all(), Outcome::StickBad);
  EXPECT_NE(said().find("does not keep"), std::string::npos) << said();
  EXPECT_NE(whole().find("stick: 1 of 2."), std::string::npos) << whole();
  EXPECT_EQ(exported_on(stick()), "2");
  EXPECT_EQ(entries_of(stick() / "relievo"), 1U);
  ends_well_the_next_time(stick());
}

TEST_F(StaffExportTest, AllThatTheSearchLetsPassIsExportedNotOnlyThePageThatIsShown) {
  constexpr int kFound = 51;  // a page and one more
  const pipeline::FaceModel model = storage::test::sample_model();
  {
    auto store = storage::open_sqlite_store(args.store, wall(), {});
    ASSERT_TRUE(store.has_value());
    for (int i = 1; i <= kFound; ++i)
      ASSERT_TRUE((*store)->add_enrolment(storage::NewSubject{"Ada " + std::to_string(i)},
                                          storage::test::sample_enrolment(model)));
    ASSERT_TRUE(
        (*store)->add_enrolment(storage::NewSubject{"Grace Hopper"}, storage::test::sample_enrolment(model)));
  }
  start();
  first_start();
  sign_in("80526", StaffRole::Operator);
  tap("open records");
  const auto newest = "record " + std::to_string(kFound + 1);
  ASSERT_TRUE(until([&] { return find(newest) != nullptr; }));
  tap("search");
  tap("key d");
  tap("done");
  ASSERT_TRUE(until([&] { return find("all") != nullptr && find(newest) == nullptr; }));
  EXPECT_EQ(export_all(), Outcome::Done);
  EXPECT_EQ(entries_of(stick() / "relievo"), std::size_t{kFound});
  EXPECT_TRUE(std::filesystem::exists(stick() / "relievo" / code_of(1))) << "of the last page";
  EXPECT_FALSE(std::filesystem::exists(stick() / "relievo" / code_of(kFound + 1))) << "who was not found";
}

TEST_F(StaffExportTest, WhoHasNoPortraitIsLeftOutAndTheOthersAreWritten) {
  enrol("Ada Lovelace");
  ASSERT_TRUE((*storage::open_sqlite_store(args.store, wall(), {}))->add_subject({"Somebody New"}));
  open_records({"Grace Hopper"});
  EXPECT_EQ(export_all(), Outcome::Failed);
  EXPECT_NE(said().find("The log says why"), std::string::npos) << said();
  EXPECT_NE(whole().find("stick: 2 of 3."), std::string::npos) << whole();
  EXPECT_EQ(faulty.taken_up(), 1) << "read once more, as ever";
  EXPECT_EQ(entries_of(stick() / "relievo"), 2U);
  EXPECT_TRUE(std::ranges::any_of(kiosk->staff().log().entries(), [](const ui::LogLine& line) {
    return line.text.find("has no portrait") != std::string::npos;
  }));
  faulty.fail(FaultyStick::Fault::Held);
  faulty.plug_in_again();
  EXPECT_EQ(export_all(), Outcome::Failed) << "not: all is there";
}

TEST_F(StaffExportTest, AnExportThatGoesOnOutlastsTheMachinesLimit) {
  changes.clock = &time;
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::Waits);
  tap("export all");
  ASSERT_TRUE(until([this] { return faulty.waits(); }));
  kiosk->turn();
  time.advance(budget::kExportLimit - std::chrono::seconds(1));
  kiosk->turn();
  ASSERT_EQ(kiosk->appliance().state(), State::Export);
  faulty.fail(FaultyStick::Fault::Waits);
  faulty.let_go_on();
  ASSERT_TRUE(until([this] { return faulty.waits(); })) << "the second record";
  kiosk->turn();
  time.advance(budget::kExportLimit - std::chrono::seconds(1));
  kiosk->turn();
  EXPECT_EQ(kiosk->appliance().state(), State::Export) << "a record came meanwhile";
  faulty.let_go_on();
  ASSERT_TRUE(ended());
  EXPECT_EQ(outcome(), Outcome::Done);
  EXPECT_EQ(exported_on(stick()), "12");
}

TEST_F(StaffExportTest, AnExportThatHangsIsEndedByTheMachinesLimit) {
  changes.clock = &time;
  open_records({"Ada Lovelace"});
  faulty.fail(FaultyStick::Fault::Waits);
  tap("export all");
  ASSERT_TRUE(until([this] { return faulty.waits(); }));
  kiosk->turn();
  for (int part = 0; part < 5; ++part) {  // a jump over the whole limit would end any state
    time.advance(budget::kExportLimit / 4);
    kiosk->turn();
  }
  EXPECT_NE(kiosk->appliance().state(), State::Export);
  faulty.let_go_on();
}

// Of a sheet that is no head.
TEST_F(StaffExportTest, WhyThereIsNoSolidStandsInTheRecord) {
  enrol("Ada Lovelace");
  auto store = storage::open_sqlite_store(args.store, wall(), {});
  ASSERT_TRUE(store.has_value());
  ASSERT_TRUE(exported(**store, {storage::SubjectId{1}}, {.watertight = true}));
  const Path record = std::filesystem::directory_iterator(stick() / "relievo")->path();
  EXPECT_FALSE(std::filesystem::exists(record / "solid.stl"));
  EXPECT_NE(text_of_file(record / "record.txt").find("\nno solid: "), std::string::npos);
  // Whose portrait has left the store stands in its log.
  const auto lines = (*store)->audit(0, 100);
  ASSERT_TRUE(lines.has_value());
  EXPECT_EQ(lines->back().event.what, "enrolment.exported");
  EXPECT_TRUE(lines->back().event.subject == storage::SubjectId{1} && lines->back().event.detail == "1");
}

TEST_F(StaffExportTest, WhatTheLogCannotTellOfDoesNotLeaveAndTheStickIsNotBlamed) {
  enrol("Ada Lovelace");
  auto store = storage::open_sqlite_store(args.store, wall(), {.mode = storage::OpenMode::ReadOnly});
  ASSERT_TRUE(store.has_value());
  const auto done = exported(**store, {storage::SubjectId{1}});
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(outcome_of_export(done.error(), trace), Outcome::Failed);
  EXPECT_FALSE(std::filesystem::exists(stick() / "relievo"));
}

TEST_F(StaffExportTest, ADamagedRecordDoesNotKeepTheOthersBack) {
  enrol("Ada Lovelace");
  enrol("Grace Hopper");
  struct OneDamaged final : test::FaultyStore {
    using FaultyStore::FaultyStore;
    Result<std::vector<storage::Enrolment>> enrolments(storage::SubjectId id) override {
      if (id == storage::SubjectId{1}) return Error{Errc::StoreCorrupt, "has lost a part"};
      return FaultyStore::enrolments(id);
    }
  };
  auto real = storage::open_sqlite_store(args.store, wall(), {});
  ASSERT_TRUE(real.has_value());
  const std::atomic<std::optional<Errc>> no_fault;
  OneDamaged store(*std::move(real), no_fault);
  const auto done = exported(store, {storage::SubjectId{1}, storage::SubjectId{2}});
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().code, Errc::StoreCorrupt) << "and it is told";
  EXPECT_EQ(trace.whole, 1);
  EXPECT_EQ(outcome_of_export(done.error(), trace), Outcome::Failed);
}

TEST_F(StaffExportTest, TheOperatorStopsItAndNothingIsHalfWritten) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::Waits, 2);
  tap("export all");
  ASSERT_TRUE(until([this] { return faulty.waits() && find("stop export") != nullptr; }));
  EXPECT_NE(find("export progress"), nullptr);
  tap("stop export");
  faulty.let_go_on();
  ASSERT_TRUE(ended());
  EXPECT_EQ(outcome(), Outcome::Cancelled);
  EXPECT_NE(said().find("Cancelled. Nothing was left half done"), std::string::npos) << said();
  EXPECT_NE(whole().find("stick: 1 of 2."), std::string::npos) << whole();
  EXPECT_EQ(exported_on(stick()), "2");
  EXPECT_EQ(entries_of(stick() / "relievo"), 1U);
  ends_well_the_next_time(stick());
}

TEST_F(StaffExportTest, WhatWasExportedBeforeTheOperatorSignedOutStandsInTheLog) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::Waits, 2);
  tap("export all");
  ASSERT_TRUE(until([this] { return faulty.waits(); }));
  kiosk->feed({ui::Input::Kind::Back});
  ASSERT_TRUE(until([this] { return find("sign out") != nullptr; }));
  sign_out();
  faulty.let_go_on();
  // The event's number and how many they were (EventLog).
  const std::string line = "\te" + std::to_string(int(ui::LogEvent::RecordsExported)) + "\t1";
  EXPECT_TRUE(
      until([&] { return text_of_file(args.store / "relievo.log").find(line) != std::string::npos; }));
  EXPECT_EQ(exported_on(stick()), "2");
}

TEST_F(StaffExportTest, OfAStickThatIsNotLetGoItIsSaidThatAllIsThere) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  faulty.fail(FaultyStick::Fault::Held);
  EXPECT_EQ(export_all(), Outcome::StickHeld);
  EXPECT_NE(said().find("all there and read back"), std::string::npos) << said();
  EXPECT_EQ(exported_on(stick()), "12");
  ends_well_the_next_time(stick());
}

TEST_F(StaffExportTest, AFullStickKeepsWhatWasWholeAndSaysHowMany) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  ASSERT_EQ(export_all(), Outcome::Done);
  constexpr std::uintmax_t kPage = 4096;
  std::uintmax_t one = 0;
  for (const auto& file : std::filesystem::directory_iterator(stick() / "relievo" / code_of(1)))
    one += (file.file_size() + kPage - 1) / kPage * kPage;
  disk = std::make_unique<test::TinyDisk>(one * 3 / 2);
  if (!disk->mounted()) GTEST_SKIP() << disk->why_not();
  on_disk = std::make_unique<FaultyStick>(disk->path());
  tap("sign out");
  kiosk.reset();
  changes.media = on_disk.get();
  start();
  sign_in("80526", StaffRole::Operator);
  tap("open records");
  ASSERT_TRUE(until([this] { return find("record " + std::to_string(2)) != nullptr; }));
  EXPECT_EQ(export_all(), Outcome::StickFull);
  EXPECT_NE(said().find("stick is full"), std::string::npos) << said();
  EXPECT_NE(whole().find("stick: 1 of 2."), std::string::npos) << whole();
  EXPECT_EQ(exported_on(disk->path()).size(), 1U);
  EXPECT_EQ(entries_of(disk->path() / "relievo"), 1U) << "nothing half-written";
}

TEST_F(StaffExportTest, AWriteProtectedStickIsNamedSo) {
  disk = std::make_unique<test::TinyDisk>(std::size_t{64} << 20);
  if (!disk->mounted()) GTEST_SKIP() << disk->why_not();
  on_disk = std::make_unique<FaultyStick>(disk->path());
  changes.media = on_disk.get();
  open_records({"Ada Lovelace", "Grace Hopper"});
  ASSERT_TRUE(disk->protect(true));
  EXPECT_EQ(export_all(), Outcome::StickLocked);
  EXPECT_NE(said().find("write-protected"), std::string::npos) << said();
  ASSERT_TRUE(disk->protect(false));
  EXPECT_EQ(entries_of(disk->path()), 0U);
  EXPECT_EQ(export_all(), Outcome::Done) << "its switch was slid back";
  EXPECT_EQ(exported_on(disk->path()), "12");
}

}  // namespace
}  // namespace relievo::firmware
