// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that runs out, at every allocation of ours, of the standard library's and of SQLite's in turn,
// over a whole life of a store: open, enrol, export, load, erase, close.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "storage/export/model_files.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace {

std::atomic<long> g_left{-1};  // allocations until one fails; below zero: none fails
std::atomic<bool> g_for_good{false};
std::atomic<long> g_failed{0};

bool must_fail() {
  if (g_left < 0) return false;
  if (g_left > 0) {
    --g_left;
    return false;
  }
  ++g_failed;
  if (!g_for_good) g_left = -1;
  return true;
}

sqlite3_mem_methods g_real{};

void* sqlite_malloc(int bytes) { return must_fail() ? nullptr : g_real.xMalloc(bytes); }
void* sqlite_realloc(void* old, int bytes) { return must_fail() ? nullptr : g_real.xRealloc(old, bytes); }

}  // namespace

// Not inlined: the compiler would see free() of what a new made, and object.
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return must_fail() ? nullptr : std::malloc(bytes == 0 ? 1 : bytes);
}
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  void* block = must_fail() ? nullptr : std::malloc(bytes == 0 ? 1 : bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace relievo::storage {
namespace {

using relievo::test::TemporaryFolder;

class FailingMemory {
 public:
  FailingMemory() {
    sqlite3_shutdown();
    sqlite3_config(SQLITE_CONFIG_GETMALLOC, &g_real);
    auto methods = g_real;
    methods.xMalloc = sqlite_malloc;
    methods.xRealloc = sqlite_realloc;
    EXPECT_EQ(sqlite3_config(SQLITE_CONFIG_MALLOC, &methods), SQLITE_OK);
    sqlite3_initialize();
  }
  ~FailingMemory() {
    g_left = -1;
    sqlite3_shutdown();
    sqlite3_config(SQLITE_CONFIG_MALLOC, &g_real);
    sqlite3_initialize();
  }
};

// One life; the error of the first verb that has one. `acknowledged` counts enrolments said to be safe.
Result<void> live(const std::filesystem::path& dir, const std::filesystem::path& out,
                  const NewEnrolment& enrolment, const SubjectChoice& ada, int& acknowledged) {
  static const test::StillClock clock;
  RELIEVO_TRY_ASSIGN(const auto store, open_sqlite_store(dir, clock));
  RELIEVO_TRY_ASSIGN(const auto bob, store->add_subject({"Bob"}));
  RELIEVO_TRY_ASSIGN(const auto id, store->add_enrolment(ada, enrolment));
  ++acknowledged;
  RELIEVO_TRY_ASSIGN(const auto back, store->load_model(id, std::pmr::new_delete_resource()));
  RELIEVO_TRY_ASSIGN(const auto files, write_model_files(back, out, ExportFrame::Head));
  RELIEVO_TRY_ASSIGN(const auto found, store->subjects({.name = "Ada"}));
  return store->erase_subject(bob);
}

// What must hold after whatever happened.
void judge(const std::filesystem::path& dir, const pipeline::FaceModel& model, int acknowledged, long point) {
  const auto store = test::opened(dir);
  ASSERT_TRUE(store) << point;
  const auto sound = store->check();
  ASSERT_TRUE(sound) << point << " " << sound.error().what.view();
  const auto adas = store->subjects({.name = "Ada"});
  ASSERT_TRUE(adas);
  EXPECT_GE(static_cast<int>(adas->size()), acknowledged) << point;
  for (const auto& ada : *adas) {
    const auto enrolments = store->enrolments(ada.id);
    ASSERT_EQ(enrolments->size(), 1u) << point << ": half an enrolment";
    EXPECT_TRUE(
        test::identical(model, *store->load_model(enrolments->front().id, std::pmr::new_delete_resource())));
  }
  if (!std::filesystem::exists(dir / "out")) return;
  const auto left = relievo::test::listing(dir / "out");
  EXPECT_EQ(left.find(".part"), std::string::npos) << point << " " << left;
}

long try_every_point(bool for_good, long step) {
  const FailingMemory memory;
  const auto model = test::sample_model(12);
  const auto enrolment = test::sample_enrolment(model);
  const SubjectChoice ada = NewSubject{"Ada"};
  long points = 0;
  for (long point = 0;; point += step) {
    const TemporaryFolder folder;
    const auto dir = folder / "store";
    const auto out = dir / "out";
    int acknowledged = 0;
    g_for_good = for_good;
    g_failed = 0;
    g_left = point;
    const auto lived = live(dir, out, enrolment, ada, acknowledged);
    g_left = -1;
    if (g_failed == 0) {
      EXPECT_TRUE(lived);
      return points;
    }
    ++points;
    // A few libraries get by without: then the life went on.
    if (!lived) {
      EXPECT_TRUE(lived.error().code == Errc::OutOfMemory) << point << ": " << lived.error().what.view();
    }
    judge(dir, model, acknowledged, point);
    if (::testing::Test::HasFatalFailure()) return points;
  }
}

// About two thousand points, each a life of a store: every eleventh, or all of them where asked for.
long stride() { return std::getenv("RELIEVO_EVERY_POINT") != nullptr ? 1 : 11; }

TEST(SqliteMemory, OneFailureAtAnyPointHarmsNothing) {
  EXPECT_GT(try_every_point(false, stride()) * stride(), 1000);
}

TEST(SqliteMemory, FailureForGoodFromAnyPointHarmsNothing) {
  EXPECT_GT(try_every_point(true, stride()) * stride(), 1000);
}

}  // namespace
}  // namespace relievo::storage
