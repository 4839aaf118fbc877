// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A store whose key Debian's software TPM (swtpm) seals: each test starts boards of its own.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "storage/cipher/key_source.h"
#include "storage/cipher/recovery.h"
#include "storage/sodium_sha256.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/storage/sample.h"
#include "tests/support/memory_search.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;
using relievo::test::read_text;
using relievo::test::run_program;
using relievo::test::TemporaryFolder;
using relievo::test::write_text;

const test::StillClock kClock;
const SqliteStoreOptions kNoReserve{.reserve_bytes = 0};

// A socket has its name before anybody listens at it: proc(5), net/unix, flag __SO_ACCEPTCON.
bool listens(const std::string& socket) {
  std::ifstream all("/proc/net/unix");
  for (std::string line; std::getline(all, line);)
    if (line.ends_with(' ' + socket) && line.find(" 00010000 ") != std::string::npos) return true;
  return false;
}

// A board's TPM, on a socket in a folder. This process goes to the one that was switched on last.
class Board {
 public:
  Board() { switch_on(); }
  ~Board() { switch_off(); }
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  void switch_on() {
    const std::string state = "dir=" + folder_.path().string(), socket = (folder_ / "tpm").string();
    const std::string server = "type=unixio,path=" + socket, control = server + ".ctrl";
    pid_ = ::fork();
    if (pid_ == 0) {
      if (::freopen("/dev/null", "w", stderr) == nullptr) ::_exit(127);
      ::execlp("swtpm", "swtpm", "socket", "--tpm2", "--tpmstate", state.c_str(), "--server", server.c_str(),
               "--ctrl", control.c_str(), "--flags", "startup-clear", "--log", "level=0", nullptr);
      ::_exit(127);
    }
    for (int tries = 0; tries < 1000 && !listens(socket); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(listens(socket)) << "swtpm does not start";
    ::setenv("TPM2TOOLS_TCTI", ("swtpm:path=" + socket).c_str(), 1);
  }
  void switch_off() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
    fs::remove(folder_ / "tpm");
  }
  // Debian's tpm2-tools.
  int tool(std::vector<std::string> words) const {
    words.insert(words.begin(), {"/usr/bin/env", "TSS2_LOG=all+none"});
    return run_program(words, folder_.path()).exit_code;
  }

 private:
  TemporaryFolder folder_;
  pid_t pid_ = -1;
};

class TpmKey : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists("/usr/bin/swtpm")) GTEST_SKIP() << "swtpm is missing: toolchain/setup test";
  }
  void TearDown() override { ::unsetenv("TPM2TOOLS_TCTI"); }

  SqliteStoreOptions by_the_board(const fs::path& at) const {
    SqliteStoreOptions options = kNoReserve;
    options.keys = key_file(at / kKeyFile, true, NextKey::AsBefore);
    return options;
  }
  Result<std::unique_ptr<Store>> open(const fs::path& at) const {
    return open_sqlite_store(at, kClock, by_the_board(at));
  }
  void fill(const fs::path& at) const {
    const auto store = open(at);
    ASSERT_TRUE(store) << store.error().where() << ": " << store.error().what.view();
    ASSERT_TRUE((*store)->add_enrolment(NewSubject{"Ada"}, test::sample_enrolment(test::sample_model(5))));
  }
  void judge(const fs::path& at) const {
    const auto store = open(at);
    ASSERT_TRUE(store) << store.error().where() << ": " << store.error().what.view();
    EXPECT_TRUE((*store)->check());
    EXPECT_EQ((*store)->subject(SubjectId{1})->name, "Ada");
  }
  // One line: where, what, what to do.
  void refused(const fs::path& at, Errc code, std::string_view what, std::string_view to_do) const {
    const auto store = open(at);
    ASSERT_FALSE(store) << what;
    EXPECT_EQ(store.error().code, code) << store.error().what.view();
    EXPECT_NE(store.error().where(), "");
    EXPECT_NE(store.error().what.view().find(what), std::string_view::npos) << store.error().what.view();
    EXPECT_NE(store.error().what.view().find(to_do), std::string_view::npos) << store.error().what.view();
  }

  TemporaryFolder folder;
  fs::path dir = folder / "store";
};

