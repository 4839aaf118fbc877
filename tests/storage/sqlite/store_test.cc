// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The verbs, one by one.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <atomic>

#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using test::code_of;
using test::identical;
using test::opened;
using test::sample_calibration;
using test::sample_enrolment;
using test::sample_model;

class SqliteStoreVerbs : public ::testing::Test {
 protected:
  void SetUp() override {
    store = opened(dir);
    ASSERT_TRUE(store);
  }
  void reopen() {
    store.reset();
    store = opened(dir);
    ASSERT_TRUE(store);
  }
  relievo::test::TemporaryFolder folder;
  std::filesystem::path dir = folder / "store";
  std::unique_ptr<Store> store;
};

unsigned mode_of(const std::filesystem::path& path) {
  struct stat status {};
  ::stat(path.c_str(), &status);
  return status.st_mode & 0777;
}

TEST_F(SqliteStoreVerbs, IsNobodyElsesBusiness) {
  EXPECT_EQ(mode_of(dir), 0700u);
  EXPECT_EQ(mode_of(dir / "relievo.db"), 0600u);
  ASSERT_TRUE(store->add_subject({"Ada"}));
  for (const auto& entry : std::filesystem::directory_iterator(dir))
    EXPECT_EQ(mode_of(entry.path()) & 077, 0u) << entry.path();
}

TEST_F(SqliteStoreVerbs, EnrolsInOneGoAndReturnsTheModelBitForBit) {
  const auto model = sample_model(40, 3);
  const auto id = store->add_enrolment(NewSubject{"Ada Lovelace"}, sample_enrolment(model));
  ASSERT_TRUE(id);
  reopen();
  const auto people = store->subjects({});
  ASSERT_TRUE(people);
  ASSERT_EQ(people->size(), 1u);
  EXPECT_EQ(people->front().name, "Ada Lovelace");
  EXPECT_EQ(people->front().enrolments, 1);
  const auto back = store->load_model(*id, std::pmr::new_delete_resource());
  ASSERT_TRUE(back);
  EXPECT_TRUE(identical(model, *back));
  const auto record = store->enrolment(*id);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->consent.wording, "2026-03");
  EXPECT_EQ(record->consent.language, "en");
  EXPECT_EQ(record->consent.given_at, WallTime(std::chrono::milliseconds(1'772'000'000'000)));
  EXPECT_EQ(record->created_at, WallTime(std::chrono::milliseconds(1'772'000'000'123)));
  EXPECT_EQ(record->algorithms, "[matcher]\nname = \"refined\"\n");
  EXPECT_EQ(record->report_json, "{\"version\": \"0.1.0\"}");
  EXPECT_EQ(record->calibration_revision, 0u);
  EXPECT_TRUE(store->check());
}

TEST_F(SqliteStoreVerbs, AddsASecondEnrolmentToSomebodyKnown) {
  const auto ada = store->add_subject({"Ada"});
  ASSERT_TRUE(ada);
  const auto first = sample_model(6, 1), second = sample_model(6, 2);
  ASSERT_TRUE(store->add_enrolment(*ada, sample_enrolment(first)));
  ASSERT_TRUE(store->add_enrolment(*ada, sample_enrolment(second)));
  const auto both = store->enrolments(*ada);
  ASSERT_TRUE(both);
  ASSERT_EQ(both->size(), 2u);
  EXPECT_TRUE(identical(second, *store->load_model((*both)[1].id, std::pmr::new_delete_resource())));
}

TEST_F(SqliteStoreVerbs, RenewingErasesTheEarlierOnesOfThatPersonAlone) {
  const auto ada = store->add_subject({"Ada"}), bob = store->add_subject({"Bob"});
  const auto first = sample_model(6, 1), second = sample_model(6, 2);
  const auto old = store->add_enrolment(*ada, sample_enrolment(first));
  ASSERT_TRUE(old);
  ASSERT_TRUE(store->add_enrolment(*bob, sample_enrolment(first)));
  auto renewed = sample_enrolment(second);
  renewed.renews = true;
  renewed.calibration_revision = 77;
  EXPECT_EQ(code_of(store->add_enrolment(*ada, renewed)), Errc::NotFound);
  EXPECT_TRUE(store->enrolment(*old)) << "refused, and yet erased";
  renewed.calibration_revision = 0;
  const auto made = store->add_enrolment(*ada, renewed);
  ASSERT_TRUE(made);
  ASSERT_EQ(store->enrolments(*ada)->size(), 1u);
  EXPECT_EQ(store->enrolments(*ada)->front().id, *made);
  EXPECT_TRUE(identical(second, *store->load_model(*made, std::pmr::new_delete_resource())));
  EXPECT_EQ(store->enrolments(*bob)->size(), 1u) << "of somebody else";
  EXPECT_EQ(code_of(store->load_model(*old, std::pmr::new_delete_resource())), Errc::NotFound);
  EXPECT_EQ(store->audit(0, 100)->back().event.what, "enrolment.renewed");
  EXPECT_TRUE(store->check());
}

