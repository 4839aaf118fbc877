// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What somebody finds who has the store's files and not its key; and what comes of it when they change
// something.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>

#include "storage/sqlite/sqlite_keys.h"
#include "tests/storage/raw_database.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using relievo::test::TemporaryFolder;
using test::kNoReserve;
using test::opened;
using test::Raw;

std::string hex_of(std::string_view bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (const char c : bytes) hex += {kDigits[(c >> 4) & 15], kDigits[c & 15]};
  return hex;
}
std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Two people of everything, so that each value has one to be exchanged for.
void fill(Store& store) {
  ASSERT_TRUE(store.save_calibration(test::sample_calibration(), "the note of Grete Canary"));
  ASSERT_TRUE(store.save_calibration(test::sample_calibration(), "the note of Hedy Canary"));
  for (unsigned i = 1; i <= 2; ++i) {
    const auto model = test::sample_model(60, i);
    auto enrolment = test::sample_enrolment(model);
    const std::string report = "{\"note\": \"report of Canary " + std::to_string(i) + "\"}";
    enrolment.report_json = report;
    enrolment.algorithms = "[Canary]\nalgorithms = \"refined\"\n";
    enrolment.consent.wording = "wording-canary-" + std::to_string(i);
    ASSERT_TRUE(store.add_enrolment(NewSubject{"Ada Canary " + std::to_string(i)}, enrolment));
    ASSERT_TRUE(store.append_audit({"staff.entered", {}, "detail of Canary " + std::to_string(i)}));
    ASSERT_TRUE(store.set_setting("canary.setting", "hash of a canary's PIN " + std::to_string(i)));
  }
}

TEST(StoreSealed, NothingThatTellsAPersonAndNoKeyCanBeReadInAnyFile) {
  const TemporaryFolder folder;
  std::vector<std::string> traces{"Canary", "canary", "report of", "refined"};
  auto store = opened(folder.path(), kNoReserve);
  ASSERT_TRUE(store);
  fill(*store);
  for (unsigned i = 1; i <= 2; ++i) {
    const auto model = test::sample_model(60, i);
    const auto run = [&](const auto& values, std::size_t at) {
      traces.emplace_back(reinterpret_cast<const char*>(&values[at]), 24);
    };
    for (const std::size_t at : {std::size_t{0}, model.mesh.vertices_mm.size() / 2}) {
      run(model.mesh.vertices_mm, at);
      run(model.mesh.normals, at);
    }
    run(model.texture.rgb, 300);
    run(model.texture.vertex_rgb, 600);
    const std::int64_t code = store->subject(SubjectId{i})->receipt;
    traces.push_back(std::to_string(code));
    for (const bool big : {false, true}) {  // as SQLite keeps numbers, and as we do
      std::string bytes;
      for (int byte = 0; byte < 6; ++byte) bytes += static_cast<char>(code >> (8 * (big ? 5 - byte : byte)));
      traces.push_back(bytes);
    }
  }
  // Every key there is.
  const auto keys = *StoreKeys::make(key_file(folder / "relievo.key"));
  Database database(folder / "relievo.db");
  ASSERT_TRUE(database.open(false));
  ASSERT_TRUE(keys->load(database, true));
  const auto key = [&](const SecretKey& one) {
    traces.push_back(text_of(one.bytes()));
    traces.push_back(hex_of(traces.back()));
  };
  key(keys->device());
  key(keys->chain());
  for (int i = 1; i <= 2; ++i) {
    KeySlots slots(database);
    ASSERT_TRUE(keys->take_subject_key(slots, SubjectId{i}));
    key(keys->subject());
  }
  auto appliance = *SecretKey::make();
  ASSERT_TRUE(key_file(folder / "relievo.key")->read(appliance));
  key(appliance);
  database.close();

  const auto readable = [&](const std::filesystem::path& skipped) {
    std::string found;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      if (entry.path().filename() == skipped) continue;
      const auto bytes = relievo::test::read_text(entry.path());
      for (const auto& trace : traces)
        if (bytes.find(trace) != std::string::npos)
          found += entry.path().filename().string() + ": " + trace + "\n";
    }
    return found;
  };
  EXPECT_EQ(readable("relievo.key"), "");
  EXPECT_NE(readable(""), "") << "the search finds what is there: the appliance's key, in its file";
  store.reset();
  EXPECT_EQ(readable("relievo.key"), "");
}

template <typename T>
bool fails(const Result<T>& result, Error& error) {
  if (!result) error = result.error();
  return !result;
}

