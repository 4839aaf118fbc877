// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one way to open a store of SQLite: DIR/relievo.db (directory 0700, file 0600), and beside it what
// storage/README.md lists.
//
// Errors: InvalidInput (another program's database, DIR is no directory); NotFound (opened to read,
// nothing there); StoreNewer (made by a newer Relievo: left untouched); StoreCorrupt; Timeout
// (another program has it open to write); MediaFull; IoFailed; OutOfMemory. Of the key: NotFound (it is not
// there), InvalidInput (it is another store's, or others may read it).
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/base/result.h"
#include "hal/clock.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_keys.h"
#include "storage/sqlite/store_directory.h"
#include "storage/store.h"
#include "storage/store_folder.h"

namespace relievo::storage {

enum class OpenMode : std::uint8_t { ReadWrite, ReadOnly };

struct SqliteStoreOptions {
  OpenMode mode = OpenMode::ReadWrite;
  std::chrono::milliseconds wait_for_lock{2000};
  std::int64_t max_bytes = 0;               // of the database file; 0: as much as the disk holds
  std::int64_t reserve_bytes = 64'000'000;  // an erasure needs as much as it erases, for a moment
  std::int64_t (*draw_receipt)() = storage::draw_receipt;
  std::shared_ptr<KeySource> keys{};  // empty: the file relievo.key beside the store
  // Not empty: the store is opened by them, and `keys` gets a new key of the appliance (StoreKeeping,
  // recover()).
  std::string recovery_words{};
};

class SqliteStore final : public Store {
 public:
  // Of a database that open_sqlite_store() has made ready, and the lock that keeps other writers out.
  SqliteStore(std::unique_ptr<StoreLock> lock, std::unique_ptr<Database> database,
              std::unique_ptr<StoreKeys> keys, const hal::Clock& clock, const SqliteStoreOptions& options)
      : lock_(std::move(lock)),
        database_(std::move(database)),
        keys_(std::move(keys)),
        clock_(clock),
        mode_(options.mode),
        home_(database_->file().parent_path()),
        reserve_bytes_(options.reserve_bytes),
        draw_receipt_(options.draw_receipt) {}

  static Result<std::unique_ptr<SqliteStore>> open(const std::filesystem::path& dir, const hal::Clock& clock,
                                                   const SqliteStoreOptions& options);

  using Store::check;
  Result<void> check(const std::atomic<bool>& stop) override;
  Result<SubjectId> add_subject(const NewSubject& subject) override;
  Result<std::vector<Subject>> subjects(const SubjectFilter& filter) override;
  Result<std::int64_t> count_subjects() override;
  Result<WallTime> last_added_at() override;
  Result<Subject> subject(SubjectId id) override;
  Result<void> for_each_subject(Opened opened, const Visit& visit) override;
  Result<void> erase_subject(SubjectId id) override;
  Result<EnrolmentId> add_enrolment(const SubjectChoice& subject, const NewEnrolment& enrolment,
                                    Subject* owner = nullptr) override;
  Result<std::vector<Enrolment>> enrolments(SubjectId subject) override;
  Result<Enrolment> enrolment(EnrolmentId id) override;
  Result<pipeline::FaceModel> load_model(EnrolmentId id, std::pmr::memory_resource* memory) override;
  Result<PersonRecord> person(SubjectId id) override;
  Result<SubjectId> add_person(const PersonRecord& person) override;
  using Store::save_calibration;
  Result<std::uint32_t> save_calibration(const pipeline::StereoCalibration& calibration,
                                         std::string_view note, const CalibrationFigures& figures) override;
  Result<std::uint32_t> know_calibration(const pipeline::StereoCalibration& calibration,
                                         std::string_view note) override;
  Result<std::vector<CalibrationInfo>> calibrations() override;
  Result<pipeline::StereoCalibration> calibration(std::uint32_t revision) override;
  Result<pipeline::StereoCalibration> active_calibration() override;
  Result<void> activate_calibration(std::uint32_t revision) override;
  Result<std::string> setting(std::string_view key) override;
  Result<void> set_setting(std::string_view key, std::string_view value) override;
  Result<bool> has_recovery_words() override;
  Result<void> keep_recovery_words(std::string_view words) override;
  Result<Signed> sign(std::span<const std::byte> bytes) override { return keys_->sign(bytes); }
  Result<void> append_audit(const AuditEvent& event) override;
  Result<std::vector<AuditRecord>> audit(std::int64_t after_number, std::int64_t limit) override;

 private:
  friend class SqliteKeeping;
  // Runs `work` in one transaction, with its line of the audit log; memory that runs out is an error.
  template <typename Work>
  auto change(const Work& work) -> decltype(work(WallTime{}));
  template <typename Work>
  auto change_in_reserve(const Work& work) -> decltype(work(WallTime{}));
  WallTime now() const;
  Error not_found(Literal what, std::int64_t number) const;
  Result<void> append_line(const AuditEvent& event, WallTime at);  // inside the caller's transaction
  Result<void> subject_must_exist(SubjectId id);                   // its key is in keys_ then
  Result<Subject> subject_in(KeySlots& slots, const Statement& row);
  Result<Enrolment> enrolment_in(KeySlots& slots, const Statement& row);
  Result<std::int64_t> fresh_receipt();
  Result<void> must_be_new(std::int64_t receipt);
  Result<SubjectId> insert_subject(std::string_view name, std::int64_t receipt, WallTime created,
                                   WallTime at);
  Result<void> erase_others(SubjectId subject, EnrolmentId but, WallTime at);
  Result<SubjectId> resolve(const SubjectChoice& subject, WallTime at);
  Result<EnrolmentId> insert_enrolment(SubjectId subject, const NewEnrolment& enrolment,
                                       std::span<const std::byte> blob, WallTime created, WallTime at);
  static Result<void> check_texts(const NewEnrolment& enrolment);
  Result<std::uint32_t> insert_calibration(const pipeline::StereoCalibration& calibration,
                                           std::string_view note, const CalibrationFigures& figures,
                                           WallTime at);
  Result<std::uint32_t> revision_of(const pipeline::StereoCalibration& calibration);  // 0: not in the store
  Result<std::uint32_t> revision_for(std::span<const std::byte> calibration_record, WallTime at);
  Result<void> make_active(std::uint32_t revision);
  Result<std::vector<std::byte>> model_bytes(EnrolmentId id);
  Result<void> check_pages();
  Result<void> check_subjects();
  Result<void> check_models();
  Result<void> check_calibrations();

  std::unique_ptr<StoreLock> lock_;  // outlives the database
  std::unique_ptr<Database> database_;
  bool traces_left_ = false;  // of a renewal, in the log: somebody read it
  std::unique_ptr<StoreKeys> keys_;
  const hal::Clock& clock_;
  OpenMode mode_;
  std::filesystem::path home_;  // the store's directory
  std::int64_t reserve_bytes_;
  std::int64_t (*draw_receipt_)();
};

// `clock` must outlive the store.
Result<std::unique_ptr<Store>> open_sqlite_store(const std::filesystem::path& dir, const hal::Clock& clock,
                                                 const SqliteStoreOptions& options = {});

std::unique_ptr<StoreKeeping> keep_sqlite_store(const std::filesystem::path& dir, const hal::Clock& clock,
                                                const SqliteStoreOptions& options = {});

}  // namespace relievo::storage