TEST_F(SqliteStoreVerbs, RefusedEnrolmentsLeaveNobodyBehind) {
  auto model = sample_model(6);
  auto enrolment = sample_enrolment(model);
  EXPECT_EQ(code_of(store->add_enrolment(SubjectId{99}, enrolment)), Errc::NotFound);
  EXPECT_EQ(code_of(store->add_enrolment(NewSubject{""}, enrolment)), Errc::InvalidInput);
  enrolment.calibration_revision = 5;
  EXPECT_EQ(code_of(store->add_enrolment(NewSubject{"Ada"}, enrolment)), Errc::NotFound);
  enrolment.calibration_revision = 0;
  model.mesh.triangles[0][0] = 10'000;
  EXPECT_EQ(code_of(store->add_enrolment(NewSubject{"Ada"}, enrolment)), Errc::InvalidInput);
  enrolment.consent.wording.clear();
  EXPECT_EQ(code_of(store->add_enrolment(NewSubject{"Ada"}, enrolment)), Errc::InvalidInput);
  EXPECT_TRUE(store->subjects({})->empty());
  EXPECT_TRUE(store->audit(0, 100)->empty());
}

TEST_F(SqliteStoreVerbs, FindsPeople) {
  for (const char* name : {"Ada Lovelace", "Bob", "ada", "Žofie"}) ASSERT_TRUE(store->add_subject({name}));
  EXPECT_EQ(store->subjects({.name = "ada"})->size(), 1u);
  EXPECT_EQ(store->subjects({.name = "Žofie"})->size(), 1u);
  EXPECT_TRUE(store->subjects({.name = "Žof"})->empty()) << "a part of a name is nobody's";
  EXPECT_EQ(store->subjects({.skip = 1, .limit = 2})->front().name, "ada");
  const auto everyone = store->subjects({});
  EXPECT_EQ(*store->count_subjects(), static_cast<std::int64_t>(everyone->size()));
  ASSERT_TRUE(store->erase_subject(everyone->back().id));
  EXPECT_EQ(*store->count_subjects(), static_cast<std::int64_t>(everyone->size()) - 1);
  EXPECT_EQ(store->subjects({.skip = 1, .limit = 2})->size(), 2u);
  EXPECT_EQ(code_of(store->subject(SubjectId{77})), Errc::NotFound);
}

TEST_F(SqliteStoreVerbs, ShowsEverybodyOnceWithTheirNewestConsent) {
  const auto model = sample_model(4);
  auto enrolment = sample_enrolment(model);
  const auto ada = store->add_subject({"Ada"});
  for (const char* wording : {"2026-03", "2026-09"}) {
    enrolment.consent.wording = wording;
    ASSERT_TRUE(store->add_enrolment(*ada, enrolment));
  }
  ASSERT_TRUE(store->add_subject({"Bob"}));
  ASSERT_TRUE(store->erase_subject(*store->add_subject({"Eve"})));
  std::string seen;
  const Store::Visit note = [&](Subject& subject, const Consent* newest) -> Result<void> {
    seen += subject.name + (newest != nullptr ? " " + newest->wording : std::string()) + ", ";
    return {};
  };
  ASSERT_TRUE(store->for_each_subject(Store::Opened::NamesAndConsents, note));
  EXPECT_EQ(seen, "Bob, Ada 2026-09, ");
  seen.clear();
  ASSERT_TRUE(store->for_each_subject(Store::Opened::Names, note));
  EXPECT_EQ(seen, "Bob, Ada, ");
  int visited = 0;
  const auto stopped =
      store->for_each_subject(Store::Opened::Names, [&](Subject&, const Consent*) -> Result<void> {
        ++visited;
        return Error{Errc::Cancelled, "as the test says"};
      });
  EXPECT_EQ(code_of(stopped), Errc::Cancelled);
  EXPECT_EQ(visited, 1);
}

TEST_F(SqliteStoreVerbs, NeverGivesANumberTwice) {
  const auto ada = store->add_subject({"Ada"});
  ASSERT_TRUE(store->erase_subject(*ada));
  const auto bob = store->add_subject({"Bob"});
  EXPECT_NE(*ada, *bob);
  EXPECT_EQ(code_of(store->erase_subject(*ada)), Errc::NotFound);
}