// Neither in what tss2 and the libraries below it gave back to the heap, nor on the stack.
TEST_F(TpmKey, NothingOfItIsLeftInMemory) {
#ifdef RELIEVO_SANITIZED
  GTEST_SKIP() << "a sanitizer keeps what was given back";
#endif
  const Board board;
  relievo::test::MemorySearch search;
  std::vector<relievo::test::Canary> halves;
  std::vector<std::byte> sealed;
  const auto expect_gone = [&](const char* after) {
    for (const std::string& line : search.find(halves)) ADD_FAILURE() << after << ": " << line;
  };
  {
    auto key = SecretKey::make();
    ASSERT_TRUE(key);
    key->draw();
    halves.emplace_back("the first half", key->bytes().first<16>());
    halves.emplace_back("the second half", key->bytes().last<16>());
    EXPECT_EQ(search.find(halves).size(), 2U) << "the search finds nothing";
    auto made = seal_by_tpm(*key);
    ASSERT_TRUE(made) << made.error().what.view();
    sealed = *std::move(made);
  }
  expect_gone("sealed");
  {
    auto key = SecretKey::make();
    ASSERT_TRUE(key);
    ASSERT_TRUE(open_by_tpm(sealed, *key));
    EXPECT_EQ(search.find(halves).size(), 2U) << "once each, in locked memory alone";
  }
  expect_gone("opened");
}

