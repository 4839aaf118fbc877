// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// People who go from one store to another, whole or not at all, and not after they were erased.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "storage/record.h"
#include "tests/storage/raw_database.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using relievo::test::TemporaryFolder;
using relievo::test::TinyDisk;
using test::code_of;
using test::kNoReserve;
using test::opened;

// Somebody with two portraits, the first made with a calibration of this store, its third.
std::unique_ptr<Store> with_ada(const std::filesystem::path& dir) {
  auto store = opened(dir, kNoReserve);
  auto calibration = test::sample_calibration();
  for (const double rms : {0.1, 0.2, 0.3}) {
    calibration.rms_px = rms;
    EXPECT_TRUE(
        store->save_calibration(calibration, "of the first store", {CalibrationGrade::Pass, 0.1, 2, 3}));
  }
  const auto one = test::sample_model(14, 1), two = test::sample_model(9, 2);
  auto first = test::sample_enrolment(one);
  first.calibration_revision = 3;
  EXPECT_TRUE(store->add_enrolment(NewSubject{"Ada Canary"}, first));
  auto second = test::sample_enrolment(two);
  second.consent = {"2026-09", "de", WallTime(std::chrono::milliseconds(1'773'000'000'001))};
  second.report_json = "{}";
  EXPECT_TRUE(store->add_enrolment(SubjectId{1}, second));
  return store;
}

// All that anybody could notice of an attempt that failed.
std::string state_of(const std::filesystem::path& dir) {
  test::Raw raw(dir / "relievo.db");
  std::string all;
  for (const char* table : {"subject", "enrolment", "consent", "model", "calibration", "audit", "audit_end"})
    for (const std::string& row : raw.rows("SELECT count(*), max(rowid) FROM " + std::string(table)))
      all += row + "\n";
  for (const std::string& row : raw.rows("SELECT hex(slots) FROM subject_key")) all += row;
  return all;
}

TEST(Persons, GoFromOneStoreToAnotherWithoutLoss) {
  const TemporaryFolder folder;
  const auto from = with_ada(folder / "from"), to = opened(folder / "to", kNoReserve);
  ASSERT_TRUE(to->add_subject({"Somebody else"}));
  const auto gone = from->person(SubjectId{1});
  ASSERT_TRUE(gone);
  const auto read = decode_person(encode_person(*gone));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, *gone);
  const auto id = to->add_person(*read);
  ASSERT_TRUE(id) << id.error().what.view();
  EXPECT_EQ(*id, SubjectId{2});
  EXPECT_EQ(encode_person(*to->person(*id)), encode_person(*gone)) << "byte for byte";
  ASSERT_TRUE(to->check());
  const auto there = to->enrolments(*id), here = from->enrolments(SubjectId{1});
  ASSERT_EQ(there->size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Enrolment &a = (*there)[i], &b = (*here)[i];
    EXPECT_EQ(a.created_at, b.created_at);
    EXPECT_EQ(a.consent, b.consent);
    EXPECT_EQ(a.algorithms, b.algorithms);
    EXPECT_EQ(a.report_json, b.report_json);
    EXPECT_TRUE(test::identical(*from->load_model(b.id, std::pmr::new_delete_resource()),
                                *to->load_model(a.id, std::pmr::new_delete_resource())));
  }
  // By the code they were given, with the calibration their picture was measured with; none comes into use.
  EXPECT_EQ(to->subjects({.receipt = gone->receipt})->front().name, "Ada Canary");
  EXPECT_EQ(there->front().calibration_revision, 1U);
  EXPECT_EQ(to->calibration(1)->rms_px, 0.3);
  EXPECT_EQ(to->calibrations()->front().figures.grade, CalibrationGrade::Pass);
  EXPECT_EQ(there->back().calibration_revision, 0U);
  EXPECT_EQ(code_of(to->active_calibration()), Errc::NotCalibrated);
  EXPECT_EQ(code_of(to->add_person(*read)), Errc::InvalidInput) << "twice";
  EXPECT_EQ(to->subjects({})->size(), 2U);
}