TEST_F(SqliteStoreVerbs, KeepsEveryCalibrationAndOneActive) {
  EXPECT_EQ(code_of(store->active_calibration()), Errc::NotCalibrated);
  auto calibration = sample_calibration();
  ASSERT_EQ(*store->save_calibration(calibration, "rig.yml"), 1u);
  calibration.left.focal_px.x += 1;
  calibration.epipolar_shift_px = 0.02;
  ASSERT_EQ(*store->save_calibration(calibration, "live", {CalibrationGrade::Pass, 0.04, 0.2, 0.1}), 2u);
  EXPECT_EQ(store->active_calibration()->revision, 2u);
  EXPECT_EQ(store->active_calibration()->left.focal_px.x, calibration.left.focal_px.x);
  ASSERT_TRUE(store->activate_calibration(1));
  reopen();
  EXPECT_EQ(store->active_calibration()->left.focal_px.x, sample_calibration().left.focal_px.x);
  EXPECT_EQ(code_of(store->activate_calibration(3)), Errc::NotFound);
  EXPECT_EQ(store->active_calibration()->revision, 1u) << "a refused one changes nothing";
  const auto all = store->calibrations();
  ASSERT_EQ(all->size(), 2u);
  EXPECT_EQ(all->front().note, "live");
  EXPECT_FALSE(all->front().active);
  EXPECT_TRUE(all->back().active);
  EXPECT_EQ(all->front().epipolar_shift_px, 0.02);
  EXPECT_EQ(all->front().figures.grade, CalibrationGrade::Pass);
  EXPECT_EQ(all->front().figures.held_out_epipolar_px, 0.04);
  EXPECT_EQ(all->front().figures.depth_sigma_mm, 0.2);
  EXPECT_EQ(all->back().figures.grade, CalibrationGrade::Unknown);
  EXPECT_NEAR(all->back().baseline_mm, 120.5, 0.01);
  EXPECT_EQ(all->back().enrolments, 0);
  calibration.left.focal_px.x = -1;
  EXPECT_EQ(code_of(store->save_calibration(calibration, "")), Errc::InvalidInput);
  const auto model = sample_model(4);
  auto enrolment = sample_enrolment(model);
  enrolment.calibration_revision = 2;
  const auto id = store->add_enrolment(NewSubject{"Ada"}, enrolment);
  EXPECT_EQ(store->enrolment(*id)->calibration_revision, 2u);
  EXPECT_EQ(store->calibrations()->front().enrolments, 1);
}

TEST_F(SqliteStoreVerbs, KnowsACalibrationByItsNumbers) {
  auto calibration = sample_calibration();
  EXPECT_EQ(*store->know_calibration(calibration, "rig.yml"), 1u);
  EXPECT_EQ(code_of(store->active_calibration()), Errc::NotCalibrated) << "to know one is not to use it";
  EXPECT_NE(store->active_calibration().error().what.view().find("is in use"), std::string_view::npos)
      << "and it is not called none";
  calibration.epipolar_shift_px += 1e-16;
  ASSERT_EQ(*store->save_calibration(calibration, "live", {CalibrationGrade::Pass, 0.04, 0.2, 0.1}), 2u);
  reopen();
  EXPECT_EQ(*store->know_calibration(sample_calibration(), "again"), 1u);
  calibration.revision = 77;
  EXPECT_EQ(*store->know_calibration(calibration, "again"), 2u);
  EXPECT_EQ(store->active_calibration()->revision, 2u);
  calibration.right.distortion[0] += 1e-9;
  EXPECT_EQ(*store->know_calibration(calibration, "another"), 3u);
  EXPECT_EQ(store->active_calibration()->revision, 2u);
  EXPECT_EQ(store->calibrations()->size(), 3u);
  EXPECT_EQ(store->calibrations()->front().note, "another");
  EXPECT_EQ(store->calibration(3)->right.distortion[0], calibration.right.distortion[0]);
  calibration.left.focal_px.x = -1;
  EXPECT_EQ(code_of(store->know_calibration(calibration, "")), Errc::InvalidInput);
}

TEST_F(SqliteStoreVerbs, RemembersSettings) {
  EXPECT_EQ(*store->setting("language"), "");
  ASSERT_TRUE(store->set_setting("language", "de"));
  ASSERT_TRUE(store->set_setting("language", "fr"));
  ASSERT_TRUE(store->set_setting("empty", ""));
  reopen();
  EXPECT_EQ(*store->setting("language"), "fr");
  EXPECT_EQ(*store->setting("empty"), "");
  EXPECT_EQ(code_of(store->set_setting("", "x")), Errc::InvalidInput);
}

