// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Power cuts in the life of a store: nothing that was acknowledged is lost, nothing is half, nobody who was
// erased is left, nothing can be read without the key.
#include <gtest/gtest.h>

#include <algorithm>

#include "hal/base/whole_file.h"
#include "storage/cipher/recovery.h"
#include "storage/model_blob.h"
#include "storage/sodium_sha256.h"
#include "storage/store.h"
#include "tests/power/power_cuts.h"
#include "tests/storage/raw_database.h"
#include "tests/storage/sample.h"
#include "tests/storage/store_of_before.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;
using relievo::test::cut_power;
using relievo::test::PowerLook;
using relievo::test::PowerStep;
using relievo::test::TemporaryFolder;

const SqliteStoreOptions kNoReserve{.reserve_bytes = 0};
const test::StillClock kClock;
constexpr std::string_view kPlain = "Canary";

std::string wrong(const Error& error) {
  return "!" + std::string(error.where()) + ": " + std::string(error.what.view());
}
std::string text(auto number) { return std::to_string(static_cast<std::int64_t>(number)); }

// All that a store tells.
Result<std::string> told_by(Store& store) {
  RELIEVO_TRY(store.check());
  std::string all;
  RELIEVO_TRY_ASSIGN(auto people, store.subjects({}));
  std::ranges::sort(people, {}, &Subject::id);
  for (const Subject& person : people) {
    all += text(person.id) + " " + person.name + " " + text(person.receipt) + "\n";
    RELIEVO_TRY_ASSIGN(const auto enrolments, store.enrolments(person.id));
    for (const Enrolment& one : enrolments) {
      RELIEVO_TRY_ASSIGN(const auto model, store.load_model(one.id, std::pmr::new_delete_resource()));
      RELIEVO_TRY_ASSIGN(const auto bytes, encode_model(model));
      all += "  " + text(one.id) + " " + one.consent.wording + " " + one.report_json;
      for (const std::byte byte : sha256(bytes)) all += " " + text(byte);
      all += "\n";
    }
  }
  RELIEVO_TRY_ASSIGN(const auto calibrations, store.calibrations());
  for (const auto& one : calibrations)
    all += text(one.revision) + " " + one.note + (one.active ? " active\n" : "\n");
  if (const auto language = store.setting("language")) all += "language " + *language + "\n";
  RELIEVO_TRY_ASSIGN(const auto log, store.audit(0, 1000));
  for (const auto& line : log) {
    // Whose erasure was cut off is erased "again" when that is found.
    const bool again = line.event.what == "subject.erased";
    all += text(line.number) + " " + line.event.what + " " + text(line.event.subject) + " " +
           (again ? "" : line.event.detail) + "\n";
  }
  return all;
}

Result<std::string> told_by(const fs::path& dir, const SqliteStoreOptions& options) {
  RELIEVO_TRY_ASSIGN(const auto store, open_sqlite_store(dir, kClock, options));
  return told_by(*store);
}

// What is sealed of a person, as it stands on the disk.
struct Trace {
  std::size_t erased_by;  // the step
  std::string bytes;
};

class StorePower : public ::testing::Test {
 protected:
  StorePower() { fs::create_directory(disk); }

  PowerStep open() {
    return {"open", [this] { return (store = test::opened(dir(), kNoReserve)) != nullptr; }};
  }
  PowerStep close() {
    return {"close", [this] {
              store.reset();
              return true;
            }};
  }
  PowerStep enrol(const SubjectChoice& who, int side = 12, bool renews = false) {
    return {"enrol", [=, this] {
              const auto model = test::sample_model(side, static_cast<unsigned>(side));
              auto enrolment = test::sample_enrolment(model);
              enrolment.report_json = "report of Canary";
              enrolment.renews = renews;
              return store->add_enrolment(who, enrolment).has_value();
            }};
  }
  // From step `erased_by` on nothing of these is left on the disk.
  void remember(SubjectId id, std::size_t erased_by) {
    const std::string hex =
        test::Raw(dir() / "relievo.db")
            .rows("SELECT hex(substr(slots, 4097 + 72 * " + text(id) + ", 72)) FROM subject_key")
            .front();
    std::string& bytes = traces.emplace_back(Trace{erased_by, {}}).bytes;
    for (std::size_t at = 0; at + 2 < hex.size(); at += 2)
      bytes += static_cast<char>(std::stoi(hex.substr(at, 2), nullptr, 16));
  }

  fs::path dir() const { return disk / "store"; }
  std::unique_ptr<StoreKeeping> keeping() const { return keep_sqlite_store(dir(), kClock, kNoReserve); }

  // The store, whichever key it goes by, and the copy of it that stands beside.
  std::string see(const fs::path& at) const {
    auto options = kNoReserve;
    auto told = told_by(at / "store", options);
    if (!told && !words.empty() && told.error().code == Errc::NotFound &&
        keep_sqlite_store(at / "store", kClock, options)->recover(words))
      told = told_by(at / "store", options);
    if (!told && told.error().code == Errc::InvalidInput) {
      options.keys = key_file(at / "stick/key", false);
      told = told_by(at / "store", options);
    }
    if (!told) return wrong(told.error());
    if (test::all_bytes(at / "store").find(kPlain) != std::string::npos) return "!it can be read";
    if (!fs::exists(at / "copy.db")) return *told;
    const TemporaryFolder place;
    fs::copy(at / "store/relievo.key", place / "relievo.key");
    fs::copy(at / "copy.db", place / "relievo.db");
    const auto copy = told_by(place.path(), kNoReserve);
    return copy ? *told + "copy:\n" + *copy : wrong(copy.error());
  }
  std::string raw(const fs::path& at, std::size_t done) const {
    if (!fs::exists(at / "store")) return "";
    const std::string bytes = test::all_bytes(at / "store");
    for (const Trace& trace : traces)
      if (done > trace.erased_by && bytes.find(trace.bytes) != std::string::npos)
        return "!what was to be gone is still there";
    return "";
  }
  relievo::test::PowerCounts cut(const std::vector<PowerStep>& steps) {
    return cut_power(disk, steps,
                     {[this](const fs::path& at) { return see(at); },
                      [this](const fs::path& at, std::size_t done) { return raw(at, done); }, never});
  }

