// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Debian's own age opens what we seal, and we open what it seals.
#include "storage/cipher/age.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <random>
#include <string>

#include "storage/cipher/seal.h"
#include "storage/export/bundle.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using relievo::test::read_text;
using relievo::test::run_program;
using relievo::test::TemporaryFolder;
using relievo::test::write_text;

constexpr std::string_view kPassphrase = "correct horse";

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }
std::string text(const Result<std::vector<std::byte>>& result) {
  EXPECT_TRUE(result) << (result ? "" : result.error().what.view());
  return result ? std::string(reinterpret_cast<const char*>(result->data()), result->size()) : std::string();
}
std::string some(std::size_t size) {
  std::mt19937 random(static_cast<unsigned>(size));
  std::string all(size, '\0');
  for (char& byte : all) byte = static_cast<char>(random());
  return all;
}

class Age : public ::testing::Test {
 protected:
  void SetUp() override {
    if (run_program({"/usr/bin/age", "--version"}, folder.path()).exit_code != 0)
      GTEST_SKIP() << "age is not installed";
    ASSERT_EQ(run_program({"/usr/bin/age-keygen", "-o", "key"}, folder.path()).exit_code, 0);
    const std::string key = read_text(folder / "key");
    recipient = key.substr(key.find("age1"), 62);
  }
  // age asks a terminal for passphrases.
  int ask_age(const std::string& command) const {
    int terminal = -1;
    const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) {
      if (::chdir(folder.path().c_str()) != 0) ::_exit(1);
      ::execlp("sh", "sh", "-c", command.c_str(), nullptr);
      ::_exit(127);
    }
    std::string said;
    std::size_t asked = 0;
    char piece[256];
    for (ssize_t got; (got = ::read(terminal, piece, sizeof piece)) > 0;) {
      said.append(piece, static_cast<std::size_t>(got));
      for (std::size_t at;
           (at = said.find("passphrase", asked)) != std::string::npos && said.find(':', at) != said.npos;) {
        asked = said.find(':', at);
        const std::string line = std::string(kPassphrase) + "\n";
        EXPECT_EQ(::write(terminal, line.data(), line.size()), static_cast<ssize_t>(line.size()));
      }
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ::close(terminal);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  TemporaryFolder folder;
  std::string recipient;
};

constexpr std::size_t kPiece = 65536;

TEST_F(Age, OpensWhatWeSealAndWeWhatItSeals) {
  const auto to = age_recipient(recipient);
  const auto identity = age_identity(read_text(folder / "key"));
  ASSERT_TRUE(to && identity);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, kPiece - 1, kPiece, kPiece + 1, 3 * kPiece + 9}) {
    const std::string plain = some(size);
    write_text(folder / "ours.age", text(age_seal(*to, bytes(plain))));
    const auto opened =
        run_program({"/usr/bin/age", "-d", "-i", "key", "-o", "opened", "ours.age"}, folder.path());
    ASSERT_EQ(opened.exit_code, 0) << size << opened.err;
    EXPECT_TRUE(read_text(folder / "opened") == plain) << size;
    write_text(folder / "plain", plain);
    ASSERT_EQ(run_program({"/usr/bin/age", "-r", recipient, "-r", recipient, "-o", "theirs.age", "plain"},
                          folder.path())
                  .exit_code,
              0);
    EXPECT_TRUE(text(age_open(&*identity, bytes(read_text(folder / "theirs.age")))) == plain) << size;
  }
}

TEST_F(Age, SoWithAPassphrase) {
  const std::string plain = some(1000);
  write_text(folder / "ours.age", text(age_seal(Passphrase{kPassphrase}, bytes(plain))));
  ASSERT_EQ(ask_age("age -d -o opened ours.age"), 0);
  EXPECT_TRUE(read_text(folder / "opened") == plain);
  write_text(folder / "plain", plain);
  ASSERT_EQ(ask_age("age -p -o theirs.age plain"), 0);
  const std::string theirs = read_text(folder / "theirs.age");
  EXPECT_TRUE(text(age_open(Passphrase{kPassphrase}, bytes(theirs))) == plain);
  EXPECT_FALSE(age_open(Passphrase{"another"}, bytes(theirs)));
}

