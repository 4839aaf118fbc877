// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/consent_text_store.h"

#include "firmware/base/output_folder.h"
#include "firmware/records/consent_files.h"
#include "firmware/service/page_controller.h"
#include "storage/export/atomic_file.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

Error not_kept() { return {Errc::IoFailed, "cannot be kept on this device: look at the room on its disk"}; }

// The files of a version, from one folder to another; only the text is taken, not what else a file system
// knows of a file.
Result<void> copy_texts(const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (fs::directory_iterator entry(from, error), end; !error && entry != end; entry.increment(error)) {
    if (is_hidden(entry->path())) continue;
    RELIEVO_TRY_ASSIGN(const std::string text, read_consent_text(entry->path()));
    const fs::path name = entry->path().filename();
    if (!write_text(to / name, text, name)) return not_kept().at(name.string());
  }
  if (error) return Error{Errc::IoFailed, "cannot be read", error.value()}.at(from.string());
  return storage::sync_directory(to);
}

// None: the stick has what is in force.
Result<std::optional<ui::ConsentTexts>> take_from(const fs::path& stick, const fs::path& own,
                                                  const std::optional<ui::ConsentTexts>& now) {
  RELIEVO_TRY_ASSIGN(const auto found, read_consent(stick / "consent"));
  if (!found) return Error{Errc::NotFound, "the stick has no folder named consent"};
  if (now && found->version < now->version)
    return Error{Errc::InvalidInput,
                 "comes before the version in force: give the new one a name that comes after it"}
        .at(found->version);
  if (now && found->version == now->version) {
    if (*found == *now) return std::optional<ui::ConsentTexts>{};
    return Error{Errc::InvalidInput,
                 "is in force already, with other words: give the new one a name of its own"}
        .at(found->version);
  }
  Result<OutputFolder> folder = OutputFolder::begin(own / found->version);
  if (!folder) return not_kept().at(found->version);
  RELIEVO_TRY(copy_texts(stick / "consent" / found->version, folder->path()));
  const Result<ui::ConsentTexts> kept = read_consent_version(folder->path(), found->version);
  if (!kept || !(*kept == *found))
    return Error{Errc::IoFailed, "was read twice and was not the same: use another stick"}.at(found->version);
  if (!folder->commit()) return not_kept().at(found->version);
  return std::optional(*found);
}

}  // namespace

Result<void> ConsentTextStore::look() {
  RELIEVO_TRY_ASSIGN(now_, read_consent(folder_));
  return {};
}

void ConsentTextStore::opened() {
  outcome_ = ui::Outcome::None;
  fault_ = {};
}

void ConsentTextStore::take() {
  if (taking_) return;
  opened();
  taking_ = true;
  const auto taken = std::make_shared<std::optional<ui::ConsentTexts>>();
  side_tasks_.send(
      JobLane::Keeper,
      [this, taken, now = now_](JobControl&) -> Result<void> {
        const auto medium = media_.current();
        if (!medium) return Error{Errc::MediaMissing, "there is no stick: plug one in"};
        auto result = take_from(medium->root, folder_, now);
        // Whatever failed: a stick that is gone is the reason.
        if (!result && !media_.current())
          return Error{Errc::Disconnected, "the stick was pulled out too early: plug it in and try again"};
        RELIEVO_TRY_ASSIGN(*taken, std::move(result));
        return {};
      },
      [this, taken](const std::optional<Error>& error) {
        if (!error && *taken) {
          log_.say(ui::LogEvent::ConsentTaken, {(*taken)->version});
          next_ = std::move(*taken);
        }
        ended(error);
      },
      SideTasks::Whose::Device);
}

void ConsentTextStore::ended(const std::optional<Error>& error) {
  taking_ = false;
  outcome_ = error ? outcome_of(*error) : ui::Outcome::Done;
  if (!error) return;
  // A file is known to the operator by its name, wherever the stick is mounted.
  fault_ = ui::fault_of(error->at(fs::path(error->where()).filename().string()));
  if (error->code != Errc::MediaMissing) log_.fault(*error);
}

void ConsentTextStore::adopt() {
  if (!next_) return;
  now_ = std::move(next_);
  next_.reset();
}

void ConsentTextStore::show(ui::ConsentTextsView& view) const {
  view = {taking_, outcome_, fault_.empty() ? nullptr : &fault_};
}

}  // namespace relievo::firmware
