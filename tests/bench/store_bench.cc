// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What sealing costs: the store beside plain SQLite of the same rows, the same settings, on the same disk.
//   store_bench FOLDER [SUBJECTS]     default 100000, each with one small enrolment; needs a gigabyte in
//   FOLDER
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "storage/model_blob.h"
#include "storage/sqlite/sqlite_parts.h"
#include "storage/text.h"
#include "tests/storage/sample.h"

namespace {

using namespace relievo;           // NOLINT(google-build-using-namespace)
using namespace relievo::storage;  // NOLINT(google-build-using-namespace)

constexpr std::size_t kSmallBytes = 2000;  // a model that stands for a thumbnail

template <typename T>
T must(Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "%s: %s\n", std::string(result.error().where()).c_str(),
                 std::string(result.error().what.view()).c_str());
    std::exit(1);
  }
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

double ms_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}
double median_ms(int times, const std::function<void()>& work) {
  std::vector<double> all;
  for (int i = 0; i < times; ++i) all.push_back(ms_of(work));
  std::ranges::sort(all);
  return all[all.size() / 2];
}

std::string name_of(int i) {
  return "Given-" + std::to_string(i * 7919 % 100'003) + " Family-" + std::to_string(i);
}
std::int64_t code_of(int i) { return 100'000'000'000 + 7'777 * std::int64_t{i}; }

void fill_sealed(const std::filesystem::path& dir, int first, int last) {
  auto keys = must(StoreKeys::make(key_file(dir / kKeyFile)));
  Database database(dir / kStoreFile);
  must(database.open(true));
  must(database.tidy_up_on_close(true));
  must(keys->load(database, false));
  const std::vector<std::byte> small(kSmallBytes, std::byte{1});
  Transaction transaction(database);
  must(transaction.begin());
  for (int i = first; i < last; ++i) {
    must(must(database.prepare("INSERT INTO subject (id, created_at_ms, name) VALUES (?, 1, x'00')"))
             .bind(i)
             .run());
    must(seal_subject(database, *keys, SubjectId{i}, name_of(i), code_of(i)));
    must(must(database.prepare("INSERT INTO enrolment (id, subject_id, created_at_ms) VALUES (?, ?, 1)"))
             .bind(i)
             .bind(i)
             .run());
    must(seal_enrolment(database, *keys, EnrolmentId{i}, "algorithms", "report"));
    must(must(database.prepare("INSERT INTO consent (enrolment_id) VALUES (?)")).bind(i).run());
    must(seal_consent(database, *keys, EnrolmentId{i}, {"2026-03", "en", {}}));
    must(seal_model(database, *keys, EnrolmentId{i}, small));
  }
  must(transaction.commit());
}

constexpr const char* kPlain =
    "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA wal_autocheckpoint = 100; PRAGMA secure_delete = ON;"
    "CREATE TABLE IF NOT EXISTS subject (id INTEGER PRIMARY KEY, created_at_ms INTEGER, name TEXT, receipt INTEGER);"
    "CREATE UNIQUE INDEX IF NOT EXISTS codes ON subject (receipt); CREATE INDEX IF NOT EXISTS names ON subject (name);"
    "CREATE TABLE IF NOT EXISTS enrolment (id INTEGER PRIMARY KEY, subject_id INTEGER, created_at_ms INTEGER, "
    "algorithms TEXT, report TEXT, wording TEXT, language TEXT, given_at_ms INTEGER);"
    "CREATE INDEX IF NOT EXISTS of_subject ON enrolment (subject_id);"
    "CREATE TABLE IF NOT EXISTS model (enrolment_id INTEGER PRIMARY KEY, bytes BLOB)";

void put_plain(Database& database, int i, std::span<const std::byte> model) {
  must(must(database.prepare("INSERT INTO subject VALUES (?, 1, ?, ?)"))
           .bind(i)
           .bind(name_of(i))
           .bind(code_of(i))
           .run());
  must(must(database.prepare(
                "INSERT INTO enrolment VALUES (?, ?, 1, 'algorithms', 'report', '2026-03', 'en', 0)"))
           .bind(i)
           .bind(i)
           .run());
  must(must(database.prepare("INSERT INTO model VALUES (?, ?)"))
           .bind(i)
           .bind(Zeros{static_cast<std::int64_t>(model.size())})
           .run());
  must(must(Blob::open(database, "model", "bytes", i, true)).write(0, model));
}

int rows(Database& database, const std::string& sql) {
  auto query = must(database.prepare(sql));
  int count = 0;
  while (must(query.step())) ++count;
  return count;
}

void print(const char* what, double sealed, double plain, const char* aim) {
  std::printf("%-44s %9.2f ms %9.2f ms   %s\n", what, sealed, plain, aim);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "store_bench FOLDER [SUBJECTS]\n"), 2;
  const std::filesystem::path folder = argv[1], dir = folder / "sealed", file = folder / "plain.db";
  const int subjects = argc > 2 ? std::atoi(argv[2]) : 100'000;
  std::filesystem::create_directories(folder);
  (void)test::opened(dir);
  std::printf("%-20s %14s %14s\n", "subjects", "sealed file", "plain file");
  Database plain(file);
  must(plain.open(true));
  must(plain.run(kPlain));
  const std::vector<std::byte> small(kSmallBytes, std::byte{1});
  for (int part = 0; part < 5; ++part) {
    const int first = 1 + subjects / 5 * part, last = 1 + subjects / 5 * (part + 1);
    fill_sealed(dir, first, last);
    Transaction transaction(plain);
    must(transaction.begin());
    for (int i = first; i < last; ++i) put_plain(plain, i, small);
    must(transaction.commit());
    must(plain.integer("PRAGMA wal_checkpoint(TRUNCATE)"));
    std::printf("%-20d %11.1f MB %11.1f MB\n", last - 1,
                static_cast<double>(std::filesystem::file_size(dir / kStoreFile)) / 1e6,
                static_cast<double>(std::filesystem::file_size(file)) / 1e6);
  }
  const auto model = test::sample_model(400);
  const auto enrolment = test::sample_enrolment(model);

  // Killed while it enrols.
  const auto killed = [&](const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
      work();
      ::pause();
    }
    ::usleep(1'500'000);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  };
  killed([&] {
    auto store = test::opened(dir);
    for (;;) must(store->add_enrolment(NewSubject{"Ada"}, enrolment));
  });
  std::unique_ptr<Store> store;
  const double open_sealed = ms_of([&] { store = test::opened(dir); });
  plain.close();
  Database again(file);
  const double open_plain = ms_of([&] {
    must(again.open(true));
    must(again.run(kPlain));
    must(again.integer("PRAGMA wal_checkpoint(TRUNCATE)"));
  });
  std::printf("\n%-44s %12s %12s\n", "", "sealed", "plain");
  print("opening after a kill", open_sealed, open_plain, "aim 1000 ms");

  const int middle = subjects / 2;
  const auto search = [&](const char* what, const SubjectFilter& filter, const std::string& sql,
                          const char* aim) {
    std::size_t found = 0;
    const double sealed = median_ms(9, [&] { found = must(store->subjects(filter)).size(); });
    int rows_found = 0;
    const double beside = median_ms(9, [&] { rows_found = rows(again, sql); });
    print((what + std::string(": ") + std::to_string(found) + " found").c_str(), sealed, beside, aim);
  };
  const std::string count =
      "SELECT *, (SELECT count(*) FROM enrolment WHERE subject_id = subject.id) FROM subject ";
  search("the first page of the list", {.limit = 50}, count + "ORDER BY id DESC LIMIT 50", "aim 50 ms");
  search("its last page", {.skip = subjects - 50, .limit = 50},
         count + "ORDER BY id DESC LIMIT 50 OFFSET " + std::to_string(subjects - 50), "aim 50 ms");
  std::int64_t counted = 0;
  const double count_sealed = median_ms(9, [&] { counted = must(store->count_subjects()); });
  const double count_plain = median_ms(9, [&] { rows(again, "SELECT count(*) FROM subject"); });
  print(("how many there are: " + std::to_string(counted)).c_str(), count_sealed, count_plain, "aim 50 ms");
  const double tenths = median_ms(9, [&] {
    for (int i = 0; i < 10; ++i) must(store->subjects({.skip = subjects / 10 * i, .limit = 1}));
  });
  print("the tops of ten stretches, to jump to one", tenths, 0, "aim 100 ms");
  search("a whole name", {.name = name_of(middle)}, count + "WHERE name = '" + name_of(middle) + "'",
         "aim 50 ms");
  search("a code", {.receipt = code_of(middle)}, count + "WHERE receipt = " + std::to_string(code_of(middle)),
         "aim 50 ms");

  const auto named = [&](std::string_view part) {
    return median_ms(9, [&] {
      std::size_t found = 0;
      must(store->for_each_subject(Store::Opened::Names,
                                   [&](Subject& subject, const Consent*) -> Result<void> {
                                     found += contains_name(subject.name, part);
                                     return {};
                                   }));
    });
  };
  print("a part of a name", named("family-" + std::to_string(middle)), 0, "aim 500 ms");
  print("a part that nobody has", named("nobody"), 0, "aim 500 ms");

  std::size_t agreed = 0;
  const double opened = median_ms(9, [&] {
    agreed = 0;
    must(store->for_each_subject(Store::Opened::NamesAndConsents,
                                 [&](Subject&, const Consent* newest) -> Result<void> {
                                   agreed += newest != nullptr;
                                   return {};
                                 }));
  });
  print(("all with their newest consent, to filter: " + std::to_string(agreed)).c_str(), opened, 0,
        "aim 500 ms");

  const auto blob = must(encode_model(model));
  int next = 10'000'000;
  std::vector<double> sealed_ms, plain_ms;
  for (int round = 0; round < 21; ++round) {  // in turns: the disk is the same for both
    sealed_ms.push_back(ms_of([&] { must(store->add_enrolment(NewSubject{"Ada"}, enrolment)); }));
    plain_ms.push_back(ms_of([&] {
      const auto bytes = must(encode_model(model));
      Transaction transaction(again);
      must(transaction.begin());
      put_plain(again, ++next, bytes);
      must(transaction.commit());
    }));
  }
  std::ranges::sort(sealed_ms);
  std::ranges::sort(plain_ms);
  char what[80];
  std::snprintf(what, sizeof what, "an enrolment of %.1f MB, committed",
                static_cast<double>(blob.size()) / 1e6);
  print(what, sealed_ms[10], plain_ms[10], "aim 1.3 times");
  std::printf("%-44s %9.2f\n", "  sealed / plain", sealed_ms[10] / plain_ms[10]);
  return 0;
}
