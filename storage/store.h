// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Store: everything that survives a power cut. Subjects, enrolments with their models, calibrations,
// settings and the audit log.
//
// Every verb that changes something is one transaction: all of it is on the disk when the call
// returns without an error, none of it otherwise. Each writes its own line of the audit log in the
// same transaction.
//
// Errors of every verb: OutOfMemory; StoreCorrupt (stop, restore a copy); MediaFull; IoFailed;
// Timeout (another program holds the store); InvalidState (a change asked of a store opened to read).
// Further ones are named at the verb.
// Thread: one at a time (the keeper).
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "storage/record.h"

namespace relievo::storage {

class Store {
 public:
  virtual ~Store() = default;

  // Reads every page, every model, every calibration and the whole audit chain. StoreCorrupt says
  // what is wrong with what. Takes seconds to minutes on a full store; Cancelled soon after `stop` is true.
  virtual Result<void> check(const std::atomic<bool>& stop) = 0;
  Result<void> check() { return check(std::atomic<bool>(false)); }

  // InvalidInput: the name is empty, too long or not UTF-8.
  virtual Result<SubjectId> add_subject(const NewSubject& subject) = 0;
  virtual Result<std::vector<Subject>> subjects(const SubjectFilter& filter) = 0;
  virtual Result<std::int64_t> count_subjects() = 0;
  // When the last portrait or person that is still there came in, by this store's own clock: where they come
  // from another store, what they were given there says nothing of it. Where only people of a store without a
  // log (version 1) are left, when the last of them was made. The epoch: there is none.
  virtual Result<WallTime> last_added_at() = 0;
  virtual Result<Subject> subject(SubjectId id) = 0;  // NotFound
  // Everybody once, the newest first, but for code and number of enrolments, with the consent they gave last
  // (none: null) where consents are opened, too, which takes twice as long; until `visit` fails, which may
  // change what it is given and nothing in the store.
  enum class Opened : std::uint8_t { Names, NamesAndConsents };
  using Visit = std::function<Result<void>(Subject& subject, const Consent* newest)>;
  virtual Result<void> for_each_subject(Opened opened, const Visit& visit) = 0;
  // Name, consents, models, and their traces in free pages, write-ahead log and old copies. NotFound. Errors
  // that begin with "erased" tell what else could not be done.
  virtual Result<void> erase_subject(SubjectId id) = 0;

  // NotFound: no such subject or calibration. InvalidInput: the model does not hang together.
  // One that renews also removes the traces of those before, as erase_subject() does; while another program
  // reads the store they stay in its log until the next change or opening.
  // `owner`, if not null, gets the subject it was stored for, read in the same transaction: if that fails,
  // nothing is stored. Not specified on error.
  virtual Result<EnrolmentId> add_enrolment(const SubjectChoice& subject, const NewEnrolment& enrolment,
                                            Subject* owner = nullptr) = 0;
  virtual Result<std::vector<Enrolment>> enrolments(SubjectId subject) = 0;  // oldest first
  virtual Result<Enrolment> enrolment(EnrolmentId id) = 0;                   // NotFound
  // The model, bit for bit as it was stored, in `memory`. NotFound.
  virtual Result<pipeline::FaceModel> load_model(EnrolmentId id, std::pmr::memory_resource* memory) = 0;

  // All there is of somebody, for another store. NotFound.
  virtual Result<PersonRecord> person(SubjectId id) = 0;
  // Takes in whom another store handed over, with the code and the times they had there. InvalidInput: their
  // code is in this store, or they were erased from it; something in the record cannot be.
  virtual Result<SubjectId> add_person(const PersonRecord& person) = 0;

  // Stores a calibration under the next revision, which it returns, and makes it the active one.
  // InvalidInput: not finite, or without a focal length or a size.
  virtual Result<std::uint32_t> save_calibration(const pipeline::StereoCalibration& calibration,
                                                 std::string_view note,
                                                 const CalibrationFigures& figures) = 0;
  // One whose figures nobody knows: from a file.
  Result<std::uint32_t> save_calibration(const pipeline::StereoCalibration& calibration,
                                         std::string_view note) {
    return save_calibration(calibration, note, {});
  }
  // The revision of one that somebody else keeps, in a file: its own where the store has the same
  // numbers already, else the next. Which one is active stays as it is. InvalidInput as above.
  virtual Result<std::uint32_t> know_calibration(const pipeline::StereoCalibration& calibration,
                                                 std::string_view note) = 0;
  virtual Result<std::vector<CalibrationInfo>> calibrations() = 0;                      // newest first
  virtual Result<pipeline::StereoCalibration> calibration(std::uint32_t revision) = 0;  // NotFound
  virtual Result<pipeline::StereoCalibration> active_calibration() = 0;                 // NotCalibrated
  virtual Result<void> activate_calibration(std::uint32_t revision) = 0;                // NotFound

  virtual Result<std::string> setting(std::string_view key) = 0;  // empty: nobody has set it
  virtual Result<void> set_setting(std::string_view key, std::string_view value) = 0;

  // Whether words open this store where its key is lost (cipher/recovery.h).
  virtual Result<bool> has_recovery_words() = 0;
  // From now on these do, and none before. InvalidInput: no such words.
  virtual Result<void> keep_recovery_words(std::string_view words) = 0;

  // By this store's own key, which stays the same when its others are changed.
  virtual Result<Signed> sign(std::span<const std::byte> bytes) = 0;

  virtual Result<void> append_audit(const AuditEvent& event) = 0;
  virtual Result<std::vector<AuditRecord>> audit(std::int64_t after_number, std::int64_t limit) = 0;
};

// What is done with a store as a whole, by whoever looks after the device. What changes it is refused
// (Timeout) while a kiosk has it open. Each verb opens the store by itself and closes it; all of it is on the
// disk when it returns without an error, none of it otherwise. Errors: as opening a store, and those named.
// Thread: one at a time.

// Where the appliance's key moves to: a file as text, or beside the store, sealed by the board's TPM.
// Neither: it stays where and as it is.
struct KeyPlace {
  std::filesystem::path file{};
  bool sealed_by_tpm = false;
};

class StoreKeeping {
 public:
  virtual ~StoreKeeping() = default;

  // A copy as sealed as the store, whole or not there; opened by the same key and the same words. It may
  // replace an empty file, or an older copy of this store by a program of this version. InvalidInput:
  // anything else is there, or it would lie in a store's own folder, or beside a key. Others: the older
  // copy's.
  virtual Result<void> backup(const std::filesystem::path& file) = 0;
  // Whom the store has erased since that copy was made of it. InvalidInput: it is no copy of this store.
  virtual Result<std::vector<SubjectId>> erased_since(const std::filesystem::path& backup) = 0;

  // New keys for the appliance and the store; every wrapped key is wrapped anew. Older copies keep theirs.
  // InvalidInput: the file it is to move to is there, and is not this store's key. StoreCorrupt also: the
  // recovery words no longer open it.
  virtual Result<void> rekey(const KeyPlace& to) = 0;

  // A new appliance's key for a store whose own is lost, by its recovery words. NotFound: it has none.
  // InvalidInput: the key file that was named is another store's, or is no key.
  // Returns who was in it and is erased again, because they were after this copy of the store was made.
  virtual Result<std::vector<SubjectId>> recover(std::string_view words) = 0;
};

}  // namespace relievo::storage
