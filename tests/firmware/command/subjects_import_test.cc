// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Somebody's copy, exported by one device and taken in by another: whole, or refused by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory_resource>
#include <new>
#include <utility>

#include "firmware/command/commands.h"
#include "firmware/records/bundle_manifest.h"
#include "hal/base/whole_file.h"
#include "storage/cipher/age.h"
#include "storage/cipher/recovery.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;
using storage::BundleFile;
using test::read_text;
using test::write_text;
using Bytes = std::vector<std::byte>;

Bytes bytes_in(const fs::path& file) { return *read_whole_file(file, std::size_t{1} << 30); }

class SubjectsImport : public ::testing::Test {
 protected:
  SubjectsImport() {
    services.open_store = [this](const Path& at, bool to_write) {
      storage::SqliteStoreOptions options{.reserve_bytes = 0};
      options.mode = to_write ? storage::OpenMode::ReadWrite : storage::OpenMode::ReadOnly;
      return storage::open_sqlite_store(at, clock, options);
    };
    const auto store = storage::test::opened(folder / "from", {.reserve_bytes = 0});
    const auto model = storage::test::sample_model(5);
    EXPECT_TRUE(
        store->add_enrolment(storage::NewSubject{"Ada Canary"}, storage::test::sample_enrolment(model)));
    signer = text_of(store->sign({})->by);
    EXPECT_TRUE(storage::test::opened(folder / "to", {.reserve_bytes = 0})->add_subject({"Somebody else"}));
    write_text(folder / "key", "# made by age-keygen\n" + std::string(kIdentity) + "\n");
    write_text(folder / "passphrase", "long live the queen\n");
  }

  static constexpr const char* kIdentity =
      "AGE-SECRET-KEY-1GFPYYSJZGFPYYSJZGFPYYSJZGFPYYSJZGFPYYSJZGFPYYSJZGFPQ4EGAEX";

  SubjectsArgs exported(const char* name) const {
    SubjectsArgs args;
    args.verb = SubjectsArgs::Verb::Export;
    args.subject = "Ada Canary";
    args.output = folder / name;
    args.store = folder / "from";
    return args;
  }
  SubjectsArgs imported(const char* name) const {
    SubjectsArgs args;
    args.verb = SubjectsArgs::Verb::Import;
    args.copy = folder / name;
    args.signer = signer;
    args.store = folder / "to";
    return args;
  }
  // It is refused, and the other store has not noticed.
  std::string refused(const SubjectsArgs& args) {
    const auto people = [&] {
      return storage::test::opened(args.store, {.reserve_bytes = 0})->subjects({})->size();
    };
    const auto before = people();
    const auto lines = storage::test::opened(args.store, {.reserve_bytes = 0})->audit(0, 1000)->size();
    const auto told = run(args, services);
    EXPECT_FALSE(told) << args.copy;
    EXPECT_EQ(people(), before);
    EXPECT_EQ(storage::test::opened(args.store, {.reserve_bytes = 0})->audit(0, 1000)->size(), lines);
    return told ? std::string()
                : std::string(told.error().where()) + ": " + std::string(told.error().what.view());
  }
  void expect_taken(const SubjectsArgs& args) {
    const auto done = run(args, services);
    ASSERT_TRUE(done) << done.error().where() << ": " << done.error().what.view();
    const auto to = storage::test::opened(args.store, {.reserve_bytes = 0});
    const auto ada = to->subjects({.name = "Ada Canary"});
    ASSERT_EQ(ada->size(), 1U);
    const auto from = storage::test::opened(folder / "from", {.reserve_bytes = 0});
    EXPECT_EQ(encode_person(*to->person(ada->front().id)),
              encode_person(*from->person(storage::SubjectId{1})));
    EXPECT_TRUE(to->erase_subject(ada->front().id));
    fs::remove_all(folder / "to");
    EXPECT_TRUE(storage::test::opened(folder / "to", {.reserve_bytes = 0})->add_subject({"Somebody else"}));
  }
  // The folder of an export as one tar.
  Bytes tar_of(const fs::path& at) const {
    auto files = *read_bundle_folder(at);
    std::ranges::sort(files, {}, &BundleFile::name);
    return *storage::bundle_bytes(files);
  }

  test::TemporaryFolder folder;
  storage::test::StillClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  std::string signer;
};