TEST(Persons, OfAStoreWhoseClockRanAheadCameInWhenThisOneSays) {
  const TemporaryFolder folder;
  test::StillClock clock;
  const auto opened_to = open_sqlite_store(folder / "to", clock, kNoReserve);
  ASSERT_TRUE(opened_to);
  Store& to = **opened_to;
  EXPECT_EQ(*to.last_added_at(), WallTime());
  auto ada = *with_ada(folder / "from")->person(SubjectId{1});
  ada.created_at += std::chrono::years(1);
  for (PersonRecord::Portrait& portrait : ada.portraits) portrait.created_at += std::chrono::years(1);
  const auto id = to.add_person(ada);
  ASSERT_TRUE(id);
  const auto now = [&clock] { return std::chrono::floor<std::chrono::milliseconds>(clock.at); };
  const WallTime first = now();
  EXPECT_EQ(*to.last_added_at(), first);
  clock.at += std::chrono::hours(1);
  ASSERT_TRUE(to.add_enrolment(*id, test::sample_enrolment(test::sample_model())));
  EXPECT_EQ(*to.last_added_at(), now());
  clock.at += std::chrono::hours(1);
  const auto grace = to.add_subject({"Grace"});
  ASSERT_TRUE(grace);
  EXPECT_EQ(*to.last_added_at(), now());
  ASSERT_TRUE(to.erase_subject(*grace));
  EXPECT_EQ(*to.last_added_at(), first + std::chrono::hours(1)) << "who is erased counts no more";
}

TEST(Persons, AreRefusedAsAWholeWhereSomethingCannotBe) {
  const TemporaryFolder folder;
  const auto good = *with_ada(folder / "from")->person(SubjectId{1});
  {
    const auto made = opened(folder / "to", kNoReserve);
    ASSERT_TRUE(made->add_subject({"Somebody else"}));
  }
  const std::string before = state_of(folder / "to");
  const auto refused = [&](const char* what, const std::function<void(PersonRecord&)>& spoil) {
    PersonRecord person = good;
    spoil(person);
    EXPECT_FALSE(opened(folder / "to", kNoReserve)->add_person(person)) << what;
    EXPECT_EQ(state_of(folder / "to"), before) << what;
  };
  refused("no name", [](PersonRecord& p) { p.name.clear(); });
  refused("no code", [](PersonRecord& p) { p.receipt = 0; });
  refused("a code too large", [](PersonRecord& p) { p.receipt = 1'000'000'000'000; });
  refused("no consent", [](PersonRecord& p) { p.portraits[1].consent.wording.clear(); });
  refused("a text too long", [](PersonRecord& p) { p.portraits[1].report_json.resize(kMaxTextBytes + 1); });
  refused("no model", [](PersonRecord& p) { p.portraits[1].model.clear(); });
  refused("a model cut", [](PersonRecord& p) { p.portraits[1].model.pop_back(); });
  refused("a calibration changed", [](PersonRecord& p) { p.portraits[0].calibration[40] ^= std::byte{1}; });
  EXPECT_TRUE(opened(folder / "to", kNoReserve)->add_person(good));
}

TEST(Persons, BytesThatEndTooEarlyOrTooLateAreNone) {
  const TemporaryFolder folder;
  auto bytes = encode_person(*with_ada(folder / "from")->person(SubjectId{1}));
  for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 37)
    EXPECT_EQ(code_of(decode_person(std::span(bytes).first(size))), Errc::InvalidInput) << size;
  bytes.push_back({});
  EXPECT_EQ(code_of(decode_person(bytes)), Errc::InvalidInput);
  bytes.pop_back();
  bytes[6] = std::byte{9};
  EXPECT_EQ(code_of(decode_person(bytes)), Errc::StoreNewer);
}

TEST(Persons, NoCopyBringsBackWhoWasErased) {
  const TemporaryFolder folder;
  const auto dir = folder / "store";
  PersonRecord copy;
  {
    const auto store = with_ada(dir);
    copy = *store->person(SubjectId{1});
    ASSERT_TRUE(store->erase_subject(SubjectId{1}));
    EXPECT_EQ(code_of(store->add_person(copy)), Errc::InvalidInput);
    EXPECT_TRUE(store->check());
  }
  // A copy of the store made since knows it on another board, too.
  std::filesystem::create_directory(folder / "board2");
  std::filesystem::copy(dir / "relievo.db", folder / "board2/relievo.db");
  std::filesystem::copy(dir / "relievo.key", folder / "board2/relievo.key");
  const std::string before = state_of(folder / "board2");
  const auto told = opened(folder / "board2", kNoReserve)->add_person(copy);
  ASSERT_FALSE(told);
  EXPECT_NE(told.error().what.view().find("was erased from this store"), std::string_view::npos);
  EXPECT_EQ(state_of(folder / "board2"), before);
  // Whoever remembers only by the list beside the store: an older version wrote no more.
  test::Raw(dir / "relievo.db").run("UPDATE audit SET detail = x'' WHERE what = 'subject.erased'");
  EXPECT_EQ(code_of(opened(dir, kNoReserve)->add_person(copy)), Errc::InvalidInput);
  // What is remembered names nobody.
  const std::string all = test::all_bytes(dir);
  EXPECT_EQ(all.find("Canary"), std::string::npos);
  EXPECT_EQ(all.find(std::to_string(copy.receipt)), std::string::npos);
  copy.receipt = copy.receipt % 1000 + 1;
  EXPECT_TRUE(opened(dir, kNoReserve)->add_person(copy)) << "somebody else";
}

