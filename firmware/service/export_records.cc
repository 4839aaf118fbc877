// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/export_records.h"

#include <fcntl.h>
#include <unistd.h>

#include <map>
#include <memory_resource>
#include <string>

#include "firmware/command/output_folder.h"
#include "firmware/command/wall_time.h"
#include "firmware/kiosk/receipt.h"
#include "firmware/version.h"
#include "hal/whole_file.h"
#include "pipeline/recognition/recognition_images.h"
#include "storage/export/model_files.h"
#include "storage/sodium_sha256.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFileBytes = std::size_t{1} << 31;

using Sums = std::map<std::string, storage::Sha256>;

// Of every file in the folder. `from_stick`: not what the system still has in memory.
Result<Sums> sums_of(const fs::path& folder, bool from_stick) {
  Sums sums;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (from_stick) {
      const int file = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
      if (file >= 0) {
        ::fsync(file);
        ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
        ::close(file);
      }
    }
    RELIEVO_TRY_ASSIGN(const auto bytes, hal::read_whole_file(entry.path(), kMostFileBytes));
    sums[entry.path().filename().string()] = storage::sha256(bytes);
  }
  if (error) return Error{Errc::IoFailed, "the folder on the stick cannot be read back"};
  return sums;
}

std::string note_of(const storage::Subject& subject, const storage::Enrolment& newest) {
  return "code: " + receipt_of(subject.id) + "\nname: " + subject.name + "\nkept since: " + text_of(subject.created_at) +
         "\nportraits: " + std::to_string(subject.enrolments) + "\nthis one: " + text_of(newest.created_at) + "\nconsent: " + newest.consent.wording +
         " (" + newest.consent.language + ") " + text_of(newest.consent.given_at) + "\n";
}

Result<void> write_record(storage::Store& store, storage::SubjectId id, const fs::path& root, const JobControl& control) {
  RELIEVO_TRY_ASSIGN(const storage::Subject subject, store.subject(id));
  RELIEVO_TRY_ASSIGN(const auto enrolments, store.enrolments(id));
  if (enrolments.empty()) return Error{Errc::NotFound, "has no portrait"};
  std::pmr::monotonic_buffer_resource memory;
  RELIEVO_TRY_ASSIGN(const pipeline::FaceModel model, store.load_model(enrolments.back().id, &memory));
  const auto images = pipeline::make_recognition_images(model, memory, memory);
  if (control.cancelled.load()) return Error{Errc::Cancelled, "the export was stopped"};
  const fs::path target = root / "relievo" / receipt_of(id);
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(target));
  storage::ExportOptions options(storage::ExportFrame::Head);
  options.version = kVersion;
  if (images) options.images = &*images;  // a head without eyes has none, and is still its person's record
  RELIEVO_TRY(storage::write_model_files(model, folder.path(), options));
  RELIEVO_TRY(write_text(folder.path() / "record.txt", note_of(subject, enrolments.back()), "record.txt"));
  if (!enrolments.back().report_json.empty()) RELIEVO_TRY(write_text(folder.path() / "report.json", enrolments.back().report_json, "report.json"));
  if (control.cancelled.load()) return Error{Errc::Cancelled, "the export was stopped"};
  RELIEVO_TRY_ASSIGN(const Sums written, sums_of(folder.path(), false));
  RELIEVO_TRY(folder.commit());
  RELIEVO_TRY_ASSIGN(const Sums read, sums_of(target, true));
  for (const auto& [name, sum] : written) {
    const auto again = read.find(name);
    if (again == read.end() || again->second != sum) return Error{Errc::IoFailed, "what was read back from the stick is not what was written: use another stick"};
  }
  return {};
}

}  // namespace

Result<void> export_records(storage::Store& store, hal::RemovableMedia& media, const std::vector<storage::SubjectId>& subjects, JobControl& control) {
  const auto medium = media.current();
  if (!medium) return Error{Errc::MediaMissing, "there is no stick: plug one in"};
  std::size_t done = 0;
  for (const storage::SubjectId id : subjects) {
    if (control.cancelled.load()) return Error{Errc::Cancelled, "the export was stopped"};
    const Result<void> written = write_record(store, id, medium->root, control);
    // Whatever failed: a stick that is gone is the reason.
    if (!media.current()) return Error{Errc::Disconnected, "the stick was pulled out before the export had ended"};
    RELIEVO_TRY(written);
    control.progress.done.store(static_cast<float>(++done) / static_cast<float>(subjects.size()));
  }
  return media.flush_and_eject();
}

}  // namespace relievo::firmware
