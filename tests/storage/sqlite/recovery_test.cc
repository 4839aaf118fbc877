// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold before the recovery words are needed: they open the store, and their key replaces nothing.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <utility>

#include "storage/cipher/recovery.h"
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

const test::StillClock kRecoveryTime;

// Ada, and recovery words, which it returns.
std::string store_with_words(const fs::path& dir) {
  const auto store = opened(dir, kNoReserve);
  EXPECT_TRUE(store->add_subject({"Ada"}));
  const std::string words = draw_recovery_words();
  EXPECT_TRUE(store->keep_recovery_words(words));
  return words;
}

std::vector<std::string> keys_in(const fs::path& dir) {
  return Raw(dir / "relievo.db").rows("SELECT kind || hex(parameters) FROM encryption_key ORDER BY id");
}

TEST(Recovery, ReplacesNoFileThatIsNoKey) {
  const TemporaryFolder folder;
  const auto dir = folder / "store";
  const std::string words = store_with_words(dir);
  store_with_words(folder / "other");
  const auto recover = [&](const fs::path& to, bool beside = false) {
    auto options = kNoReserve;
    options.keys = key_file(to, beside);
    return keep_sqlite_store(dir, kRecoveryTime, options)->recover(words);
  };
  const std::string photo = std::string("\xff\xd8\xff\xe0", 4) + std::string(5000, 'x');
  relievo::test::write_text(folder / "photo.jpg", photo);
  relievo::test::write_text(folder / "letter.txt", "Dear Ada\n");
  fs::create_directory(folder / "folder");
  fs::copy(folder / "other/relievo.key", folder / "for all to read");
  ASSERT_EQ(::chmod((folder / "for all to read").c_str(), 0644), 0);
  const auto before = keys_in(dir);
  for (const char* name : {"photo.jpg", "letter.txt", "folder", "for all to read"}) {
    const std::string list = relievo::test::listing(folder.path());
    const auto done = recover(folder / name);
    ASSERT_FALSE(done) << name;
    EXPECT_EQ(done.error().code, Errc::InvalidInput) << name;
    EXPECT_EQ(done.error().where(), (folder / name).native());
    EXPECT_EQ(relievo::test::listing(folder.path()), list) << name;
  }
  EXPECT_EQ(relievo::test::read_text(folder / "photo.jpg"), photo);
  EXPECT_EQ(relievo::test::read_text(folder / "letter.txt"), "Dear Ada\n");
  EXPECT_EQ(relievo::test::read_text(folder / "for all to read"),
            relievo::test::read_text(folder / "other/relievo.key"));
  EXPECT_EQ(keys_in(dir), before) << "its own key still opens it";
  EXPECT_TRUE(opened(dir, kNoReserve)->check());

  // Beside the store nothing else can have that name, but no key takes a folder's place.
  fs::remove(dir / "relievo.key");
  fs::create_directory(dir / "relievo.key");
  EXPECT_EQ(code_of(recover(dir / "relievo.key", true)), Errc::InvalidInput);
  EXPECT_EQ(keys_in(dir), before);
  fs::remove(dir / "relievo.key");
  relievo::test::write_text(dir / "relievo.key", "damaged");
  EXPECT_TRUE(recover(dir / "relievo.key", true));
  EXPECT_TRUE(opened(dir, kNoReserve)->check());
  relievo::test::write_text(folder / "empty", "");
  EXPECT_TRUE(recover(folder / "empty")) << "as mktemp makes it";
}

TEST(Recovery, WordsThatOpenNothingAreToldWhileTheKeyIsThere) {
  const TemporaryFolder folder;
  const auto good = folder / "good", other = folder / "other";
  store_with_words(good);
  store_with_words(other);
  const std::string pair = "kind IN ('recovery', 'recovery public half')";
  const auto rows_of = [&](const fs::path& dir) {
    std::string sql;
    for (const auto& row :
         Raw(dir / "relievo.db")
             .rows("SELECT '''' || hex(parameters) || ''' WHERE kind = ''' || kind || ''';' "
                   "FROM encryption_key WHERE " +
                   pair))
      sql += "UPDATE encryption_key SET parameters = x" + row.substr(0, row.size() - 1);
    return sql;
  };
  ASSERT_TRUE(keep_sqlite_store(good, kRecoveryTime, kNoReserve)->rekey({}));
  const std::string older = rows_of(good), others = rows_of(other);
  ASSERT_TRUE(opened(good, kNoReserve)->keep_recovery_words(draw_recovery_words()));
  ASSERT_TRUE(opened(good, kNoReserve)->check());
  const auto dead = [](const Error& error) {
    return error.code == Errc::StoreCorrupt &&
           error.what.view().find("make new ones (store recovery-words)") != std::string_view::npos;
  };
  const std::string zeros =
      "UPDATE encryption_key SET parameters = zeroblob(length(parameters)) WHERE kind = ";
  for (const auto& sql : {"DELETE FROM encryption_key WHERE " + pair,
                          std::string("DELETE FROM encryption_key WHERE kind = 'recovery'"),
                          std::string("DELETE FROM encryption_key WHERE kind = 'recovery public half'"),
                          zeros + "'recovery'", zeros + "'recovery public half'", others, older}) {
    const auto dir = folder / "bad";
    fs::copy(good, dir);
    Raw(dir / "relievo.db").run(sql);
    const auto checked = opened(dir, kNoReserve)->check();
    ASSERT_FALSE(checked) << sql;
    EXPECT_TRUE(dead(checked.error())) << sql << checked.error().what.view();
    const auto before = keys_in(dir);
    const auto rekeyed = keep_sqlite_store(dir, kRecoveryTime, kNoReserve)->rekey({});
    ASSERT_FALSE(rekeyed) << sql;
    EXPECT_TRUE(dead(rekeyed.error())) << sql << rekeyed.error().what.view();
    EXPECT_EQ(keys_in(dir), before);
    // As it says.
    ASSERT_TRUE(opened(dir, kNoReserve)->keep_recovery_words(draw_recovery_words()));
    EXPECT_TRUE(keep_sqlite_store(dir, kRecoveryTime, kNoReserve)->rekey({})) << sql;
    EXPECT_TRUE(opened(dir, kNoReserve)->check()) << sql;
    fs::remove_all(dir);
  }
}

// The log of an earlier version says only that words were made.
TEST(Recovery, WordsOfAnEarlierVersionAreInOrder) {
  const TemporaryFolder folder;
  const auto dir = folder / "store";
  store_with_words(dir);
  {
    Database database(dir / "relievo.db");
    ASSERT_TRUE(database.open(true));
    const auto keys = StoreKeys::make(key_file(dir / "relievo.key"));
    ASSERT_TRUE((*keys)->load(database, false));
    ASSERT_TRUE(append_audit_line(database, **keys, {std::string(kRecoveryWordsMade), {}, ""}, {}));
  }
  EXPECT_TRUE(opened(dir, kNoReserve)->check());
  EXPECT_TRUE(keep_sqlite_store(dir, kRecoveryTime, kNoReserve)->rekey({}));
  Raw(dir / "relievo.db")
      .run("UPDATE encryption_key SET parameters = zeroblob(100) WHERE kind = 'recovery public half'");
  EXPECT_EQ(code_of(opened(dir, kNoReserve)->check()), Errc::StoreCorrupt);
  // Nobody else may say so.
  for (const auto what : {kRecoveryWordsMade, kRekeyed})
    EXPECT_EQ(code_of(opened(dir, kNoReserve)->append_audit({std::string(what), {}, ""})),
              Errc::InvalidInput);
}

}  // namespace
}  // namespace relievo::storage
