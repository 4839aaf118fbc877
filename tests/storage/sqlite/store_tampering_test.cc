// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Somebody who may write the store's folder and has no key; and root, who works in another user's.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "storage/sqlite/sqlite_parts.h"
#include "tests/storage/raw_database.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;
using relievo::test::TemporaryFolder;
using test::code_of;
using test::kNoReserve;
using test::opened;
using test::Raw;

const test::StillClock kSameTime;

// Three people, the second erased; the third has two enrolments.
void fill_with_three(const fs::path& dir) {
  const auto store = opened(dir, kNoReserve);
  const auto model = test::sample_model(6);
  for (const char* name : {"Ada", "Bob", "Eva"})
    ASSERT_TRUE(store->add_enrolment(NewSubject{name}, test::sample_enrolment(model)));
  ASSERT_TRUE(store->add_enrolment(SubjectId{3}, test::sample_enrolment(model)));
  ASSERT_TRUE(store->erase_subject(SubjectId{2}));
  ASSERT_TRUE(store->check());
}

// Where check() says that something is wrong, or nothing.
std::string wrong_place(const fs::path& dir) {
  const auto store = open_sqlite_store(dir, kSameTime, kNoReserve);
  if (!store) return "does not open: " + std::string(store.error().what.view());
  const auto checked = (*store)->check();
  if (checked) return "";
  EXPECT_EQ(checked.error().code, Errc::StoreCorrupt);
  EXPECT_NE(checked.error().what.view().find("restore a copy"), std::string_view::npos) << "the way on";
  return std::string(checked.error().where());
}

TEST(StoreTampering, ALogOfTodayDoesNotPassForAnOlderOne) {
  const TemporaryFolder folder;
  const auto good = folder / "good";
  fill_with_three(good);
  const std::string cut = "DELETE FROM audit WHERE number > 4;";
  const std::string older = "UPDATE store_info SET compatible_version = 8; PRAGMA user_version = 8;";
  const std::string as_line =
      "UPDATE audit_end SET (number, hash) = (SELECT number, hash FROM audit ORDER BY "
      "number DESC LIMIT 1);";
  const std::string empty = "DELETE FROM audit; UPDATE audit_end SET number = 0, hash = zeroblob(32);";
  for (const auto& sql : {cut + as_line, cut + as_line + older, empty, empty + older}) {
    const auto dir = folder / "bad";
    fs::copy(good, dir);
    Raw(dir / "relievo.db").run(sql);
    EXPECT_EQ(wrong_place(dir), fs::canonical(dir / "relievo.db")) << sql;
    // What is written on does not mend it.
    {
      const auto store = opened(dir, kNoReserve);
      ASSERT_TRUE(store->append_audit({"sign-in", {}, ""}));
    }
    EXPECT_EQ(wrong_place(dir), fs::canonical(dir / "relievo.db")) << sql;
    fs::remove_all(dir);
  }
}

TEST(StoreTampering, WhoComesOrGoesWithoutALineIsNamed) {
  const TemporaryFolder folder;
  const auto dir = folder / "store";
  opened(dir, kNoReserve);
  // The end of the log, as somebody kept it from when there was one person.
  ASSERT_TRUE(opened(dir, kNoReserve)->add_subject({"The first"}));
  const auto kept =
      Raw(dir / "relievo.db").rows("SELECT number || ', hash = x''' || hex(hash) || '''' FROM audit_end");
  std::string end = kept.front();
  end.pop_back();
  const auto model = test::sample_model(6);
  {
    const auto store = opened(dir, kNoReserve);
    for (int i = 0; i < 2; ++i)
      ASSERT_TRUE(store->add_enrolment(NewSubject{"A later one"}, test::sample_enrolment(model)));
    ASSERT_TRUE(store->add_enrolment(SubjectId{3}, test::sample_enrolment(model)));
    auto renewed = test::sample_enrolment(model);
    renewed.renews = true;
    ASSERT_TRUE(store->add_enrolment(SubjectId{2}, renewed)) << "enrolments 2, 3 and 4 are there";
    ASSERT_TRUE(store->check());
  }
  const std::pair<std::string, std::string> attacks[] = {
      {"DELETE FROM subject WHERE id = 3", "subject 3"},
      {"DELETE FROM subject WHERE id = 1", "subject 1"},
      {"DELETE FROM enrolment WHERE id = 3", "enrolment 3"},
      {"DELETE FROM audit WHERE number > 1; UPDATE audit_end SET number = " + end, "subject 2"}};
  for (const auto& [sql, place] : attacks) {
    const auto bad = folder / "bad";
    fs::copy(dir, bad);
    Raw(bad / "relievo.db").run("PRAGMA foreign_keys = ON; " + sql);
    EXPECT_EQ(wrong_place(bad), place) << sql;
    fs::remove_all(bad);
  }
  // What is gone by an erasure is not missed, and nobody else may tell of one.
  EXPECT_TRUE(opened(dir, kNoReserve)->erase_subject(SubjectId{3}));
  EXPECT_EQ(wrong_place(dir), "");
  for (const char* what : {"subject.added", "subject.erased", "enrolment.added", "enrolment.renewed"})
    EXPECT_EQ(code_of(opened(dir, kNoReserve)->append_audit({what, SubjectId{1}, "2"})), Errc::InvalidInput);
}