  TemporaryFolder folder;
  fs::path disk = folder / "disk";
  std::unique_ptr<Store> store;
  std::string words, never{kPlain};
  std::vector<Trace> traces;
};

TEST_F(StorePower, FirstStartEnrolRenewErase) {
  const auto counts = cut({
      open(),
      enrol(NewSubject{"Ada Canary"}),
      enrol(NewSubject{"Bob Canary"}, 30),
      enrol(SubjectId{1}, 14),
      {"renew",
       [this] {
         remember(SubjectId{1}, 4);
         return enrol(SubjectId{1}, 16, true).work();
       }},
      {"erase",
       [this] {
         remember(SubjectId{2}, 5);
         return store->erase_subject(SubjectId{2}).has_value();
       }},
      close(),
      open(),
      enrol(NewSubject{"Eva Canary"}),
  });
  EXPECT_EQ(traces.size(), 2U);
  EXPECT_GT(counts.as_before, 10);
  EXPECT_GT(counts.as_after, 10);
}

TEST_F(StorePower, AnOlderStoreIsSealed) {
  const test::OfBefore before(dir(), 3);
  for (const std::string& one : before.traces) traces.push_back({0, one});
  never.clear();  // it was in the clear
  const auto counts = cut({open(), enrol(NewSubject{"Eva Canary"}), close()});
  EXPECT_GT(counts.different, 100);
}

TEST_F(StorePower, AnOlderLogGetsAKeyedEnd) {
  ASSERT_TRUE(open().work() && enrol(NewSubject{"Ada Canary"}).work() && close().work());
  test::set_log_back_to_8(dir());
  test::Raw(dir() / "relievo.db")
      .run("UPDATE store_info SET compatible_version = 8; PRAGMA user_version = 8");
  const auto counts = cut({open(), enrol(NewSubject{"Eva Canary"}), close()});
  EXPECT_GT(counts.different, 10);
}

TEST_F(StorePower, NewKeysWordsAndRecovery) {
  fs::create_directory(disk / "stick");
  ASSERT_TRUE(open().work() && enrol(NewSubject{"Ada Canary"}).work() &&
              enrol(NewSubject{"Bob Canary"}, 20).work() && close().work());
  words = draw_recovery_words();
  const auto counts = cut({
      {"rekey", [this] { return keeping()->rekey({}).has_value(); }},
      {"words", [this] { return test::opened(dir(), kNoReserve)->keep_recovery_words(words).has_value(); }},
      {"lost", [this] { return fs::remove(dir() / "relievo.key") && sync_directory(dir()).has_value(); }},
      {"recover", [this] { return keeping()->recover(words).has_value(); }},
      {"to a stick", [this] { return keeping()->rekey({disk / "stick/key"}).has_value(); }},
  });
  EXPECT_GT(counts.as_before, 10);
  EXPECT_GT(counts.as_after, 10);
}

TEST_F(StorePower, CalibrationsSettingsAndTheLog) {
  const auto counts = cut({
      open(),
      {"save", [this] { return store->save_calibration(test::sample_calibration(), "one").has_value(); }},
      {"setting", [this] { return store->set_setting("language", "eo").has_value(); }},
      {"save", [this] { return store->save_calibration(test::sample_calibration(), "two").has_value(); }},
      {"activate", [this] { return store->activate_calibration(1).has_value(); }},
      {"setting", [this] { return store->set_setting("language", "de").has_value(); }},
      {"log",
       [this] {
         return store->append_audit({"sign-in", {}, "of Canary"}).has_value();
       }},
      close(),
  });
  EXPECT_GT(counts.as_before, 10);
  EXPECT_GT(counts.as_after, 3);
}

TEST_F(StorePower, SomebodyFromAnotherStore) {
  PersonRecord ada;
  {
    const auto other = test::opened(folder / "other", kNoReserve);
    const auto model = test::sample_model(20);
    for (int i = 0; i < 2; ++i)
      ASSERT_TRUE(other->add_enrolment(i == 0 ? SubjectChoice(NewSubject{"Ada Canary"}) : SubjectId{1},
                                       test::sample_enrolment(model)));
    ada = *other->person(SubjectId{1});
  }
  const auto counts = cut({
      open(),
      enrol(NewSubject{"Bob Canary"}),
      {"take in", [&] { return store->add_person(ada).has_value(); }},
      {"erase",
       [this] {
         remember(SubjectId{2}, 3);
         return store->erase_subject(SubjectId{2}).has_value();
       }},
      close(),
  });
  EXPECT_GT(counts.as_before, 10);
  EXPECT_GT(counts.as_after, 3);
}

TEST_F(StorePower, Backup) {
  const auto backup = [this] { return keeping()->backup(disk / "copy.db").has_value(); };
  const auto counts = cut({
      open(),
      enrol(NewSubject{"Ada Canary"}),
      {"backup", backup},
      {"erase",
       [this] {
         remember(SubjectId{1}, 3);
         return store->erase_subject(SubjectId{1}).has_value();
       }},
      enrol(NewSubject{"Bob Canary"}),
      {"backup", backup},
      close(),
  });
  EXPECT_GT(counts.as_before, 10);
  EXPECT_GT(counts.as_after, 10);
}

}  // namespace
}  // namespace relievo::storage
