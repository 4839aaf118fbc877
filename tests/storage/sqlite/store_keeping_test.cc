// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The store as a whole: copies, new keys, recovery.
#include "storage/store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "storage/cipher/recovery.h"
#include "storage/sqlite/sqlite_parts.h"
#include "tests/storage/raw_database.h"
#include "tests/storage/sample.h"
#include "tests/storage/store_of_before.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using relievo::test::TemporaryFolder;
using test::code_of;
using test::kNoReserve;
using test::opened;
using test::Raw;

const test::StillClock kClock;

std::unique_ptr<StoreKeeping> keeping(const std::filesystem::path& dir,
                                      SqliteStoreOptions options = kNoReserve) {
  return keep_sqlite_store(dir, kClock, options);
}

void fill(const std::filesystem::path& dir, int people = 3) {
  const auto store = opened(dir, kNoReserve);
  const auto model = test::sample_model(20);
  for (int i = 1; i <= people; ++i)
    ASSERT_TRUE(
        store->add_enrolment(NewSubject{"Person " + std::to_string(i)}, test::sample_enrolment(model)));
  ASSERT_TRUE(store->set_setting("language", "eo"));
}

void judge(const std::filesystem::path& dir, const SqliteStoreOptions& options = kNoReserve, int people = 3) {
  const auto store = opened(dir, options);
  ASSERT_TRUE(store);
  const auto sound = store->check();
  ASSERT_TRUE(sound) << sound.error().where() << ": " << sound.error().what.view();
  EXPECT_EQ(store->subjects({})->size(), static_cast<std::size_t>(people));
  EXPECT_EQ(*store->setting("language"), "eo");
  EXPECT_TRUE(test::identical(test::sample_model(20),
                              *store->load_model(EnrolmentId{2}, std::pmr::new_delete_resource())));
}

// Vectors of BIP-39's own (github.com/trezor/python-mnemonic, vectors.json, English, 128 bits).
TEST(RecoveryWords, AreThoseOfTheirStandard) {
  const auto bits = [](unsigned char byte) {
    RecoveryBits all;
    all.fill(std::byte{byte});
    return all;
  };
  const std::string zeros =
      "abandon abandon abandon abandon abandon abandon abandon abandon abandon abandon abandon about";
  EXPECT_EQ(words_of(bits(0x00)), zeros);
  EXPECT_EQ(words_of(bits(0x7f)),
            "legal winner thank year wave sausage worth useful legal winner thank yellow");
  EXPECT_EQ(words_of(bits(0x80)),
            "letter advice cage absurd amount doctor acoustic avoid letter advice cage above");
  EXPECT_EQ(words_of(bits(0xff)), "zoo zoo zoo zoo zoo zoo zoo zoo zoo zoo zoo wrong");
  EXPECT_EQ(*bits_of(zeros), bits(0x00));
  EXPECT_EQ(*bits_of("  ZOO zoo\nzoo zoo zoo zoo zoo zoo zoo zoo zoo\twrong "), bits(0xff));
  EXPECT_NE(draw_recovery_words(), draw_recovery_words());
  EXPECT_EQ(code_of(bits_of("")), Errc::InvalidInput);
  EXPECT_EQ(code_of(bits_of("zoo zoo zoo zoo zoo zoo zoo zoo zoo zoo zoo")), Errc::InvalidInput) << "eleven";
  EXPECT_EQ(code_of(bits_of(zeros + " about")), Errc::InvalidInput) << "thirteen";
  EXPECT_EQ(code_of(bits_of("zoo zoo zoo zoo zoo zoo zoo zoo zoo zoo zoo zoo")), Errc::InvalidInput)
      << "checksum";
  const auto misspelt = bits_of("zoo zoo zo zoo zoo zoo zoo zoo zoo zoo zoo wrong");
  ASSERT_FALSE(misspelt);
  EXPECT_EQ(misspelt.error().where(), "word 3");
}

