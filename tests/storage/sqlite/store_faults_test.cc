// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Killed processes, full disks, damaged files, and people who want to be forgotten.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <utility>

#include "storage/export/model_files.h"
#include "storage/sqlite/sqlite_keys.h"
#include "storage/sqlite/sqlite_parts.h"
#include "tests/storage/raw_database.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using relievo::test::TemporaryFolder;
using relievo::test::TinyDisk;
using test::identical;
using test::opened;
using test::sample_enrolment;
using test::sample_model;

// Enrols without end; writes each number to the pipe after the store said it was safe.
[[noreturn]] void enrol_for_ever(const std::filesystem::path& dir, const pipeline::FaceModel& model,
                                 int pipe) {
  static const test::StillClock clock;
  auto store = open_sqlite_store(dir, clock);
  for (; store;) {
    const auto id = (*store)->add_enrolment(NewSubject{"Ada"}, sample_enrolment(model));
    if (!id || ::write(pipe, &*id, sizeof *id) != sizeof *id) break;
  }
  ::_exit(1);
}

TEST(StoreFaults, KilledInTheMiddleNothingIsHalfAndNothingIsLost) {
  const TemporaryFolder folder;
  const auto model = sample_model(60);
  std::mt19937 random(7);
  std::vector<EnrolmentId> acknowledged;
  for (int round = 0; round < 15; ++round) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::close(ends[0]);
      enrol_for_ever(folder.path(), model, ends[1]);
    }
    ::close(ends[1]);
    EnrolmentId id{};
    // Let it come to work, then strike at any moment.
    if (::read(ends[0], &id, sizeof id) == sizeof id) acknowledged.push_back(id);
    ::usleep(static_cast<useconds_t>(random() % 20'000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it gave up by itself";
    while (::read(ends[0], &id, sizeof id) == sizeof id) acknowledged.push_back(id);
    ::close(ends[0]);

    const auto store = opened(folder.path());
    ASSERT_TRUE(store);
    ASSERT_TRUE(store->check());
    for (const EnrolmentId safe : acknowledged)
      ASSERT_TRUE(store->enrolment(safe)) << "acknowledged and lost";
    const auto people = store->subjects({});
    for (const auto& person : *people) ASSERT_EQ(person.enrolments, 1) << "half an enrolment";
    ASSERT_TRUE(identical(model, *store->load_model(acknowledged.back(), std::pmr::new_delete_resource())));
  }
  EXPECT_GE(acknowledged.size(), 15u);
}

// Fills a store until it is full; then nothing is half, room can be made, and work goes on.
void fill_and_recover(const std::filesystem::path& dir, const SqliteStoreOptions& options) {
  const auto model = sample_model(40);
  auto store = opened(dir, options);
  ASSERT_TRUE(store);
  int enrolled = 0;
  Result<EnrolmentId> id = EnrolmentId{};
  while (enrolled < 500 && (id = store->add_enrolment(NewSubject{"Ada"}, sample_enrolment(model))))
    ++enrolled;
  ASSERT_FALSE(id);
  EXPECT_EQ(id.error().code, Errc::MediaFull) << id.error().what.view() << " " << id.error().sys_errno;
  EXPECT_NE(id.error().what.view().find("full"), std::string_view::npos);
  ASSERT_GT(enrolled, 0);
  for (int again = 0; again < 3; ++again)
    EXPECT_FALSE(store->add_enrolment(NewSubject{"Ada"}, sample_enrolment(model)));
  EXPECT_EQ(store->subjects({})->size(), static_cast<std::size_t>(enrolled));
  EXPECT_TRUE(store->check());
  store.reset();
  store = opened(dir, options);
  ASSERT_TRUE(store) << "a full store opens";
  ASSERT_TRUE(store->check());
  EXPECT_EQ(store->subjects({})->size(), static_cast<std::size_t>(enrolled));
  // Which is the way out that the message names.
  ASSERT_TRUE(store->erase_subject(store->subjects({})->front().id));
  EXPECT_TRUE(store->add_enrolment(NewSubject{"Bob"}, sample_enrolment(model)));
  EXPECT_TRUE(store->check());
}

TEST(StoreFaults, AStoreAtItsLimitIsFullInOrder) {
  const TemporaryFolder folder;
  fill_and_recover(folder.path(), {.max_bytes = 2'000'000});
}