// Every sealed column: one bit changed; the value of another row in its place; refused wherever it is read,
// by name.
TEST(StoreSealed, WhatIsChangedOrExchangedIsRefusedByName) {
  struct Column {
    const char *table, *key, *column;
    std::function<bool(Store&, Error&)> read;
    const char* place;  // where the error says it is
    int first;          // of two rows, the first
  };
  const auto person = [](Store& s, Error& e) { return fails(s.subject(SubjectId{1}), e); };
  const auto enrolment = [](Store& s, Error& e) { return fails(s.enrolment(EnrolmentId{1}), e); };
  const auto model = [](Store& s, Error& e) {
    return fails(s.load_model(EnrolmentId{1}, std::pmr::new_delete_resource()), e);
  };
  const std::vector<Column> columns{
      {"subject", "id", "name", person, "subject 1, name", 1},
      {"subject", "id", "code", person, "subject 1, code", 1},
      {"enrolment", "id", "record", enrolment, "enrolment 1, record", 1},
      {"consent", "enrolment_id", "record", enrolment, "consent 1, record", 1},
      {"model", "enrolment_id", "bytes", model, "model 1, bytes", 1},
      {"model", "enrolment_id", "nonce", model, "model 1, bytes", 1},
      {"calibration", "revision", "note", [](Store& s, Error& e) { return fails(s.calibrations(), e); },
       "calibration 1, note", 1},
      {"audit", "number", "detail", [](Store& s, Error& e) { return fails(s.audit(0, 100), e); },
       "audit 1, detail", 1},
      {"settings", "rowid", "record",
       [](Store& s, Error& e) { return fails(s.setting("canary.setting"), e); }, "settings", 1},
      {"encryption_key", "id", "parameters", [](Store&, Error&) { return false; }, "", 1},
  };
  const TemporaryFolder folder;
  fill(*opened(folder / "good", kNoReserve));
  for (const Column& c : columns) {
    const std::string where = std::string(" WHERE ") + c.key + " = " + std::to_string(c.first);
    const std::string value = "(SELECT " + std::string(c.column) + " FROM " + c.table;
    const std::string at = std::string("length(") + c.column + ") / 2";
    std::vector<std::pair<std::string, std::string>> attacks{
        {"a bit changed", std::string("substr(") + c.column + ", 1, " + at + ") || CASE substr(" + c.column +
                              ", 1 + " + at + ", 1) WHEN x'00' THEN x'01' ELSE x'00' END || substr(" +
                              c.column + ", 2 + " + at + ")"},
        {"a byte cut off", std::string("substr(") + c.column + ", 1, length(" + c.column + ") - 1)"},
        {"that of another row", value + " WHERE " + c.key + " <> " + std::to_string(c.first) +
                                    " AND length(" + c.column + ") > 0 LIMIT 1)"}};
    for (const auto& [attack, sql] : attacks) {
      if (std::string_view(c.table) == "settings" && attack == "that of another row")
        continue;  // there is one
      const auto dir = folder / (std::string(c.table) + c.column + attack);
      std::filesystem::copy(folder / "good", dir);
      Raw(dir / "relievo.db")
          .run("UPDATE " + std::string(c.table) + " SET " + c.column + " = CAST(" + sql + " AS BLOB)" +
               where);
      SCOPED_TRACE(std::string(c.table) + "." + c.column + ": " + attack);
      const test::StillClock clock;
      const auto store = open_sqlite_store(dir, clock, kNoReserve);
      Error error{Errc::Cancelled, "nothing"};
      if (!store) error = store.error();  // the keys themselves
      else {
        EXPECT_TRUE(c.read(**store, error));
        EXPECT_FALSE((*store)->check());
      }
      EXPECT_TRUE(error.code == Errc::StoreCorrupt || (!store && error.code == Errc::InvalidInput))
          << error.what.view();
      if (store) {
        EXPECT_NE(error.where().find(c.place), std::string_view::npos) << error.where();
      }
    }
  }
}

