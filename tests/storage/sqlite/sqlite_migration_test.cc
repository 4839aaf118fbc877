// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Migrations, and files that are not what they should be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "storage/byte_order.h"
#include "storage/calibration_record.h"
#include "storage/model_blob.h"
#include "storage/record.h"
#include "storage/schema/embedded_sql.h"
#include "storage/sodium_sha256.h"
#include "storage/sqlite/sqlite_parts.h"
#include "tests/storage/raw_database.h"
#include "tests/storage/sample.h"
#include "tests/storage/store_of_before.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using relievo::test::TemporaryFolder;
using test::kLastPlain;
using test::kNoReserve;
using test::make_version;
using test::OfBefore;
using test::opened;
using test::Raw;

std::string number(std::int64_t n) { return std::to_string(n); }

std::vector<std::string> schema_of(Raw& raw) {
  auto all = raw.rows("SELECT type, name, tbl_name, sql FROM sqlite_schema ORDER BY type, name");
  for (const char* sql : {"SELECT * FROM store_info", "SELECT one, number FROM audit_end"}) {
    for (const auto& row : raw.rows(sql)) all.push_back(row);
  }
  return all;
}

Errc refusal(const std::filesystem::path& dir, OpenMode mode = OpenMode::ReadWrite) {
  const test::StillClock clock;
  const auto store = open_sqlite_store(dir, clock, {.mode = mode});
  EXPECT_FALSE(store);
  if (store) return Errc::Cancelled;
  if (store.error().code == Errc::InvalidState) {
    EXPECT_NE(store.error().what.view().find("start the kiosk on it once"), std::string_view::npos);
  }
  return store.error().code;
}

TEST(SqliteMigration, SumOfMigrationsIsTheSchema) {
  const TemporaryFolder folder;
  make_version(folder / "steps", store_version());
  opened(folder / "fresh");
  Raw steps(folder / "steps/relievo.db"), fresh(folder / "fresh/relievo.db");
  EXPECT_EQ(schema_of(steps), schema_of(fresh));
  EXPECT_EQ(fresh.rows("PRAGMA user_version"), steps.rows("PRAGMA user_version"));
  EXPECT_EQ(fresh.rows("PRAGMA application_id"), steps.rows("PRAGMA application_id"));
  for (const auto& sql :
       fresh.rows("SELECT sql FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%'")) {
    EXPECT_NE(sql.find("STRICT"), std::string::npos) << sql;
  }
}

TEST(SqliteMigration, EveryOlderVersionIsBroughtUpAndSealed) {
  for (std::int64_t version = 1; version <= kLastPlain; ++version) {
    const TemporaryFolder folder;
    const auto dir = folder / "store";
    make_version(dir, version);
    Raw(dir / "relievo.db")
        .run("INSERT INTO subject (created_at_ms, name) VALUES (1, x'416461204c6f76656c616365')");
    if (version == kLastPlain) Raw(dir / "relievo.db").run("UPDATE subject SET receipt = 77");
    EXPECT_EQ(refusal(dir, OpenMode::ReadOnly), Errc::InvalidState);
    auto store = opened(dir);
    ASSERT_TRUE(store);
    EXPECT_EQ(store->subjects({})->front().name, "Ada Lovelace");
    EXPECT_EQ(*store->last_added_at(), from_ms(1)) << "no line of the log says when";
    const std::int64_t receipt = store->subjects({})->front().receipt;
    EXPECT_GE(receipt, kLeastReceipt) << "who came before receipts were drawn has one now";
    EXPECT_LE(receipt, kMostReceipt);
    EXPECT_EQ(store->subjects({.receipt = receipt})->size(), 1U);
    EXPECT_NE(store->subject(*store->add_subject({"Bob"}))->receipt, receipt);
    EXPECT_TRUE(store->set_setting("language", "de"));
    EXPECT_TRUE(store->check());
    EXPECT_FALSE(std::filesystem::exists(dir / ("relievo.db.before-" + number(version + 1))))
        << "a copy in which people stand in the clear";
    EXPECT_EQ(test::all_bytes(dir).find("Ada Lovelace"), std::string::npos);
    EXPECT_TRUE(store->erase_subject(SubjectId{1}));
  }
}

