// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A store that somebody changed who has no key, its file and its log; files that are sealed to us.
#include <algorithm>
#include <iterator>

#include "firmware/records/bundle_manifest.h"
#include "hal/base/assert.h"
#include "storage/cipher/age.h"
#include "storage/cipher/recovery.h"
#include "storage/model_blob.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

using namespace storage;
using storage::test::sample_model;

const SqliteStoreOptions kNoReserve{.reserve_bytes = 0};

struct GoodStore {
  std::string file, log, key;
  GoodStore() {
    const TemporaryFolder folder;
    const auto store = storage::test::opened(folder.path(), kNoReserve);
    const auto model = sample_model(4);
    RELIEVO_ASSERT(store->save_calibration(storage::test::sample_calibration(), "rig").has_value());
    for (const char* name : {"Ada", "Bob"})
      RELIEVO_ASSERT(
          store->add_enrolment(NewSubject{name}, storage::test::sample_enrolment(model)).has_value());
    RELIEVO_ASSERT(store->set_setting("language", "eo").has_value());
    file = read_text(folder / "relievo.db");
    log = read_text(folder / "relievo.db-wal");
    key = read_text(folder / "relievo.key");
  }
};

// Whatever it tells is true.
bool tells_the_truth(Store& store) {
  const bool sound = store.check().has_value();
  if (const auto people = store.subjects({}))
    for (const Subject& person : *people) RELIEVO_ASSERT(person.name == "Ada" || person.name == "Bob");
  for (const int number : {1, 2}) {
    const auto model = store.load_model(EnrolmentId{number}, std::pmr::new_delete_resource());
    RELIEVO_ASSERT(!model || storage::test::identical(*model, sample_model(4)));
    (void)store.enrolments(SubjectId{number}).has_value();
    (void)store.calibration(static_cast<std::uint32_t>(number)).has_value();
  }
  const auto language = store.setting("language");
  RELIEVO_ASSERT(!language || language->empty() || *language == "eo");
  (void)store.calibrations().has_value();
  (void)store.audit(0, 100).has_value();
  return sound;
}

bool store(FuzzBytes input) {
  static const GoodStore good;
  static const TemporaryFolder folder;
  static const storage::test::StillClock clock;
  const std::string bytes = patched(good.file + good.log, input);
  const std::size_t end = std::min(good.file.size(), bytes.size());
  for (const char* left : {"relievo.db-shm", "relievo.erased", "relievo.key.next"})
    std::filesystem::remove(folder / left);
  write_text(folder / "relievo.db", bytes.substr(0, end));
  write_text(folder / "relievo.db-wal", bytes.substr(end));
  write_text(folder / "relievo.key", good.key);
  std::filesystem::permissions(folder / "relievo.key",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  const auto opened = open_sqlite_store(folder.path(), clock, kNoReserve);
  if (!opened) return false;
  const bool sound = tells_the_truth(**opened);
  (void)(*opened)->add_subject({"Eva"}).has_value();
  (void)(*opened)->erase_subject(SubjectId{1}).has_value();
  return sound;
}

const SecretKey& identity() {
  static const SecretKey key = [] {
    auto made = SecretKey::make();
    RELIEVO_ASSERT(made.has_value());
    std::fill(made->bytes().begin(), made->bytes().end(), std::byte{9});
    return std::move(*made);
  }();
  return key;
}

bool age(FuzzBytes input) { return age_open(&identity(), bytes_of(input)).has_value(); }

std::vector<std::string> sealed_files() {
  std::vector<std::string> all;
  for (const std::string plain : {"", "some text"})
    all.push_back(text_of(std::span<const std::byte>(
        *age_seal(AgeRecipient(recovery_public(identity())), std::as_bytes(std::span(plain))))));
  return all;
}

// Somebody's record, as an exported copy carries it.
PersonRecord somebody() {
  PersonRecord person{"Ada", 42, {}, {}};
  for (const int side : {3, 4}) {
    const auto blob = encode_model(sample_model(side));
    RELIEVO_ASSERT(blob.has_value());
    person.portraits.push_back({{}, {"2026-03", "en", {}}, "[matcher]", "{}", {}, *blob});
  }
  return person;
}

bool person(FuzzBytes input) {
  const auto read = decode_person(bytes_of(input));
  RELIEVO_ASSERT(!read || std::ranges::equal(encode_person(*read), bytes_of(input)));
  return read.has_value();
}

// The copy itself: a tar of files, its manifest and signature.
bool bundle(FuzzBytes input) {
  const auto files = bundle_files(bytes_of(input));
  if (!files) return false;
  for (const BundleFile& file : *files) RELIEVO_ASSERT(is_plain_name(file.name));
  return firmware::check_bundle(*files).has_value();
}

std::string good_bundle() {
  const TemporaryFolder folder;
  const auto store = storage::test::opened(folder.path(), kNoReserve);
  const auto id = store->add_person(somebody());
  RELIEVO_ASSERT(id.has_value());
  const auto ada = store->subject(*id);
  const auto enrolments = store->enrolments(*id);
  const std::string text = "a file";
  const auto bytes = std::as_bytes(std::span(text));
  std::vector<BundleFile> files{{"report.json", {bytes.begin(), bytes.end()}}};
  auto more = firmware::manifest_files(*store, {*ada, enrolments->back(), {}},
                                       {{"report.json", sha256(files.front().bytes)}});
  RELIEVO_ASSERT(more.has_value());
  std::ranges::move(*more, std::back_inserter(files));
  return text_of(std::span<const std::byte>(*bundle_bytes(files)));
}

}  // namespace

std::vector<FuzzTarget> store_targets() {
  return {{"store", store, {""}},
          {"age", age, sealed_files()},
          {"person", person, {text_of(std::span<const std::byte>(encode_person(somebody())))}},
          {"bundle", bundle, {good_bundle()}}};
}

}  // namespace relievo::test