TEST(StoreTampering, WhatNoMigrationMadeIsNamedAndDoesNotRun) {
  const TemporaryFolder folder;
  fill_with_three(folder / "good");
  const auto copy = [&](const char* name, const char* sql) {
    fs::copy(folder / "good", folder / name);
    Raw(folder / name / "relievo.db").run(sql);
    return folder / name;
  };
  const auto trap =
      copy("trap",
           "CREATE TABLE stash (s BLOB); CREATE TRIGGER tr AFTER INSERT ON audit WHEN new.what = "
           "'subject.erased' BEGIN INSERT INTO stash SELECT slots FROM subject_key; END");
  EXPECT_TRUE(opened(trap, kNoReserve)->erase_subject(SubjectId{3}));
  EXPECT_TRUE(Raw(trap / "relievo.db").rows("SELECT 1 FROM stash").empty()) << "a wrapped key is kept";
  EXPECT_TRUE(Raw(trap / "relievo.db").rows("SELECT 1 FROM enrolment WHERE subject_id = 3").empty());
  EXPECT_EQ(wrong_place(trap), "table stash");
  EXPECT_EQ(wrong_place(copy("trigger", "CREATE TRIGGER tr AFTER INSERT ON audit BEGIN SELECT 1; END")),
            "trigger tr");
  EXPECT_EQ(wrong_place(copy("view", "CREATE VIEW v AS SELECT * FROM subject")), "view v");
  EXPECT_EQ(wrong_place(copy("index", "DROP INDEX subject_of_code")), "index subject_of_code");
  EXPECT_EQ(wrong_place(folder / "good"), "");
}

// Who shows or exports them is told that something is missing, not that nobody was ever photographed.
TEST(StoreTampering, ARecordThatHasLostAPartIsNotOneWithoutAPortrait) {
  const TemporaryFolder folder;
  fill_with_three(folder / "good");
  for (const char* table : {"consent", "model"}) {
    const auto dir = folder / table;
    fs::copy(folder / "good", dir);
    Raw(dir / "relievo.db").run(std::string("DELETE FROM ") + table + " WHERE enrolment_id = 3");
    auto store = opened(dir, kNoReserve);
    EXPECT_EQ(code_of(store->enrolments(SubjectId{3})), Errc::StoreCorrupt) << table;
    EXPECT_EQ(code_of(store->enrolment(EnrolmentId{3})), Errc::StoreCorrupt) << table;
    EXPECT_EQ(code_of(store->person(SubjectId{3})), Errc::StoreCorrupt) << table;
    EXPECT_EQ(store->enrolments(SubjectId{1})->size(), 1U) << table;
    store.reset();
    EXPECT_EQ(wrong_place(dir), "enrolment 3");
  }
}

TEST(StoreTampering, SettingsThatStandThereTwiceAreRefused) {
  const TemporaryFolder folder;
  const auto dir = folder / "store";
  ASSERT_TRUE(opened(dir, kNoReserve)->set_setting("language", "eo"));
  Raw(dir / "relievo.db").run("INSERT INTO settings SELECT * FROM settings");
  EXPECT_EQ(wrong_place(dir), "settings, record");
  EXPECT_EQ(code_of(opened(dir, kNoReserve)->setting("language")), Errc::StoreCorrupt);
}