TEST_F(TpmKey, TheFirstKeyIsSealedAndOpensOnThisBoardAlone) {
  Board board;
  fill(dir);
  judge(dir);
  struct stat status {};
  ASSERT_EQ(::stat((dir / kKeyFile).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  EXPECT_TRUE(is_key_sealed_by_tpm(dir / kKeyFile));
  EXPECT_NE(by_the_board(dir).keys->protects().find("TPM"), std::string_view::npos);

  board.switch_off();
  refused(dir, Errc::IoFailed, "does not answer", "relievo store recover");
  board.switch_on();
  judge(dir);
  ::setenv("TPM2TOOLS_TCTI", "none", 1);
  refused(dir, Errc::IoFailed, "no TPM", "relievo store recover");
  {
    const Board other;
    refused(dir, Errc::InvalidInput, "another board's TPM", "relievo store recover");
  }
  board.switch_off();
  board.switch_on();
  judge(dir);
  ASSERT_EQ(board.tool({"tpm2_clear", "-c", "p"}), 0);
  refused(dir, Errc::InvalidInput, "before it was cleared", "relievo store recover");
}

TEST_F(TpmKey, WhatWasChangedIsRefused) {
  const Board board;
  fill(dir);
  const std::string sealed = read_text(dir / kKeyFile);
  ASSERT_GT(sealed.size(), 200U);
  for (std::size_t at = 0; at < sealed.size(); at += 7) {
    std::string other = sealed;
    other[at] = static_cast<char>(other[at] ^ 1);
    write_text(dir / kKeyFile, other);
    const auto store = open(dir);
    ASSERT_FALSE(store) << at;
    EXPECT_EQ(store.error().code, Errc::InvalidInput) << at;
  }
  write_text(dir / kKeyFile, sealed.substr(0, sealed.size() - 1));
  refused(dir, Errc::InvalidInput, "was changed", "put its file back");
  write_text(dir / kKeyFile, sealed + "more");
  refused(dir, Errc::InvalidInput, "was changed", "put its file back");
  write_text(dir / kKeyFile, sealed);
  judge(dir);
}

// The checksum of a file is anybody's to make: then the chip itself refuses.
TEST_F(TpmKey, TheChipRefusesWhatWasChangedWithItsChecksum) {
  const Board board;
  auto key = SecretKey::make(), again = SecretKey::make();
  key->draw();
  auto sealed = seal_by_tpm(*key);
  ASSERT_TRUE(sealed);
  ASSERT_TRUE(open_by_tpm(*sealed, *again));
  EXPECT_TRUE(std::ranges::equal(key->bytes(), again->bytes()));
  constexpr std::size_t kSum = 32;
  (*sealed)[sealed->size() - kSum - 5] ^= std::byte{1};
  const Sha256 sum = sha256(std::span(*sealed).first(sealed->size() - kSum));
  std::ranges::copy(sum, sealed->end() - kSum);
  const auto opened = open_by_tpm(*sealed, *again);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, Errc::InvalidInput);
}

TEST_F(TpmKey, MovesFromAFileToTheTpmAndBack) {
  const Board board;
  const auto plain = [this] { return keep_sqlite_store(dir, kClock, kNoReserve); };
  ASSERT_TRUE(open_sqlite_store(dir, kClock, kNoReserve));
  fill(dir);
  EXPECT_FALSE(is_key_sealed_by_tpm(dir / kKeyFile)) << "a key that is there stays as it is";
  const std::string old = read_text(dir / kKeyFile);
  ASSERT_TRUE(keep_sqlite_store(dir, kClock, by_the_board(dir))->rekey({}));
  EXPECT_FALSE(is_key_sealed_by_tpm(dir / kKeyFile)) << "also when it is changed";
  ASSERT_TRUE(plain()->rekey({.sealed_by_tpm = true}));
  EXPECT_TRUE(is_key_sealed_by_tpm(dir / kKeyFile));
  judge(dir);
  const std::string first = read_text(dir / kKeyFile);
  ASSERT_TRUE(keep_sqlite_store(dir, kClock, by_the_board(dir))->rekey({}));
  EXPECT_TRUE(is_key_sealed_by_tpm(dir / kKeyFile)) << "it stays sealed";
  judge(dir);
  for (const std::string& earlier : {old, first}) {
    const std::string now = read_text(dir / kKeyFile);
    write_text(dir / kKeyFile, earlier);
    EXPECT_FALSE(open(dir)) << "an earlier key";
    write_text(dir / kKeyFile, now);
  }
  ASSERT_TRUE(plain()->rekey({.file = dir / kKeyFile}));
  EXPECT_FALSE(is_key_sealed_by_tpm(dir / kKeyFile));
  ::setenv("TPM2TOOLS_TCTI", "none", 1);
  judge(dir);
  const auto no_chip = plain()->rekey({.sealed_by_tpm = true});
  ASSERT_FALSE(no_chip);
  EXPECT_NE(no_chip.error().what.view().find("no TPM"), std::string_view::npos);
  judge(dir);
}

TEST_F(TpmKey, WordsOpenTheStoreOfADeadTpm) {
  Board dead;
  fill(dir);
  const std::string words = draw_recovery_words();
  ASSERT_TRUE((*open(dir))->keep_recovery_words(words));
  dead.switch_off();
  fs::copy(dir, folder / "copy", fs::copy_options::recursive);
  {
    const Board other;  // its TPM seals the new key
    ASSERT_TRUE(keep_sqlite_store(dir, kClock, by_the_board(dir))->recover(words));
    judge(dir);
    EXPECT_TRUE(is_key_sealed_by_tpm(dir / kKeyFile));
    // Power had gone before the new key took its place: the dead TPM's still lies there.
    fs::rename(dir / kKeyFile, dir / "relievo.key.next");
    fs::copy(folder / "copy" / kKeyFile, dir / kKeyFile);
    judge(dir);
    judge(dir);
  }
  ::setenv("TPM2TOOLS_TCTI", "none", 1);
  ASSERT_TRUE(keep_sqlite_store(folder / "copy", kClock, by_the_board(folder / "copy"))->recover(words));
  judge(folder / "copy");
  EXPECT_FALSE(is_key_sealed_by_tpm(folder / "copy" / kKeyFile)) << "a board without a TPM";
}

// Others' wrong passwords lock the chip for what has one; the store's key has none.
TEST_F(TpmKey, ALockedChipOpensTheStoreAndAnOwnersPasswordIsNamed) {
  const Board board;
  fill(dir);
  ASSERT_EQ(board.tool({"tpm2_dictionarylockout", "--setup-parameters", "--max-tries=1",
                        "--recovery-time=9999", "--lockout-recovery-time=9999"}),
            0);
  ASSERT_EQ(board.tool(
                {"/bin/sh", "-c",
                 "tpm2_createprimary -c p.ctx -p secret && tpm2_create -C p.ctx -P secret -u u -r r -p other "
                 "-i /etc/hostname && tpm2_flushcontext -t"}),
            0);
  const std::string wrong =
      "tpm2_createprimary -c q.ctx -p secret >/dev/null; tpm2_load -C q.ctx -P wrong -u u -r r -c l.ctx";
  EXPECT_NE(board.tool({"/bin/sh", "-c", wrong}), 0);
  board.tool({"tpm2_flushcontext", "-t"});
  ASSERT_EQ(board.tool({"/bin/sh", "-c", "tpm2_getcap properties-variable | grep -q 'inLockout: *1'"}), 0);
  judge(dir);
  ASSERT_EQ(board.tool({"tpm2_changeauth", "-c", "owner", "secret"}), 0);
  refused(dir, Errc::IoFailed, "lets nobody make keys", "owner's password");
}

}  // namespace
}  // namespace relievo::storage