// What `from` holds, in the tables as that version had them, with the columns that it had.
void set_back(const std::filesystem::path& from, const std::filesystem::path& dir, std::int64_t version) {
  make_version(dir, version);
  for (const auto& entry : std::filesystem::directory_iterator(from))
    if (entry.path().extension() == ".key") std::filesystem::copy(entry.path(), dir);
  Raw raw(dir / "relievo.db");
  const std::string tables = "SELECT name FROM sqlite_schema WHERE type = 'table'";
  raw.run("ATTACH '" + (from / "relievo.db").string() + "' AS today");
  for (std::string table : raw.rows(tables)) {
    table.pop_back();  // the bar behind each value
    std::string columns;
    for (const std::string& column : raw.rows("SELECT name FROM pragma_table_info('" + table + "')"))
      columns += (columns.empty() ? "" : ", ") + column.substr(0, column.size() - 1);
    raw.run("DELETE FROM main." + table + "; INSERT INTO main." + table + " (" + columns + ") SELECT " +
            columns + " FROM today." + table);
  }
  raw.run("UPDATE store_info SET compatible_version = " + number(version));
}

// From the first version that is sealed; the last one shows that `set_back` loses nothing.
TEST(SqliteMigration, EverySealedVersionIsBroughtUpWithAllThatItHolds) {
  for (std::int64_t version = 8; version <= store_version(); ++version) {
    const TemporaryFolder folder;
    const auto model = test::sample_model(5);
    {
      const auto today = opened(folder / "today", kNoReserve);
      ASSERT_TRUE(today->add_enrolment(NewSubject{"Ada Lovelace"}, test::sample_enrolment(model)));
      ASSERT_TRUE(today->set_setting("language", "de"));
      ASSERT_TRUE(today->save_calibration(test::sample_calibration(), "a note"));
    }
    const auto dir = folder / "store";
    set_back(folder / "today", dir, version);
    if (version == 8) test::set_log_back_to_8(dir);
    const auto store = opened(dir, kNoReserve);
    ASSERT_TRUE(store) << version;
    const auto copy = dir / ("relievo.db.before-" + number(version + 1));
    EXPECT_EQ(std::filesystem::exists(copy), version < store_version());
    EXPECT_TRUE(store->check()) << version;
    EXPECT_EQ(store->subjects({})->front().name, "Ada Lovelace");
    const auto kept = store->load_model(EnrolmentId{1}, std::pmr::new_delete_resource());
    ASSERT_TRUE(kept);
    EXPECT_EQ(*encode_model(*kept), *encode_model(model));
    EXPECT_EQ(*store->setting("language"), "de");
    EXPECT_EQ(store->calibrations()->front().note, "a note");
    EXPECT_TRUE(store->erase_subject(SubjectId{1}));
    EXPECT_FALSE(std::filesystem::exists(copy)) << "the person is in it";
  }
}

TEST(SqliteMigration, AFullStoreOfBeforeIsSealedToTheLastPage) {
  const TemporaryFolder folder;
  const OfBefore before(folder / "store", 230);  // more than one part
  EXPECT_EQ(before.readable(), static_cast<long>(before.traces.size())) << "the search finds what is there";
  auto store = opened(folder / "store", kNoReserve);
  ASSERT_TRUE(store);
  before.judge(*store, "open");
  store.reset();
  EXPECT_EQ(before.readable(), 0) << "closed";
  before.judge(*opened(folder / "store", kNoReserve), "opened again");
}