TEST_F(SubjectsImport, EveryFormOfACopyIsTakenInWithoutLoss) {
  ASSERT_TRUE(run(exported("ada"), services));
  expect_taken(imported("ada"));
  ASSERT_TRUE(write_whole_file(folder / "ada.tar", tar_of(folder / "ada")));
  expect_taken(imported("ada.tar"));

  auto sealed = exported("ada.age");
  sealed.passphrase = folder / "passphrase";
  ASSERT_TRUE(run(sealed, services));
  auto by_passphrase = imported("ada.age");
  EXPECT_NE(refused(by_passphrase).find("is sealed"), std::string::npos);
  by_passphrase.passphrase = folder / "key";
  EXPECT_NE(refused(by_passphrase).find("another key or passphrase"), std::string::npos);
  by_passphrase.passphrase = folder / "passphrase";
  expect_taken(by_passphrase);

  const auto key = storage::age_identity(read_text(folder / "key"));
  ASSERT_TRUE(key);
  const auto to_key =
      storage::age_seal(storage::AgeRecipient(storage::recovery_public(*key)), bytes_in(folder / "ada.tar"));
  ASSERT_TRUE(write_whole_file(folder / "key.age", *to_key));
  auto by_key = imported("key.age");
  by_key.identity = folder / "key";
  expect_taken(by_key);
}

TEST_F(SubjectsImport, OnlyWhomAPersonNamesIsBelieved) {
  ASSERT_TRUE(run(exported("ada"), services));
  auto args = imported("ada");
  args.signer.clear();
  EXPECT_EQ(refused(args).find(signer), 0U) << "which key, and what to do";
  args.signer = std::string(64, '0');
  EXPECT_EQ(refused(args).find(signer), 0U);
  // The store's own copies need no word: somebody whose store was set back to before they came.
  fs::remove_all(folder / "to");
  fs::copy(folder / "from", folder / "to");
  {
    const auto to = storage::test::opened(folder / "to", {.reserve_bytes = 0});
    EXPECT_TRUE(to->add_subject({"Somebody else"}));
  }
  args.signer.clear();
  args.same_name = true;
  EXPECT_NE(refused(args).find("somebody with this person's code"), std::string::npos);
  ASSERT_TRUE(
      storage::test::opened(folder / "to", {.reserve_bytes = 0})->erase_subject(storage::SubjectId{1}));
  EXPECT_NE(refused(args).find("was erased from this store"), std::string::npos);
}

TEST_F(SubjectsImport, ANameThatIsThereIsAskedAbout) {
  ASSERT_TRUE(run(exported("ada"), services));
  ASSERT_TRUE(storage::test::opened(folder / "to", {.reserve_bytes = 0})->add_subject({"Ada Canary"}));
  EXPECT_NE(refused(imported("ada")).find("#2: has this name already"), std::string::npos);
  auto args = imported("ada");
  args.same_name = true;
  EXPECT_TRUE(run(args, services));
  args.store = folder / "nowhere";
  EXPECT_FALSE(run(args, services));
  EXPECT_FALSE(fs::exists(folder / "nowhere")) << "no store is made";
}

// Every byte of the tar; of the sealed file every one of its first and last kilobytes, and many between.
TEST_F(SubjectsImport, EveryFlippedByteAndEveryCutIsRefused) {
  auto args = exported("ada");
  ASSERT_TRUE(run(args, services));
  // Only what has to be read; the others are files like these.
  std::vector<fs::path> large;
  for (const auto& entry : fs::directory_iterator(folder / "ada"))
    if (entry.file_size() > 5000) large.push_back(entry.path());
  for (const fs::path& file : large) fs::remove(file);
  {
    const auto from = storage::test::opened(folder / "from", {.reserve_bytes = 0});
    for (const char* made : {"person.record", "manifest.json", "signature.json"})
      fs::remove(folder / "ada" / made);
    const auto ada = from->subject(storage::SubjectId{1});
    const auto enrolments = from->enrolments(storage::SubjectId{1});
    ASSERT_TRUE(write_manifest(*from, {*ada, enrolments->back(), {}}, folder / "ada", "ada"));
  }
  const Bytes good = tar_of(folder / "ada");
  const auto accepted = [](std::span<const std::byte> tar) {
    const auto files = storage::bundle_files(tar);
    return files && check_bundle(*files);
  };
  ASSERT_TRUE(accepted(good));
  Bytes bad = good;
  for (std::size_t at = 0; at < bad.size(); ++at) {
    const auto was = std::exchange(bad[at], bad[at] ^ std::byte(static_cast<unsigned char>(1U << at % 8)));
    EXPECT_FALSE(accepted(bad)) << at;
    bad[at] = was;
  }
  for (std::size_t size = 0; size < good.size(); size += 1 + size / 40)
    EXPECT_FALSE(accepted(std::span(good).first(size))) << size;
  bad.push_back({});
  EXPECT_FALSE(accepted(bad));

  const auto key = storage::age_identity(read_text(folder / "key"));
  Bytes sealed = *storage::age_seal(storage::AgeRecipient(storage::recovery_public(*key)), good);
  const auto opens = [&](std::span<const std::byte> bytes) {
    return storage::age_open(&*key, bytes).has_value();
  };
  ASSERT_TRUE(opens(sealed));
  for (std::size_t at = 0; at < sealed.size(); at += at < 1000 || at + 1000 > sealed.size() ? 1 : 97) {
    sealed[at] ^= std::byte{4};
    EXPECT_FALSE(opens(sealed)) << at;
    sealed[at] ^= std::byte{4};
  }
  for (std::size_t size = 0; size < sealed.size(); size += 1 + size / 40)
    EXPECT_FALSE(opens(std::span(sealed).first(size))) << size;
}