TEST_F(SqliteStoreVerbs, AuditsWithoutNames) {
  const auto model = sample_model(4);
  const auto ada = store->add_subject({"Ada Canary"});
  ASSERT_TRUE(store->add_enrolment(*ada, sample_enrolment(model)));
  ASSERT_TRUE(store->set_setting("pin", "4711"));
  ASSERT_TRUE(store->append_audit({"technician.entered", {}, "lock"}));
  ASSERT_TRUE(store->erase_subject(*ada));
  const auto lines = store->audit(0, 100);
  ASSERT_TRUE(lines);
  std::string words;
  for (const auto& line : *lines) {
    words += line.event.what + " ";
    EXPECT_EQ((line.event.what + line.event.detail).find("Canary"), std::string::npos);
    EXPECT_EQ(line.event.detail.find("4711"), std::string::npos);
  }
  EXPECT_EQ(words, "subject.added enrolment.added setting.changed technician.entered subject.erased ");
  EXPECT_EQ(lines->back().event.subject, *ada);
  EXPECT_EQ(store->audit(3, 1)->front().number, 4);
  EXPECT_EQ(code_of(store->append_audit({"", {}, ""})), Errc::InvalidInput);
  EXPECT_TRUE(store->check());
}

// What was committed is said to be stored, whoever reads meanwhile; what it replaced goes from the log later.
TEST_F(SqliteStoreVerbs, ARenewalBesideAReaderIsStored) {
  const auto model = sample_model();
  store.reset();
  store = opened(dir, {.wait_for_lock = std::chrono::milliseconds(40)});
  const auto first = store->add_enrolment(NewSubject{"Ada"}, sample_enrolment(model));
  ASSERT_TRUE(first);
  const SubjectId ada = store->enrolment(*first)->subject;
  NewEnrolment renewed = sample_enrolment(model);
  renewed.renews = true;
  const auto log_bytes = [&] { return std::filesystem::file_size(dir / "relievo.db-wal"); };
  {
    const auto reader = opened(dir, {.mode = OpenMode::ReadOnly});
    ASSERT_TRUE(reader->for_each_subject(Store::Opened::Names, [&](Subject&, const Consent*) -> Result<void> {
      const auto again = store->add_enrolment(ada, renewed);
      EXPECT_TRUE(again) << again.error().what.view();
      return {};
    }));
    EXPECT_EQ(store->enrolments(ada)->size(), 1U);
    EXPECT_GT(log_bytes(), 0U) << "the reader was no hindrance: this shows nothing";
  }
  ASSERT_TRUE(store->set_setting("language", "de"));
  EXPECT_EQ(log_bytes(), 0U);
}

TEST_F(SqliteStoreVerbs, ACheckThatNobodyWaitsForEnds) {
  for (int i = 0; i < 20; ++i)
    ASSERT_TRUE(store->add_enrolment(NewSubject{"Ada"}, sample_enrolment(sample_model())));
  std::atomic<bool> stop{true};
  EXPECT_EQ(code_of(store->check(stop)), Errc::Cancelled);
  stop = false;
  EXPECT_TRUE(store->check(stop));
  EXPECT_TRUE(store->subjects({}));
}

TEST_F(SqliteStoreVerbs, OneWriterAtATimeAnyReaders) {
  ASSERT_TRUE(store->add_subject({"Ada"}));
  const test::StillClock clock;
  const auto second = open_sqlite_store(dir, clock, {.wait_for_lock = std::chrono::milliseconds(40)});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Timeout);
  EXPECT_NE(second.error().what.view().find("another program"), std::string_view::npos);
  {
    const auto reader = opened(dir, {.mode = OpenMode::ReadOnly});
    EXPECT_EQ(reader->subjects({})->size(), 1u);
    EXPECT_EQ(code_of(reader->add_subject({"Bob"})), Errc::InvalidState);
    EXPECT_EQ(code_of(reader->erase_subject(SubjectId{1})), Errc::InvalidState);
    ASSERT_TRUE(store->add_subject({"Bob"}));
    EXPECT_EQ(reader->subjects({})->size(), 2u);
  }
  store.reset();
  EXPECT_TRUE(open_sqlite_store(dir, clock));
}

TEST(SqliteStoreOpening, SaysWhatIsWrongWithThePlace) {
  const relievo::test::TemporaryFolder folder;
  const test::StillClock clock;
  EXPECT_EQ(code_of(open_sqlite_store(folder / "none", clock, {.mode = OpenMode::ReadOnly})), Errc::NotFound);
  relievo::test::write_text(folder / "file", "x");
  EXPECT_EQ(code_of(open_sqlite_store(folder / "file", clock)), Errc::InvalidInput);
  EXPECT_TRUE(open_sqlite_store(folder / "deep/er", clock));
  std::filesystem::create_directory_symlink(folder / "deep", folder / "link");
  EXPECT_TRUE(open_sqlite_store(folder / "link/er", clock)) << "a link on the way is the caller's business";
}

}  // namespace
}  // namespace relievo::storage