TEST(StoreKeeping, WordsOpenTheStoreOfADeadBoard) {
  const TemporaryFolder folder;
  const auto dir = folder / "dead";
  fill(dir);
  const auto older = draw_recovery_words(), words = draw_recovery_words();
  EXPECT_EQ(code_of(keeping(dir)->recover(words)), Errc::NotFound) << "none were made";
  ASSERT_TRUE(opened(dir, kNoReserve)->keep_recovery_words(older));
  ASSERT_TRUE(opened(dir, kNoReserve)->keep_recovery_words(words));
  ASSERT_TRUE(keeping(dir)->rekey({})) << "the words stay good without being asked for";
  EXPECT_EQ(test::all_bytes(dir).find(words.substr(0, 12)), std::string::npos);
  std::filesystem::create_directory(folder / "board");
  std::filesystem::copy(dir / "relievo.db", folder / "board/relievo.db");
  const auto opening = open_sqlite_store(folder / "board", kClock, kNoReserve);
  EXPECT_EQ(code_of(opening), Errc::NotFound);
  EXPECT_EQ(code_of(keeping(folder / "board")->recover(older)), Errc::StoreCorrupt) << "an older sheet";
  EXPECT_EQ(code_of(keeping(folder / "board")->recover("no words")), Errc::InvalidInput);
  EXPECT_EQ(code_of(keeping(folder / "nowhere")->recover(words)), Errc::NotFound);
  ASSERT_TRUE(keeping(folder / "board")->recover(words));
  judge(folder / "board");
  judge(dir);
}

TEST(StoreKeeping, WordsAreRefusedWhereNoneCanHaveBeenMade) {
  const TemporaryFolder folder;
  const std::string words = draw_recovery_words();
  test::make_version(folder / "first", 1);
  EXPECT_EQ(code_of(keeping(folder / "first")->recover(words)), Errc::NotFound);
  std::filesystem::create_directory(folder / "songs");
  Raw(folder / "songs/relievo.db").run("CREATE TABLE song (name TEXT)");
  EXPECT_EQ(code_of(keeping(folder / "songs")->recover(words)), Errc::InvalidInput) << "another program's";
}

TEST(StoreKeeping, AnOldKeyOpensNothingAfterANewOne) {
  const TemporaryFolder folder;
  const auto dir = folder / "store";
  fill(dir);
  std::filesystem::copy(dir / "relievo.key", folder / "old");
  ASSERT_TRUE(keeping(dir)->rekey({}));
  judge(dir);
  auto options = kNoReserve;
  options.keys = key_file(folder / "old");
  EXPECT_EQ(code_of(open_sqlite_store(dir, kClock, options)), Errc::InvalidInput);
  // To another place, and away from here.
  std::filesystem::create_directory(folder / "stick");
  ASSERT_TRUE(keeping(dir)->rekey({folder / "stick/key"}));
  EXPECT_EQ(code_of(open_sqlite_store(dir, kClock, kNoReserve)), Errc::InvalidInput);
  options.keys = key_file(folder / "stick/key", false);
  judge(dir, options);
  // A credential is the operator's: the store's key is new, the credential stays.
  auto credential = kNoReserve;
  credential.keys = key_credential(folder / "stick/key");
  const auto before = Raw(dir / "relievo.db").rows("SELECT hex(parameters) FROM encryption_key ORDER BY id");
  ASSERT_TRUE(keeping(dir, credential)->rekey({}));
  EXPECT_NE(before, Raw(dir / "relievo.db").rows("SELECT hex(parameters) FROM encryption_key ORDER BY id"));
  judge(dir, credential);
}

TEST(StoreKeeping, ANewKeyIsNotWrittenOverAnotherStores) {
  const TemporaryFolder folder;
  const auto dir = folder / "store", other = folder / "other";
  fill(dir);
  fill(other);
  EXPECT_EQ(code_of(keeping(dir)->rekey({other / "relievo.key"})), Errc::InvalidInput);
  judge(other);
  judge(dir);
  EXPECT_FALSE(std::filesystem::exists(other / "relievo.key.next"));
  ASSERT_TRUE(keeping(dir)->rekey({dir / "relievo.key"})) << "its own";
  judge(dir);
}

TEST(StoreKeeping, TheKeyOfARecoveredStoreIsNotWrittenOverAnotherStores) {
  const TemporaryFolder folder;
  const auto dir = folder / "store", other = folder / "other";
  fill(dir);
  fill(other);
  const auto words = draw_recovery_words();
  ASSERT_TRUE(opened(dir, kNoReserve)->keep_recovery_words(words));
  auto named = kNoReserve;
  named.keys = key_file(other / "relievo.key", false);
  EXPECT_EQ(code_of(keeping(dir, named)->recover(words)), Errc::InvalidInput);
  judge(other);
  judge(dir);
  EXPECT_FALSE(std::filesystem::exists(other / "relievo.key.next"));
  std::ofstream(folder / "key") << "relievo: sealed by a TPM 2.0\n";  // which is dead: it opens nothing
  named.keys = key_file(folder / "key", false);
  for (const char* what : {"nobody's", "its own"}) {
    ASSERT_TRUE(keeping(dir, named)->recover(words)) << what;
    judge(dir, named);
  }
}