TEST(StoreFaults, AFullDiskIsSurvived) {
  const TinyDisk disk(4'000'000);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  fill_and_recover(disk.path() / "store", {.reserve_bytes = 900'000});
}

// Every try of a PIN is counted before it is judged, every export is noted before it leaves: without room
// nobody could sign in and make some.
TEST(StoreFaults, OnADiskThatAnotherProgramFilledTheStaffComeInExportAndErase) {
  const TinyDisk disk(4'000'000);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  const auto store = opened(disk.path() / "store", {.reserve_bytes = 900'000});
  ASSERT_TRUE(store);
  const auto ada = store->add_enrolment(NewSubject{"Ada"}, sample_enrolment(sample_model(40)));
  ASSERT_TRUE(ada);
  // It takes what becomes free, too: a setting must not use up what an erasure needs.
  for (int round = 0; round < 5; ++round) {
    std::ofstream junk(disk.path() / "junk", std::ios::binary | std::ios::app);
    for (const std::string block(4096, 'x'); junk << block << std::flush;) {
    }
    EXPECT_TRUE(store->set_setting("pin", std::string(40'000, '7'))) << round;
    EXPECT_TRUE(store->append_audit({"enrolment.exported", {}, std::string(9'000, '1')})) << round;
    EXPECT_TRUE(std::filesystem::exists(disk.path() / "store" / "relievo.reserve")) << round;
  }
  EXPECT_TRUE(store->erase_subject(store->enrolment(*ada)->subject));
  EXPECT_TRUE(store->check());
}

TEST(StoreFaults, ADiskTooSmallForAnEmptyStoreSaysSo) {
  const TinyDisk disk(16'384);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  const test::StillClock clock;
  const auto store = open_sqlite_store(disk.path() / "store", clock);
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().code, Errc::MediaFull) << store.error().what.view();
}

// Whoever was told that there is none would make another.
TEST(StoreFaults, AStoreThatMayNotBeReadIsNotCalledMissing) {
  const TemporaryFolder folder;
  const auto dir = folder / "store";
  std::filesystem::create_directory(folder / "empty");
  ASSERT_TRUE(opened(dir, test::kNoReserve));
  const test::StillClock clock;
  const SqliteStoreOptions to_read{.mode = OpenMode::ReadOnly};
  const auto code = [&](const std::filesystem::path& at) {
    return test::code_of(open_sqlite_store(at, clock, to_read));
  };
  const bool root = ::geteuid() == 0;  // reads everything
  for (const auto& locked : {dir, folder.path()}) {
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
    std::filesystem::permissions(locked, std::filesystem::perms(0));
    ASSERT_TRUE(!root || ::seteuid(65'534) == 0);
    EXPECT_EQ(code(dir), Errc::IoFailed) << locked;
    EXPECT_EQ(test::code_of(keep_sqlite_store(dir, clock, {})->rekey({})), Errc::IoFailed) << locked;
    ASSERT_TRUE(!root || ::seteuid(0) == 0);
    std::filesystem::permissions(locked, std::filesystem::perms(0755));
  }
  EXPECT_EQ(code(folder / "none"), Errc::NotFound);
  EXPECT_EQ(code(folder / "empty"), Errc::NotFound);
  EXPECT_TRUE(open_sqlite_store(dir, clock, to_read));
}

TEST(StoreFaults, OnADiskThatMayOnlyBeReadACopyIsAskedFor) {
  const TinyDisk disk(4'000'000);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  ASSERT_TRUE(opened(disk.path() / "store", test::kNoReserve));
  ASSERT_TRUE(disk.protect(true));
  const test::StillClock clock;
  const auto store = open_sqlite_store(disk.path() / "store", clock, {.mode = OpenMode::ReadOnly});
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().code, Errc::IoFailed);
  EXPECT_EQ(store.error().sys_errno, EROFS);
  EXPECT_NE(store.error().what.view().find("make a copy"), std::string_view::npos);
}

TEST(StoreFaults, AnExportOntoAFullDiskLeavesItAsItWas) {
  const TinyDisk disk(300'000);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  const auto small = sample_model(10), large = sample_model(90);
  ASSERT_TRUE(write_model_files(small, disk.path(), ExportFrame::Head));
  const auto names = relievo::test::listing(disk.path());
  const auto bytes = test::all_bytes(disk.path());
  const auto written = write_model_files(large, disk.path(), ExportFrame::Head);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::MediaFull);
  EXPECT_NE(written.error().where().find("model."), std::string_view::npos);
  EXPECT_EQ(relievo::test::listing(disk.path()), names);
  EXPECT_TRUE(test::all_bytes(disk.path()) == bytes) << "the older files are whole";
}

TEST(StoreFaults, AFileSizeLimitIsNoCrash) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{400'000, 400'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    static const test::StillClock clock;
    const auto store = open_sqlite_store(folder / "store", clock, {.reserve_bytes = 0});
    const auto model = sample_model(90);
    if (!store) ::_exit(2);
    const auto id = (*store)->add_enrolment(NewSubject{"Ada"}, sample_enrolment(model));
    if (id || id.error().code != Errc::MediaFull) ::_exit(3);
    const auto files = write_model_files(model, folder / "out", ExportFrame::Head);
    if (files || files.error().code != Errc::MediaFull) ::_exit(4);
    ::_exit((*store)->subjects({})->empty() && (*store)->check() ? 0 : 5);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(relievo::test::listing(folder / "out"), "");
}

// Neither opening nor checking nor reading a damaged store crashes, and none passes off other numbers.
TEST(StoreFaults, DamageAnywhereIsNoticedOrHarmless) {
  const TemporaryFolder folder;
  const auto model = sample_model(16);
  {
    const auto store = opened(folder / "good");
    ASSERT_TRUE(store->save_calibration(test::sample_calibration(), "rig"));
    ASSERT_TRUE(store->add_enrolment(NewSubject{"Ada"}, sample_enrolment(model)));
  }
  const auto good = relievo::test::read_text(folder / "good/relievo.db");
  std::mt19937 random(11);
  const test::StillClock clock;
  int noticed = 0;
  for (int round = 0; round < 150; ++round) {
    auto bytes = good;
    if (round % 3 == 0) bytes.resize(random() % bytes.size());
    else
      for (unsigned i = 0; i < 1 + random() % 40; ++i)
        bytes[random() % bytes.size()] = static_cast<char>(random());
    const TemporaryFolder place;
    relievo::test::write_text(place / "relievo.db", bytes);
    const auto store = open_sqlite_store(place.path(), clock);
    if (!store) {
      ++noticed;
      continue;
    }
    if (!(*store)->check()) ++noticed;
    const auto loaded = (*store)->load_model(EnrolmentId{1}, std::pmr::new_delete_resource());
    if (loaded) {
      EXPECT_TRUE(identical(model, *loaded)) << round;
    }
    (void)(*store)->subjects({}).has_value();
    (void)(*store)->add_subject({"Bob"}).has_value();
  }
  EXPECT_GT(noticed, 75);
}

TEST(StoreFaults, NoDatabaseAtAllIsCalledDamaged) {
  const TemporaryFolder folder;
  relievo::test::write_text(folder / "relievo.db", std::string(8192, 'x'));
  const test::StillClock clock;
  const auto store = open_sqlite_store(folder.path(), clock);
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().code, Errc::StoreCorrupt);
}

// Of a person that was erased not even what was sealed is left, in no file, while the store is open and
// after: neither the wrapped key nor a run of any value.
TEST(StoreFaults, ErasedMeansGone) {
  const TemporaryFolder folder;
  auto store = opened(folder.path());
  ASSERT_TRUE(store);
  std::vector<SubjectId> erased;
  std::vector<EnrolmentId> kept;
  std::string ids;
  for (unsigned i = 0; i < 40; ++i) {
    const auto model = sample_model(static_cast<int>(8 + i), i + 1);
    const auto id = store->add_enrolment(NewSubject{"Person " + std::to_string(i)}, sample_enrolment(model));
    ASSERT_TRUE(id);
    if (i % 3 == 0) {
      kept.push_back(*id);
      continue;
    }
    erased.push_back(store->enrolment(*id)->subject);
    ids += (ids.empty() ? "" : ",") + std::to_string(static_cast<std::int64_t>(erased.back()));
  }
  std::vector<std::string> traces;
  for (const char* value :
       {"substr(slots, 4097 + 72 * subject.id, 72)", "substr(name, 1, 24)", "substr(code, 1, 24)",
        "substr(name_hash, 1, 24)", "code_hash", "substr(enrolment.record, 8, 24)",
        "substr(consent.record, 8, 24)", "substr(bytes, 1, 24)", "substr(bytes, length(bytes) / 2, 24)",
        "substr(bytes, length(bytes) - 24)"}) {
    for (const auto& hex :
         test::Raw(folder / "relievo.db")
             .rows(std::string("SELECT hex(") + value +
                   ") FROM subject_key, subject JOIN enrolment ON subject_id = subject.id JOIN consent ON "
                   "consent.enrolment_id = enrolment.id JOIN model ON model.enrolment_id = "
                   "enrolment.id WHERE subject.id IN (" +
                   ids + ")")) {
      std::string& trace = traces.emplace_back();
      for (std::size_t at = 0; at + 2 < hex.size(); at += 2)
        trace += static_cast<char>(std::stoi(hex.substr(at, 2), nullptr, 16));
    }
  }
  const auto count = [&] {
    const auto bytes = test::all_bytes(folder.path());
    return std::ranges::count_if(traces,
                                 [&](const auto& trace) { return bytes.find(trace) != std::string::npos; });
  };
  ASSERT_EQ(traces.size(), 10 * erased.size());
  ASSERT_GT(count(), static_cast<long>(traces.size()) * 9 / 10) << "the search finds what is there";
  for (const SubjectId id : erased) ASSERT_TRUE(store->erase_subject(id));
  EXPECT_EQ(count(), 0);
  EXPECT_TRUE(store->check());
  for (const EnrolmentId id : kept) EXPECT_TRUE(store->load_model(id, std::pmr::new_delete_resource()));
  store.reset();
  EXPECT_EQ(count(), 0);
}

// Where the key lies the disk is full, once.
class FullOnce final : public KeySource {
 public:
  explicit FullOnce(const std::filesystem::path& file) : real_(key_file(file)) {}
  Result<void> read(SecretKey& key) override {
    if (std::exchange(full_, false)) return Error{Errc::MediaFull, "as the test says"};
    return real_->read(key);
  }
  Result<void> make_next(SecretKey& key) override { return real_->make_next(key); }
  Result<void> read_next(SecretKey& key) override { return real_->read_next(key); }
  Result<void> take_next() override { return real_->take_next(); }
  std::string_view protects() const override { return real_->protects(); }

 private:
  std::unique_ptr<KeySource> real_;
  bool full_ = true;
};

TEST(StoreFaults, WhoOnlyReadsNeverBeginsToWrite) {
  const TemporaryFolder folder;
  ASSERT_TRUE(opened(folder.path())->add_subject({"Ada"}));
  ASSERT_TRUE(std::filesystem::exists(folder / "relievo.reserve"));
  SqliteStoreOptions options{.mode = OpenMode::ReadOnly};
  options.keys = std::make_shared<FullOnce>(folder / "relievo.key");
  static const test::StillClock clock;
  EXPECT_EQ(test::code_of(open_sqlite_store(folder.path(), clock, options)), Errc::MediaFull);
  EXPECT_TRUE(std::filesystem::exists(folder / "relievo.reserve")) << "it is whose who writes";
}

// A stream whose state was wiped seals as one that was never begun: in its state are zeros.
bool is_wiped(SealedStream& stream) {
  const std::vector<std::byte> plain(10);
  const Place place{"model", "bytes", 1};
  const auto sealed = stream.seal_piece(place, plain, true);
  const std::vector<std::byte> by_it(sealed.begin(), sealed.end());
  auto fresh = SealedStream::make();
  const auto by_fresh = fresh->seal_piece(place, plain, true);
  return std::ranges::equal(by_it, by_fresh);
}

TEST(StoreFaults, AModelThatFailsLeavesNoKeyInTheStream) {
  const TemporaryFolder folder;
  Database database(folder / "db");
  ASSERT_TRUE(database.open(true));
  const auto keys = StoreKeys::make(key_file(folder / "key"));
  ASSERT_TRUE(keys);
  const std::vector<std::byte> blob(1000, std::byte{7});
  EXPECT_FALSE(seal_model(database, **keys, EnrolmentId{1}, blob)) << "there is no table";
  EXPECT_TRUE(is_wiped((*keys)->stream()));
  ASSERT_TRUE(database.run("CREATE TABLE model (enrolment_id INTEGER PRIMARY KEY, nonce BLOB, bytes BLOB)"));
  ASSERT_TRUE(seal_model(database, **keys, EnrolmentId{1}, blob));
  (*keys)->stream().end();
  EXPECT_EQ(*open_model(database, **keys, EnrolmentId{1}), blob);
  (*keys)->stream().end();
  ASSERT_TRUE(database.run("UPDATE model SET bytes = zeroblob(length(bytes))"));
  EXPECT_FALSE(open_model(database, **keys, EnrolmentId{1}));
  EXPECT_TRUE(is_wiped((*keys)->stream()));
}

}  // namespace
}  // namespace relievo::storage