TEST(Persons, WhoseErasureFailedIsNotCalledErased) {
  const TemporaryFolder folder;
  const auto store = with_ada(folder / "store");
  PersonRecord copy = *store->person(SubjectId{1});
  const auto why_not = [&] {
    const auto told = store->add_person(copy);
    EXPECT_FALSE(told);
    return told ? std::string() : std::string(told.error().what.view());
  };
  test::Raw(folder / "store/relievo.db")
      .run("CREATE UNIQUE INDEX no ON audit (subject_id) WHERE what IN ('subject.added', 'subject.erased')");
  ASSERT_FALSE(store->erase_subject(SubjectId{1}));
  ASSERT_TRUE(store->subject(SubjectId{1}));
  EXPECT_NE(why_not().find("is in the store"), std::string::npos);
  test::Raw(folder / "store/relievo.db").run("DROP INDEX no");
  ASSERT_TRUE(store->erase_subject(SubjectId{1}));
  EXPECT_NE(why_not().find("was erased from this store"), std::string::npos);
}

TEST(Persons, OnAFullDiskNobodyIsHalfTakenIn) {
  const TinyDisk disk(3'000'000);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  const TemporaryFolder folder;
  PersonRecord person;
  {
    const auto from = with_ada(folder / "from");
    person = *from->person(SubjectId{1});
    const auto large = test::sample_model(100, 3);
    ASSERT_TRUE(from->add_enrolment(SubjectId{1}, test::sample_enrolment(large)));
    person = *from->person(SubjectId{1});
  }
  ASSERT_TRUE(opened(disk.path() / "store", kNoReserve)->add_subject({"Somebody else"}));
  const std::string before = state_of(disk.path() / "store");
  {
    std::ofstream junk(disk.path() / "junk", std::ios::binary);
    for (const std::string block(4096, 'x'); junk.flush(); junk.write(block.data(), 4096)) continue;
  }
  std::filesystem::resize_file(disk.path() / "junk",
                               std::filesystem::file_size(disk.path() / "junk") - 200'000);
  EXPECT_EQ(code_of(opened(disk.path() / "store", kNoReserve)->add_person(person)), Errc::MediaFull);
  EXPECT_EQ(state_of(disk.path() / "store"), before);
  std::filesystem::remove(disk.path() / "junk");
  EXPECT_TRUE(opened(disk.path() / "store", kNoReserve)->add_person(person));
  EXPECT_TRUE(opened(disk.path() / "store", kNoReserve)->check());
}

// A new column is known here only once somebody has said whether it goes along (person_record.cc).
TEST(Persons, EveryColumnIsCarriedOrBelongsToTheStoreAlone) {
  const TemporaryFolder folder;
  { const auto store = with_ada(folder.path()); }
  test::Raw raw(folder / "relievo.db");
  const auto columns = [&](const std::string& table) {
    std::string all;
    for (const std::string& name : raw.rows("SELECT name FROM pragma_table_info('" + table + "')"))
      all += name.substr(0, name.find('|')) + " ";
    return all;
  };
  EXPECT_EQ(columns("subject"), "id created_at_ms name key_id name_hash code code_hash ");
  EXPECT_EQ(columns("enrolment"), "id subject_id created_at_ms calibration_revision record ");
  EXPECT_EQ(columns("consent"), "enrolment_id record ");
  EXPECT_EQ(columns("model"), "enrolment_id key_id nonce bytes ");
}

}  // namespace
}  // namespace relievo::storage