// The moment that no write of SQLite's marks: the store goes by the new key, the file is not renamed yet.
TEST(StoreKeeping, ANewKeyThatHasNotTakenItsPlaceIsFound) {
  const TemporaryFolder folder;
  fill(folder / "store");
  std::filesystem::copy(folder / "store/relievo.key", folder / "old");
  ASSERT_TRUE(keeping(folder / "store")->rekey({}));
  for (const bool old_is_there : {true, false}) {
    std::filesystem::rename(folder / "store/relievo.key", folder / "store/relievo.key.next");
    if (old_is_there) std::filesystem::copy(folder / "old", folder / "store/relievo.key");
    auto read_only = kNoReserve;
    read_only.mode = OpenMode::ReadOnly;
    judge(folder / "store", read_only);
    EXPECT_TRUE(std::filesystem::exists(folder / "store/relievo.key.next")) << "to read changes nothing";
    judge(folder / "store");
    EXPECT_FALSE(std::filesystem::exists(folder / "store/relievo.key.next"));
  }
}

TEST(StoreKeeping, OnAFullDiskNothingIsHalf) {
  const relievo::test::TinyDisk disk(3'000'000);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  const auto dir = disk.path() / "store";
  fill(dir, 20);
  const auto before = Raw(dir / "relievo.db").rows("SELECT hex(parameters) FROM encryption_key");
  {
    std::ofstream junk(disk.path() / "junk", std::ios::binary);
    for (const std::string block(4096, 'x'); junk.flush(); junk.write(block.data(), 4096)) continue;
  }
  EXPECT_EQ(code_of(keeping(dir)->rekey({})), Errc::MediaFull);
  {
    const auto full = open_sqlite_store(dir, kClock, kNoReserve);
    EXPECT_EQ(full ? code_of((*full)->keep_recovery_words(draw_recovery_words())) : full.error().code,
              Errc::MediaFull);
  }
  EXPECT_EQ(code_of(keeping(dir)->backup(disk.path() / "copy")), Errc::MediaFull);
  // Also where there is room for a beginning.
  int failed = 0;
  for (auto junk = std::filesystem::file_size(disk.path() / "junk") - 50'000; junk > 60'000; junk -= 50'000) {
    std::filesystem::resize_file(disk.path() / "junk", junk);
    const auto copied = keeping(dir)->backup(disk.path() / "copy");
    if (copied) break;
    ++failed;
    EXPECT_EQ(copied.error().code, Errc::MediaFull);
    EXPECT_NE(copied.error().what.view().find("make room there"), std::string_view::npos);
    EXPECT_FALSE(std::filesystem::exists(disk.path() / "copy"));
    const std::string left = relievo::test::listing(disk.path());
    EXPECT_EQ(left.find(".part"), std::string::npos) << left;
  }
  EXPECT_GT(failed, 0);
  std::filesystem::remove(disk.path() / "junk");
  EXPECT_EQ(before, Raw(dir / "relievo.db").rows("SELECT hex(parameters) FROM encryption_key"));
  judge(dir, kNoReserve, 20);
  ASSERT_TRUE(keeping(dir)->rekey({}));
  judge(dir, kNoReserve, 20);
}

