// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/storage/store_of_before.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "storage/byte_order.h"
#include "storage/calibration_record.h"
#include "storage/model_blob.h"
#include "storage/schema/embedded_sql.h"
#include "storage/sodium_sha256.h"
#include "storage/sqlite/sqlite_parts.h"
#include "tests/storage/raw_database.h"

namespace relievo::storage::test {
namespace {

std::string number(std::int64_t n) { return std::to_string(n); }

}  // namespace

void make_version(const std::filesystem::path& dir, std::int64_t version) {
  std::filesystem::create_directories(dir);
  Raw raw(dir / "relievo.db");
  raw.run("PRAGMA journal_mode = WAL");
  for (std::int64_t n = 0; n < version; ++n) raw.run(std::string(migrations()[static_cast<std::size_t>(n)]));
  raw.run("PRAGMA application_id = " + number(kApplicationId) + "; PRAGMA user_version = " + number(version));
}

void set_log_back_to_8(const std::filesystem::path& dir) {
  const auto keys = *StoreKeys::make(key_file(dir / "relievo.key"));
  Database database(dir / "relievo.db");
  ASSERT_TRUE(database.open(true));
  ASSERT_TRUE(keys->load(database, true));
  KeyedHash hash{};
  std::int64_t last = 0;
  {
    auto query =
        database.prepare("SELECT number, at_ms, subject_id, what, detail FROM audit ORDER BY number");
    while (*query->step()) {
      std::vector<std::byte> bytes;
      ByteWriter to(bytes);
      to.put(hash);
      for (const int column : {0, 1, 2}) to.put(query->integer(column));
      for (const auto field : {bytes_of(query->text(3)), query->blob(4)}) {
        to.put(static_cast<std::uint64_t>(field.size()));
        to.put(field);
      }
      hash = keyed_hash(keys->chain(), bytes);
      last = query->integer(0);
      ASSERT_TRUE(database.run("UPDATE audit SET hash = ? WHERE number = ?", hash, last));
    }
  }
  ASSERT_TRUE(database.run("UPDATE audit_end SET number = ?, hash = ?", last, hash));
}

OfBefore::OfBefore(const std::filesystem::path& dir, int people) : dir_(dir) {
  make_version(dir, kLastPlain);
  Raw raw(dir / "relievo.db");
  for (int i = 1; i <= people; ++i) {
    const auto model = sample_model(8 + i % 7, static_cast<unsigned>(i));
    const std::string id = number(i), name = name_of(i);
    raw.run("INSERT INTO subject (id, created_at_ms, name, receipt) VALUES (" + id + ", 1, CAST('" + name +
            "' AS BLOB), " + number(424'200'000'000 + i) + ")");
    raw.run("INSERT INTO enrolment (id, subject_id, created_at_ms, algorithms, report_json) VALUES (" + id +
            ", " + id + ", 2, 'algorithms of " + name + "', 'report of " + name + "')");
    raw.run("INSERT INTO consent VALUES (" + id + ", 'wording for " + name + "', 'eo', 3)");
    raw.run("INSERT INTO model (enrolment_id, bytes) VALUES (" + id + ", ?)", *encode_model(model));
    if (people > 10 && i % 3 != 0) continue;  // to search for all of them takes minutes
    for (const char* text : {"", "algorithms of ", "report of ", "wording for "})
      traces.push_back(text + name);
    traces.emplace_back(reinterpret_cast<const char*>(&model.mesh.vertices_mm[3]), 24);
    traces.emplace_back(reinterpret_cast<const char*>(model.texture.rgb.data()) + 60, 24);
  }
  raw.run("INSERT INTO setting VALUES ('pin', 'hash of the PIN 4711', 1)");
  calibration.revision = 1;
  raw.run(
      "INSERT INTO calibration (created_at_ms, note, record, active) VALUES (1, 'the note of Grete', ?, 1)",
      encode_calibration(calibration, {}));
  // The chain as it was made before there were keys.
  std::vector<std::byte> bytes(32);
  ByteWriter to(bytes);
  for (const std::int64_t value : {1, 2, 0}) to.put(value);
  for (const std::string_view field : {"calibration.drift", "detail of Grete"}) {
    to.put(static_cast<std::uint64_t>(field.size()));
    to.put(bytes_of(field));
  }
  const auto hash = sha256(bytes);
  raw.run("INSERT INTO audit VALUES (1, 2, 'calibration.drift', 0, 'detail of Grete', ?)", hash);
  raw.run("UPDATE audit_end SET number = 1, hash = ?", hash);
  for (const char* text : {"hash of the PIN", "the note of Grete", "detail of Grete"})
    traces.emplace_back(text);
  people_ = people;
}
std::string OfBefore::name_of(int i) { return "Canary-" + number(1000 + i) + "-Person"; }

void OfBefore::judge(Store& store, const std::string& when) const {
  const auto checked = store.check();
  ASSERT_TRUE(checked) << when << ": " << checked.error().where() << ": " << checked.error().what.view();
  const auto subjects = store.subjects({});
  ASSERT_EQ(subjects->size(), static_cast<std::size_t>(people_)) << when;
  for (int i = 1; i <= people_; ++i) {
    const auto found = store.subjects({.name = name_of(i)});
    ASSERT_EQ(found->size(), 1U) << when;
    EXPECT_EQ(store.subjects({.receipt = 424'200'000'000 + i})->front().name, name_of(i)) << when;
    const auto enrolment = store.enrolment(EnrolmentId{i});
    ASSERT_TRUE(enrolment) << when;
    EXPECT_EQ(enrolment->report_json, "report of " + name_of(i));
    EXPECT_EQ(enrolment->algorithms, "algorithms of " + name_of(i));
    EXPECT_EQ(enrolment->consent.wording, "wording for " + name_of(i));
    EXPECT_EQ(enrolment->consent.language, "eo");
    EXPECT_EQ(enrolment->consent.given_at, WallTime(std::chrono::milliseconds(3)));
    EXPECT_TRUE(identical(sample_model(8 + i % 7, static_cast<unsigned>(i)),
                          *store.load_model(EnrolmentId{i}, std::pmr::new_delete_resource())));
  }
  EXPECT_EQ(*store.setting("pin"), "hash of the PIN 4711");
  EXPECT_EQ(store.calibrations()->front().note, "the note of Grete");
  EXPECT_EQ(store.audit(0, 10)->front().event.detail, "detail of Grete");
  EXPECT_EQ(readable(), 0) << when;
}
long OfBefore::readable() const {
  const auto bytes = all_bytes(dir_);
  return std::ranges::count_if(traces,
                               [&](const auto& trace) { return bytes.find(trace) != std::string::npos; });
}

}  // namespace relievo::storage::test