TEST(SqliteMigration, ABrokenLogStaysBroken) {
  const TemporaryFolder folder;
  const OfBefore before(folder.path(), 1);
  Raw(folder / "relievo.db").run("UPDATE audit SET detail = 'another detail'");
  const auto checked = opened(folder.path())->check();
  ASSERT_FALSE(checked) << "to seal is not to mend";
  EXPECT_EQ(checked.error().code, Errc::StoreCorrupt);
}

TEST(SqliteMigration, ABrokenLogOfVersion8StaysBroken) {
  for (const char* sql : {"UPDATE audit SET at_ms = 1 WHERE number = 2", "DELETE FROM audit WHERE number = 3",
                          "UPDATE audit_end SET number = 2",
                          "DELETE FROM audit; UPDATE audit_end SET number = 0, hash = zeroblob(32)"}) {
    const TemporaryFolder folder;
    ASSERT_TRUE(opened(folder / "today", kNoReserve)
                    ->add_enrolment(NewSubject{"Ada"}, test::sample_enrolment(test::sample_model(5))));
    ASSERT_TRUE(opened(folder / "today", kNoReserve)->set_setting("language", "de"));
    const auto dir = folder / "store";
    set_back(folder / "today", dir, 8);
    test::set_log_back_to_8(dir);
    Raw(dir / "relievo.db").run(sql);
    const auto checked = opened(dir, kNoReserve)->check();
    ASSERT_FALSE(checked) << sql;
    EXPECT_EQ(checked.error().code, Errc::StoreCorrupt);
  }
}

TEST(SqliteMigration, CalibrationsOfBeforeAreReadAndNewOnesJoinThem) {
  const TemporaryFolder folder;
  make_version(folder.path(), 2);
  auto calibration = test::sample_calibration();
  calibration.revision = 1;
  std::string hex;
  for (const std::byte b : encode_calibration(calibration, {})) {
    constexpr char kDigits[] = "0123456789abcdef";
    hex += {kDigits[std::to_integer<int>(b) >> 4], kDigits[std::to_integer<int>(b) & 15]};
  }
  Raw(folder / "relievo.db")
      .run("INSERT INTO calibration (created_at_ms, note, record, active) VALUES (1, 'old', x'" + hex +
           "', 1)");
  const auto store = opened(folder.path());
  ASSERT_TRUE(store);
  EXPECT_EQ(store->active_calibration()->rms_px, calibration.rms_px);
  ASSERT_EQ(*store->save_calibration(calibration, "new"), 2u);
  EXPECT_TRUE(store->check());
  EXPECT_EQ(store->calibrations()->size(), 2u);
}

TEST(SqliteMigration, AFailedMigrationChangesNothing) {
  const TemporaryFolder folder;
  make_version(folder.path(), 1);
  Raw(folder / "relievo.db").run("CREATE TABLE audit_end (in_the_way)");
  EXPECT_EQ(refusal(folder.path()), Errc::LibraryFailed);
  Raw raw(folder / "relievo.db");
  EXPECT_EQ(raw.rows("PRAGMA user_version"), std::vector<std::string>{"1|"});
  EXPECT_TRUE(raw.rows("SELECT 1 FROM sqlite_schema WHERE name = 'audit'").empty());
}

TEST(SqliteMigration, ANewerStoreIsLeftUntouched) {
  const TemporaryFolder folder;
  opened(folder.path());
  Raw(folder / "relievo.db")
      .run("UPDATE store_info SET compatible_version = " + number(store_version() + 1) +
           "; PRAGMA user_version = " + number(store_version() + 1));
  const auto before = relievo::test::read_text(folder / "relievo.db");
  EXPECT_EQ(refusal(folder.path()), Errc::StoreNewer);
  EXPECT_EQ(refusal(folder.path(), OpenMode::ReadOnly), Errc::StoreNewer);
  EXPECT_TRUE(before == relievo::test::read_text(folder / "relievo.db"));
}