// What a person would try, through the command.
TEST_F(SubjectsImport, WhatIsExchangedMissingAddedOrLeadsElsewhereIsNamed) {
  const auto copy = folder / "ada";
  const auto spoiled = [&](const std::function<void()>& spoil) {
    fs::remove_all(copy);
    EXPECT_TRUE(run(exported("ada"), services));
    spoil();
    return refused(imported("ada"));
  };
  EXPECT_NE(spoiled([&] { fs::remove(copy / "manifest.json"); }).find("manifest.json: is not there"),
            std::string::npos);
  EXPECT_NE(spoiled([&] { fs::remove(copy / "signature.json"); }).find("signature.json: is not there"),
            std::string::npos);
  EXPECT_NE(spoiled([&] { fs::remove(copy / "model.glb"); }).find("model.glb: is missing"),
            std::string::npos);
  EXPECT_NE(spoiled([&] { write_text(copy / "more.txt", "more"); }).find("more.txt: is not in the manifest"),
            std::string::npos);
  EXPECT_NE(spoiled([&] {
              fs::rename(copy / "model.ply", copy / "x");
              fs::rename(copy / "model.stl", copy / "model.ply");
              fs::rename(copy / "x", copy / "model.stl");
            }).find("is not what the manifest says"),
            std::string::npos);
  EXPECT_NE(spoiled([&] {
              fs::remove(copy / "model.ply");
              fs::create_symlink("/etc/hostname", copy / "model.ply");
            }).find("model.ply: is no file"),
            std::string::npos);
  EXPECT_NE(spoiled([&] {
              fs::remove(copy / "model.ply");
              fs::create_directory(copy / "model.ply");
            }).find("model.ply: is no file"),
            std::string::npos);
  // Another's record under this one's manifest.
  EXPECT_NE(spoiled([&] {
              auto record = bytes_in(copy / "person.record");
              record[13] ^= std::byte{1};
              fs::remove(copy / "person.record");
              EXPECT_TRUE(write_whole_file(copy / "person.record", record));
            }).find("person.record: is not what the manifest says"),
            std::string::npos);

  fs::remove_all(copy);
  ASSERT_TRUE(run(exported("ada"), services));
  auto files = *read_bundle_folder(copy);
  for (const char* name : {"../model.ply", "/etc/passwd", "a/b", "..", ".bashrc"}) {
    files.front().name = name;
    ASSERT_TRUE(write_whole_file(folder / "bad.tar", *storage::bundle_bytes(files)));
    EXPECT_NE(refused(imported("bad.tar")).find("would lie outside of it"), std::string::npos) << name;
  }
  write_text(folder / "bad.tar", "no tar at all");
  EXPECT_NE(refused(imported("bad.tar")).find("bad.tar: this is no bundle"), std::string::npos);
  EXPECT_NE(refused(imported("nothing")).find("nothing: there is no such file"), std::string::npos);
}

// Hands out nothing as large as a picture.
class NoRoomForPictures final : public std::pmr::memory_resource {
 public:
  NoRoomForPictures() : before_(std::pmr::set_default_resource(this)) {}
  ~NoRoomForPictures() override { std::pmr::set_default_resource(before_); }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (bytes > 200'000) throw std::bad_alloc();
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override {
    std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
  std::pmr::memory_resource* before_;
};

TEST_F(SubjectsImport, AnExportWithoutMemoryForItsPicturesIsNone) {
  const NoRoomForPictures memory;
  const auto told = run(exported("ada"), services);
  ASSERT_FALSE(told);
  EXPECT_EQ(told.error().code, Errc::OutOfMemory);
  EXPECT_FALSE(fs::exists(folder / "ada"));
}

}  // namespace
}  // namespace relievo::firmware