TEST_F(Age, WhatIsCutOrChangedIsRefused) {
  const auto to = age_recipient(recipient);
  const auto identity = age_identity(read_text(folder / "key"));
  ASSERT_TRUE(to && identity);
  const std::string sealed = text(age_seal(*to, bytes(some(2 * kPiece))));
  const auto open = [&](const std::string& other) { return age_open(&*identity, bytes(other)).has_value(); };
  ASSERT_TRUE(open(sealed));
  const std::size_t header = sealed.find("\n--- ") + 49;
  for (std::size_t at = 0; at < sealed.size(); at += at < header + 40 ? 1 : 997) {
    std::string other = sealed;
    other[at] = static_cast<char>(other[at] ^ 1);
    EXPECT_FALSE(open(other)) << at;
    EXPECT_FALSE(open(sealed.substr(0, at))) << at;
  }
  EXPECT_FALSE(open(sealed + "x"));
  // Whole pieces that are gone, or turned.
  const std::size_t piece = kPiece + 16, first = sealed.size() - 2 * piece;
  EXPECT_FALSE(open(sealed.substr(0, first + piece)));
  EXPECT_FALSE(open(sealed.substr(0, first) + sealed.substr(first + piece) + sealed.substr(first, piece)));
  const auto another = SecretKey::make();
  EXPECT_FALSE(age_open(&*another, bytes(sealed)));
}

TEST_F(Age, OnlyRecipientsOfItsOwnAreTaken) {
  EXPECT_TRUE(age_recipient(recipient));
  for (std::size_t at = 0; at < recipient.size(); ++at) {
    std::string other = recipient;
    other[at] = other[at] == 'q' ? 'p' : 'q';
    EXPECT_FALSE(age_recipient(other)) << at;
  }
  for (const char* other : {"", "age1", "age", "AGE-SECRET-KEY-1"})
    EXPECT_FALSE(age_recipient(other)) << other;
  EXPECT_FALSE(age_recipient(recipient + "q"));
  EXPECT_FALSE(age_identity(recipient));
  // A weak one: its secret is known to everybody.
  EXPECT_FALSE(age_seal(AgeRecipient{}, bytes("x")));
}

TEST(Bundle, TarUnpacksIt) {
  const TemporaryFolder folder;
  const std::string large = some(100'000);
  const auto all = bundle_bytes(std::vector<BundleFile>{
      {"a.txt", {std::byte{'a'}}}, {"empty", {}}, {"large", {bytes(large).begin(), bytes(large).end()}}});
  write_text(folder / "all.tar", text(all));
  ASSERT_EQ(run_program({"/usr/bin/tar", "xf", "all.tar"}, folder.path()).exit_code, 0);
  EXPECT_EQ(relievo::test::listing(folder.path()), "a.txt\nall.tar\nempty\nlarge\n");
  EXPECT_EQ(read_text(folder / "a.txt"), "a");
  EXPECT_TRUE(read_text(folder / "large") == large);
  EXPECT_FALSE(bundle_bytes(std::vector<BundleFile>{{std::string(300, 'a'), {}}}));
}

// RFC 8032, 7.1, test 2.
TEST(Signature, IsThatOfItsStandard) {
  auto seed = SecretKey::make();
  ASSERT_TRUE(read_key("4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb", *seed));
  const auto made = sign_with(*seed, bytes("\x72"));
  ASSERT_TRUE(made);
  EXPECT_EQ(made->by[0], std::byte{0x3d});
  EXPECT_EQ(made->signature[0], std::byte{0x92});
  EXPECT_EQ(made->signature[63], std::byte{0x00});
  EXPECT_TRUE(is_signed(*made, bytes("\x72")));
  EXPECT_FALSE(is_signed(*made, bytes("\x73")));
}

}  // namespace
}  // namespace relievo::storage