TEST(SqliteMigration, ANewerButCompatibleStoreIsUsed) {
  const TemporaryFolder folder;
  opened(folder.path());
  Raw(folder / "relievo.db").run("PRAGMA user_version = " + number(store_version() + 5));
  const auto store = opened(folder.path());
  ASSERT_TRUE(store);
  EXPECT_TRUE(store->add_subject({"Ada"}));
  EXPECT_EQ(Raw(folder / "relievo.db").rows("PRAGMA user_version"),
            std::vector<std::string>{number(store_version() + 5) + "|"});
}

TEST(SqliteMigration, AnotherProgramsDatabaseIsLeftAlone) {
  const TemporaryFolder folder;
  Raw(folder / "relievo.db").run("CREATE TABLE theirs (x)");
  EXPECT_EQ(refusal(folder.path()), Errc::InvalidInput);
  EXPECT_EQ(Raw(folder / "relievo.db").rows("SELECT name FROM sqlite_schema"),
            std::vector<std::string>{"theirs|"});
}

// The audit log is whole, or check() says so.
TEST(SqliteAudit, FindsEveryEditDropSwapAndCut) {
  const std::map<std::string, std::string> tampering = {
      {"edited", "UPDATE audit SET detail = x'78' WHERE number = 3"},
      {"detail of another",
       "UPDATE audit SET detail = (SELECT detail FROM audit WHERE number = 2) WHERE number = 3"},
      {"redated", "UPDATE audit SET at_ms = at_ms + 1 WHERE number = 3"},
      {"dropped", "DELETE FROM audit WHERE number = 3"},
      {"first dropped", "DELETE FROM audit WHERE number = 1"},
      {"tail cut", "DELETE FROM audit WHERE number >= 4"},
      {"all cut", "DELETE FROM audit"},
      {"swapped",
       "UPDATE audit SET number = 99 WHERE number = 2; UPDATE audit SET number = 2 WHERE number = 3; "
       "UPDATE audit SET number = 3 WHERE number = 99"},
      {"letter moved", "UPDATE audit SET what = what || 'a', detail = substr(detail, 2) WHERE number = 3"},
      {"end moved back", "UPDATE audit_end SET number = 3"},
      {"end gone", "DELETE FROM audit_end"},
  };
  for (const auto& [name, sql] : tampering) {
    const TemporaryFolder folder;
    {
      const auto store = opened(folder.path());
      for (const char* detail : {"alpha", "adam", "abel", "anna", "abba"})
        ASSERT_TRUE(store->append_audit({"sign-in", {}, detail}));
      ASSERT_TRUE(store->check());
    }
    Raw(folder / "relievo.db").run(sql);
    const auto checked = opened(folder.path())->check();
    ASSERT_FALSE(checked) << name;
    EXPECT_EQ(checked.error().code, Errc::StoreCorrupt) << name;
  }
}

TEST(SqliteDamage, ChecksumsSpeakWhereSqliteIsContent) {
  const TemporaryFolder folder;
  const auto model = test::sample_model(6);
  {
    const auto store = opened(folder.path());
    ASSERT_TRUE(store->save_calibration(test::sample_calibration(), "rig"));
    ASSERT_TRUE(store->add_enrolment(NewSubject{"Ada"}, test::sample_enrolment(model)));
  }
  Raw(folder / "relievo.db")
      .run("UPDATE model SET bytes = CAST(substr(bytes, 1, 500) || x'00' || substr(bytes, 502) AS BLOB)");
  {
    const auto store = opened(folder.path());
    const auto loaded = store->load_model(EnrolmentId{1}, std::pmr::new_delete_resource());
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().code, Errc::StoreCorrupt);
    ASSERT_FALSE(store->check());
    EXPECT_TRUE(store->active_calibration());
  }
  Raw(folder / "relievo.db").run("UPDATE calibration SET record = substr(record, 1, 100)");
  const auto calibration = opened(folder.path())->active_calibration();
  ASSERT_FALSE(calibration);
  EXPECT_EQ(calibration.error().code, Errc::StoreCorrupt);
}

}  // namespace
}  // namespace relievo::storage