// Values of one person, under one key: the place alone tells them apart.
TEST(StoreSealed, AValueIsBoundToItsTableItsRowAndItsColumn) {
  const TemporaryFolder folder;
  {
    const auto store = opened(folder / "good", kNoReserve);
    const auto ada = store->add_subject({"Ada"});
    for (unsigned i = 1; i <= 2; ++i) {
      const auto model = test::sample_model(60, i);
      ASSERT_TRUE(store->add_enrolment(*ada, test::sample_enrolment(model)));
      ASSERT_TRUE(store->save_calibration(test::sample_calibration(), "note"));
    }
  }
  const auto exchange = [](const std::string& table, const std::string& columns, const std::string& key) {
    return "CREATE TABLE t AS SELECT * FROM " + table + "; UPDATE " + table + " SET (" + columns +
           ") = (SELECT " + columns + " FROM t WHERE t." + key + " <> " + table + "." + key +
           "); DROP TABLE t";
  };
  const std::pair<std::string, std::string> exchanges[] = {
      {exchange("enrolment", "record", "id"), "enrolment 1, record"},
      {exchange("consent", "record", "enrolment_id"), "consent 1, record"},
      {exchange("model", "nonce, bytes", "enrolment_id"), "model 1, bytes"},
      {exchange("calibration", "note", "revision"), "note"},
      {"UPDATE subject SET name = code, code = name", "subject 1, name"},
      {"UPDATE enrolment SET record = (SELECT record FROM consent WHERE enrolment_id = 1) WHERE id = 1",
       "enrolment 1, record"},
      {"UPDATE consent SET record = (SELECT record FROM enrolment WHERE id = 1) WHERE enrolment_id = 1",
       "consent 1, record"},
  };
  for (const auto& [sql, place] : exchanges) {
    SCOPED_TRACE(sql);
    const auto dir = folder / "bad";
    std::filesystem::copy(folder / "good", dir);
    Raw(dir / "relievo.db").run(sql);
    const auto checked = opened(dir, kNoReserve)->check();
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().code, Errc::StoreCorrupt);
    EXPECT_NE(checked.error().where().find(place), std::string_view::npos) << checked.error().where();
    std::filesystem::remove_all(dir);
  }
}

std::string slot(int id) { return std::to_string(KeySlots::kHead + 1 + id * 72); }

TEST(StoreSealed, AKeyInAnotherPersonsSlotOpensNothing) {
  const TemporaryFolder folder;
  fill(*opened(folder.path(), kNoReserve));
  Raw(folder / "relievo.db")
      .run("UPDATE subject_key SET slots = CAST(substr(slots, 1, " + slot(1) + " - 1) || substr(slots, " +
           slot(2) + ", 72) || substr(slots, " + slot(1) + ", 72) || substr(slots, " + slot(3) +
           ") AS BLOB)");
  const auto store = opened(folder.path(), kNoReserve);
  const auto read = store->subject(SubjectId{2});
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Errc::StoreCorrupt);
  EXPECT_EQ(read.error().where(), "subject_key 2, slots");
}

// Whoever exchanges what people are found by leads nobody to another's record.
TEST(StoreSealed, ACodeLeadsNobodyToAnother) {
  const TemporaryFolder folder;
  fill(*opened(folder.path(), kNoReserve));
  Raw(folder / "relievo.db")
      .run(
          "CREATE TABLE t AS SELECT id, code_hash AS c, name_hash AS n FROM subject; UPDATE subject SET code_hash = "
          "NULL; UPDATE subject SET code_hash = (SELECT c FROM t WHERE t.id <> subject.id), name_hash = (SELECT n "
          "FROM t WHERE t.id <> subject.id); DROP TABLE t");
  const auto store = opened(folder.path(), kNoReserve);
  const auto code = store->subject(SubjectId{1})->receipt;
  const auto found = store->subjects({.receipt = code});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Errc::StoreCorrupt);
  EXPECT_TRUE(store->subjects({.name = "Ada Canary 1"})->empty());
  EXPECT_FALSE(store->check());
}

TEST(StoreSealed, WhatWasOnceTrueIsRefusedLater) {
  const TemporaryFolder folder;
  fill(*opened(folder.path(), kNoReserve));
  std::filesystem::copy(folder / "relievo.db", folder / "old");
  const std::string with_old = "ATTACH '" + (folder / "old").string() + "' AS old; ";
  {
    const auto store = opened(folder.path(), kNoReserve);
    ASSERT_TRUE(store->set_setting("canary.setting", "a newer one"));
    ASSERT_TRUE(store->erase_subject(SubjectId{1}));
    ASSERT_TRUE(store->check());
  }
  // An older PIN.
  std::filesystem::copy(folder.path(), folder / "pin");
  Raw(folder / "pin/relievo.db")
      .run(with_old + "DELETE FROM settings; INSERT INTO settings SELECT * FROM old.settings");
  const auto store = opened(folder / "pin", kNoReserve);
  const auto setting = store->setting("canary.setting");
  ASSERT_FALSE(setting);
  EXPECT_EQ(setting.error().code, Errc::StoreCorrupt);
  EXPECT_EQ(setting.error().where(), "settings, record");
  EXPECT_FALSE(store->set_setting("canary.setting", "x")) << "and is not built upon";
  // Somebody erased.
  std::filesystem::copy(folder.path(), folder / "person");
  Raw(folder / "person/relievo.db")
      .run(with_old +
           "INSERT INTO subject SELECT * FROM old.subject WHERE id = 1; DELETE FROM subject_key; INSERT INTO "
           "subject_key SELECT * FROM old.subject_key");
  const auto checked = opened(folder / "person", kNoReserve)->check();
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().where(), "subject 1");
  EXPECT_NE(checked.error().what.view().find("was erased, and was put back"), std::string_view::npos);
}