TEST(StoreKeeping, ACopyIsSealedAndTellsWhoWasErasedSince) {
  const TemporaryFolder folder;
  const auto dir = folder / "store", copy = folder / "copy.db";
  fill(dir, 4);
  {
    const auto store = opened(dir, kNoReserve);
    ASSERT_TRUE(store->erase_subject(SubjectId{1}));
  }
  ASSERT_TRUE(keeping(dir)->backup(copy));
  struct stat status {};
  ::stat(copy.c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  EXPECT_EQ(relievo::test::read_text(copy).find("Person"), std::string::npos);
  EXPECT_TRUE(keeping(dir)->erased_since(copy)->empty());
  {
    const auto store = opened(dir, kNoReserve);
    ASSERT_TRUE(store->erase_subject(SubjectId{3}));
    ASSERT_TRUE(store->erase_subject(*store->add_subject({"Somebody who came later"})));
  }
  ASSERT_TRUE(keeping(dir)->rekey({}));
  EXPECT_EQ(*keeping(dir)->erased_since(copy), std::vector<SubjectId>{SubjectId{3}});
  fill(folder / "other");
  EXPECT_EQ(code_of(keeping(folder / "other")->erased_since(copy)), Errc::InvalidInput);
  EXPECT_EQ(code_of(keeping(dir)->backup(folder / "no/such/folder")), Errc::IoFailed);
  EXPECT_EQ(code_of(keeping(folder / "nowhere")->backup(copy)), Errc::NotFound);
  EXPECT_EQ(relievo::test::listing(folder.path()).find(".part"), std::string::npos);
}

TEST(StoreKeeping, ACopyReplacesOnlyACopy) {
  const TemporaryFolder folder;
  const auto dir = folder / "store", copy = folder / "copy.db";
  fill(dir);
  ASSERT_TRUE(keeping(dir)->backup(copy));
  ASSERT_TRUE(opened(dir, kNoReserve)->erase_subject(SubjectId{1}));
  EXPECT_TRUE(keeping(dir)->backup(copy));
  EXPECT_TRUE(keeping(dir)->erased_since(copy)->empty()) << "the new one";
  relievo::test::write_text(folder / "empty", "");  // as mktemp makes it
  EXPECT_TRUE(keeping(dir)->backup(folder / "empty"));
  EXPECT_TRUE(keeping(dir)->erased_since(folder / "empty")->empty());
  relievo::test::write_text(folder / "copy.db.tmp", "somebody's own");
  EXPECT_TRUE(keeping(dir)->backup(copy));
  EXPECT_EQ(relievo::test::read_text(folder / "copy.db.tmp"), "somebody's own");

  const std::string key = relievo::test::read_text(dir / "relievo.key");
  relievo::test::write_text(folder / "key", key);
  fill(folder / "other");
  ASSERT_TRUE(keeping(folder / "other")->backup(folder / "others.db"));
  std::filesystem::create_directory(folder / "keyed");  // a store's, though no kiosk has opened it yet
  relievo::test::write_text(folder / "keyed/relievo.key", key);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("pipe", folder / "link to a pipe");
  std::filesystem::create_symlink("/dev/null", folder / "link to a device");
  std::filesystem::create_directory(folder / "folder");
  for (const auto& place : {folder / "key", dir / "relievo.key", dir / "relievo.db", dir / "relievo.lock",
                            dir / "new.db", folder / "store/../store/new.db", folder / "other/relievo.db",
                            folder / "others.db", folder / "keyed/new.db", folder / "pipe",
                            folder / "link to a pipe", folder / "link to a device", folder / "folder"}) {
    EXPECT_EQ(code_of(keeping(dir)->backup(place)), Errc::InvalidInput) << place;
  }
  EXPECT_EQ(relievo::test::read_text(folder / "key"), key);
  EXPECT_EQ(relievo::test::read_text(dir / "relievo.key"), key);
  EXPECT_FALSE(std::filesystem::exists(dir / "new.db"));
  EXPECT_FALSE(std::filesystem::exists(folder / "keyed/new.db"));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link to a pipe"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link to a device"));
  EXPECT_TRUE(keeping(folder / "other")->erased_since(folder / "others.db")->empty()) << "still its own";
  judge(folder / "other");
  EXPECT_EQ(code_of(keeping(dir)->erased_since(folder / "key")), Errc::InvalidInput) << "not: damaged";
}

// What keeps a copy from being read is said as it is: only a damaged one is to be removed.
TEST(StoreKeeping, ACopyThatCannotBeReadIsNotReplaced) {
  const TemporaryFolder folder;
  const auto dir = folder / "store", copy = folder / "copy.db";
  fill(dir);
  ASSERT_TRUE(keeping(dir)->backup(copy));
  {
    Raw busy(copy);
    busy.run("BEGIN EXCLUSIVE");
    EXPECT_EQ(code_of(keeping(dir)->backup(copy)), Errc::Timeout);
  }
  const std::string newer = std::to_string(store_version() + 1);
  Raw(copy).run("UPDATE store_info SET compatible_version = " + newer + "; PRAGMA user_version = " + newer);
  EXPECT_EQ(code_of(keeping(dir)->backup(copy)), Errc::StoreNewer);
  relievo::test::write_text(copy, std::string(8192, 'x'));
  const auto damaged = keeping(dir)->backup(copy);
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().code, Errc::InvalidInput);
  EXPECT_NE(damaged.error().what.view().find("is damaged or no copy"), std::string_view::npos);
}