// A list that cannot be read is not an empty one: an older copy would bring everybody back.
TEST(StoreTampering, AListOfTheErasedThatCannotBeReadIsAnError) {
  const TemporaryFolder folder;
  fill_with_three(folder / "good");
  const auto with = [&](const char* name, const auto& put) {
    fs::copy(folder / "good", folder / name);
    const auto list = folder / name / "relievo.erased";
    fs::remove(list);
    put(list);
    const auto store = open_sqlite_store(folder / name, kSameTime, kNoReserve);
    return store ? std::string() : std::string(store.error().where());
  };
  const auto list_of = [&](const char* name) {
    return fs::canonical(folder.path()) / name / "relievo.erased";
  };
  EXPECT_EQ(with("none", [](const fs::path&) {}), "");
  EXPECT_EQ(with("empty", [](const fs::path& list) { relievo::test::write_text(list, ""); }), "")
      << "as a power cut leaves it";
  EXPECT_EQ(with("folder", [](const fs::path& list) { fs::create_directory(list); }), list_of("folder"));
  EXPECT_EQ(with("pipe", [](const fs::path& list) { ::mkfifo(list.c_str(), 0600); }), list_of("pipe"));
  EXPECT_EQ(with("device", [](const fs::path& list) { fs::create_symlink("/dev/zero", list); }),
            list_of("device"));
  EXPECT_EQ(with("link",
                 [&](const fs::path& list) {
                   fs::copy(folder / "good/relievo.erased", folder / "elsewhere");
                   fs::create_symlink(folder / "elsewhere", list);
                 }),
            list_of("link"));
  // Nor can it be written: they are erased, and whoever erased them is told.
  const auto store = opened(folder / "none", kNoReserve);
  fs::create_directory(folder / "none/relievo.erased");
  const auto erased = store->erase_subject(SubjectId{3});
  ASSERT_FALSE(erased);
  EXPECT_EQ(erased.error().what.view().find("erased; but relievo.erased"), 0U) << erased.error().what.view();
  EXPECT_EQ(code_of(store->subject(SubjectId{3})), Errc::NotFound);
}

TEST(StoreTampering, NoPipeHoldsAnybodyUp) {
  const TemporaryFolder folder;
  fill_with_three(folder / "store");
  fs::remove(folder / "store/relievo.reserve");
  ASSERT_EQ(::mkfifo((folder / "store/relievo.reserve").c_str(), 0600), 0);
  EXPECT_TRUE(opened(folder / "store", {.reserve_bytes = 100'000})->check());
  fs::remove(folder / "store/relievo.key");
  ASSERT_EQ(::mkfifo((folder / "store/relievo.key").c_str(), 0600), 0);
  EXPECT_EQ(code_of(open_sqlite_store(folder / "store", kSameTime, kNoReserve)), Errc::InvalidInput);
}

// Else the kiosk could neither open its store nor remember whom it has erased.
TEST(StoreTampering, WhatRootMakesStaysTheOwners) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root makes files for others";
  constexpr ::uid_t kOwner = 12'345;
  const TemporaryFolder folder;
  const auto dir = folder / "store";
  fs::create_directory(dir);
  ASSERT_EQ(::chown(dir.c_str(), kOwner, kOwner), 0);
  {
    const auto store = opened(dir, {.reserve_bytes = 100'000});
    ASSERT_TRUE(store->add_subject({"Ada"}));
    ASSERT_TRUE(store->erase_subject(SubjectId{1}));
  }
  relievo::test::write_text(folder / "another file of root", "x");
  fs::create_hard_link(folder / "another file of root", dir / "relievo.key.next");
  ASSERT_TRUE(keep_sqlite_store(dir, kSameTime, kNoReserve)->rekey({}));
  const auto owner = [](const fs::path& file) {
    struct stat status {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
    return status.st_uid;
  };
  for (const char* name : {"relievo.db", "relievo.lock", "relievo.reserve", "relievo.erased", "relievo.key"})
    EXPECT_EQ(owner(dir / name), kOwner) << name;
  EXPECT_EQ(owner(folder / "another file of root"), 0U);
  // A list that an older version's root made is the owner's again.
  ASSERT_EQ(::chown((dir / "relievo.erased").c_str(), 0, 0), 0);
  {
    const auto store = opened(dir, kNoReserve);
    ASSERT_TRUE(store->erase_subject(*store->add_subject({"Bob"})));
  }
  EXPECT_EQ(owner(dir / "relievo.erased"), kOwner);
  // A file of root's that is found under a name of the store's is not given away.
  fs::remove(dir / "relievo.erased");
  fs::create_hard_link(folder / "another file of root", dir / "relievo.erased");
  {
    const auto store = opened(dir, kNoReserve);
    ASSERT_TRUE(store->erase_subject(*store->add_subject({"Eva"})));
  }
  EXPECT_EQ(owner(folder / "another file of root"), 0U);
  ASSERT_TRUE(keep_sqlite_store(dir, kSameTime, kNoReserve)->rekey({.file = folder / "elsewhere.key"}));
  EXPECT_EQ(owner(folder / "elsewhere.key"), kOwner);
}

}  // namespace
}  // namespace relievo::storage