// What pages may still hold of the earlier enrolments opens to nobody.
TEST(StoreSealed, WhoRenewsHasANewKeyAndTheOldOneIsGone) {
  const TemporaryFolder folder;
  const auto store = opened(folder.path(), kNoReserve);
  fill(*store);
  const auto slot_of_first = [&] {
    const auto hex = Raw(folder / "relievo.db")
                         .rows("SELECT hex(substr(slots, " + slot(1) + ", 72)) FROM subject_key")
                         .front();
    std::string bytes;
    for (std::size_t at = 0; at + 2 < hex.size(); at += 2)
      bytes += static_cast<char>(std::stoi(hex.substr(at, 2), nullptr, 16));
    return bytes;
  };
  const std::string old = slot_of_first();
  const auto before = *store->subject(SubjectId{1});
  const auto model = test::sample_model(9, 9);
  auto enrolment = test::sample_enrolment(model);
  enrolment.renews = true;
  const auto made = store->add_enrolment(SubjectId{1}, enrolment);
  ASSERT_TRUE(made);
  const auto bytes = test::all_bytes(folder.path());
  EXPECT_NE(bytes.find(slot_of_first()), std::string::npos) << "the search finds what is there";
  EXPECT_EQ(bytes.find(old), std::string::npos);
  EXPECT_EQ(store->subject(SubjectId{1})->name, before.name);
  EXPECT_EQ(store->subjects({.receipt = before.receipt})->size(), 1U);
  EXPECT_TRUE(test::identical(model, *store->load_model(*made, std::pmr::new_delete_resource())));
  EXPECT_TRUE(store->check());
}

TEST(StoreSealed, OnlyItsOwnKeyOpensAStore) {
  const TemporaryFolder folder;
  const test::StillClock clock;
  fill(*opened(folder / "store", kNoReserve));
  const auto key = folder / "store/relievo.key";
  struct stat status {};
  ASSERT_EQ(::stat(key.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  const auto refused = [&](OpenMode mode) {
    auto options = kNoReserve;
    options.mode = mode;
    const auto store = open_sqlite_store(folder / "store", clock, options);
    EXPECT_FALSE(store);
    return store ? Error{Errc::Cancelled, "it opened"} : store.error();
  };
  std::filesystem::rename(key, folder / "away");
  for (const OpenMode mode : {OpenMode::ReadWrite, OpenMode::ReadOnly}) {
    EXPECT_EQ(refused(mode).code, Errc::NotFound) << "missing";
    EXPECT_NE(refused(mode).where().find("relievo.key"), std::string_view::npos);
    EXPECT_FALSE(std::filesystem::exists(key)) << "another key would help nobody";
  }
  opened(folder / "other", kNoReserve);
  std::filesystem::copy(folder / "other/relievo.key", key);
  EXPECT_EQ(refused(OpenMode::ReadWrite).code, Errc::InvalidInput);
  EXPECT_NE(refused(OpenMode::ReadOnly).what.view().find("not the key of this store"),
            std::string_view::npos);
  for (const char* text :
       {"", "x", "0123", "zz23456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"}) {
    relievo::test::write_text(key, text);
    EXPECT_EQ(refused(OpenMode::ReadWrite).code, Errc::InvalidInput) << text;
  }
  std::filesystem::remove(key);
  std::filesystem::rename(folder / "away", key);
  ::chmod(key.c_str(), 0640);
  EXPECT_NE(refused(OpenMode::ReadWrite).what.view().find("others may read"), std::string_view::npos);
  ::chmod(key.c_str(), 0600);
  EXPECT_TRUE(opened(folder / "store", kNoReserve)->check());
}

TEST(StoreSealed, TheKeyMayLieElsewhereAndComeFromSystemd) {
  const TemporaryFolder folder;
  const test::StillClock clock;
  auto options = kNoReserve;
  options.keys = key_credential(folder / "credential");
  const auto none = open_sqlite_store(folder / "store", clock, options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Errc::Unsupported) << "who made none gets no store";
  std::filesystem::create_directory(folder / "stick");
  options.keys = key_file(folder / "stick/relievo.key");
  fill(*opened(folder / "store", options));
  EXPECT_FALSE(std::filesystem::exists(folder / "store/relievo.key"));
  std::filesystem::copy(folder / "stick/relievo.key", folder / "credential");
  ::chmod((folder / "credential").c_str(), 0440);
  options.keys = key_credential(folder / "credential");
  EXPECT_TRUE(opened(folder / "store", options)->check());
}

}  // namespace
}  // namespace relievo::storage