// An older copy put in the store's place brings nobody back, and nobody else is taken for them.
TEST(StoreKeeping, AnOlderCopyInItsPlaceErasesAgainWhoWasErasedSince) {
  const TemporaryFolder folder;
  const auto dir = folder / "store", copy = folder / "copy.db";
  fill(dir, 4);
  ASSERT_TRUE(keeping(dir)->backup(copy));
  {
    const auto store = opened(dir, kNoReserve);
    ASSERT_TRUE(store->erase_subject(SubjectId{3}));
    ASSERT_TRUE(store->erase_subject(*store->add_subject({"The fifth"})));
    EXPECT_TRUE(store->check());
  }
  // What a power cut left of another.
  std::ofstream(dir / "relievo.erased", std::ios::binary | std::ios::app) << "torn";
  const auto put_back = [&] {
    for (const char* gone : {"relievo.db", "relievo.db-wal", "relievo.db-shm"})
      std::filesystem::remove(dir / gone);
    std::filesystem::copy(copy, dir / "relievo.db");
  };
  put_back();
  {
    auto options = kNoReserve;
    options.mode = OpenMode::ReadOnly;
    const auto store = opened(dir, options);
    EXPECT_EQ(store->subjects({})->size(), 3U) << "only to read, too, nobody sees them";
    EXPECT_EQ(*store->count_subjects(), 3);
    EXPECT_TRUE(store->subjects({.name = "Person 3"})->empty());
    EXPECT_TRUE(store->enrolments(SubjectId{3})->empty());
    auto* const heap = std::pmr::new_delete_resource();
    EXPECT_TRUE(store->load_model(EnrolmentId{2}, heap));
    EXPECT_EQ(code_of(store->subject(SubjectId{3})), Errc::NotFound);
    EXPECT_EQ(code_of(store->enrolment(EnrolmentId{3})), Errc::NotFound);
    EXPECT_EQ(code_of(store->load_model(EnrolmentId{3}, heap)), Errc::NotFound);
    EXPECT_EQ(code_of(store->person(SubjectId{3})), Errc::NotFound);
    const auto told = store->check();
    ASSERT_FALSE(told);
    EXPECT_EQ(told.error().where(), "subject 3");
    EXPECT_NE(told.error().what.view().find("start the kiosk on it once"), std::string_view::npos);
  }
  {
    const auto store = opened(dir, kNoReserve);
    ASSERT_TRUE(store);
    EXPECT_EQ(code_of(store->subject(SubjectId{3})), Errc::NotFound);
    EXPECT_EQ(store->subjects({})->size(), 3U);
    EXPECT_EQ(store->audit(0, 100)->back().event.what, "subject.erased");
    EXPECT_TRUE(store->check());
    // Has the number of one who was erased in the time that was lost.
    EXPECT_EQ(*store->add_subject({"Another fifth"}), SubjectId{5});
  }
  EXPECT_EQ(opened(dir, kNoReserve)->subjects({})->size(), 4U);
  EXPECT_TRUE(opened(dir, kNoReserve)->check());
  // Torn bytes shift nothing: the next erasure is remembered, too.
  ASSERT_TRUE(opened(dir, kNoReserve)->erase_subject(SubjectId{1}));
  put_back();
  EXPECT_EQ(opened(dir, kNoReserve)->subjects({})->size(), 2U) << "neither the first nor the third";
}

// On another board, too, where the list of who was erased came along.
TEST(StoreKeeping, ACopyThatIsRecoveredTellsWhomItErasesAgain) {
  const TemporaryFolder folder;
  const auto dir = folder / "store", board = folder / "board2";
  const auto words = draw_recovery_words();
  fill(dir, 4);
  ASSERT_TRUE(opened(dir, kNoReserve)->keep_recovery_words(words));
  std::filesystem::create_directory(board);
  ASSERT_TRUE(keeping(dir)->backup(board / "relievo.db"));
  ASSERT_TRUE(opened(dir, kNoReserve)->erase_subject(SubjectId{3}));
  std::filesystem::copy(dir / "relievo.erased", board / "relievo.erased");
  const auto told = keeping(board)->recover(words);
  ASSERT_TRUE(told) << told.error().what.view();
  EXPECT_EQ(*told, std::vector<SubjectId>{SubjectId{3}});
  EXPECT_EQ(opened(board, kNoReserve)->subjects({})->size(), 3U);
  EXPECT_TRUE(keeping(dir)->recover(words)->empty());
}

}  // namespace
}  // namespace relievo::storage
