// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ConsentTextStore: the consent text that is in force, and how the operator's own comes from a stick:
//
//   stick: consent/VERSION/LANGUAGE.txt --take()--> the store's consent/VERSION/ --adopt()--> in force
//
// It is checked on the stick (read_consent_version()), written beside what is in force, read back, and
// gets its name then: whatever goes wrong, the text before stays. A version never changes its words, because
// records name it: the store remembers the SHA-256 of each text from when it comes into force.
// Thread: main; the stick is read on the keeper. Errors of look(): see read_consent(), and InvalidInput where
// the text in force has other words than when it came into force. An older text that is gone or changed, or
// all of them, is named on the console and in the log.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/console.h"
#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "hal/base/result.h"
#include "hal/removable_media.h"
#include "storage/store.h"
#include "ui/view/staff_views.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

// The operator's consent text and what lies beside it, in the form of firmware/records/README.md. In use is
// the version whose name is the last. Names that begin with a dot are somebody else's (a copy that was not
// finished, what a computer leaves on a stick). Thread: any.
// Errors: InvalidInput names the file and what is wrong with it; IoFailed. Their sentences are keys of
// the staff's catalogues (ui/language).
inline constexpr std::size_t kMostConsentBytes = 20'000;  // of one text
inline constexpr std::size_t kMostConsentPoints = 24;

// Nothing where there is no such folder: then the sample is shown, and says that it is one.
Result<std::optional<ui::ConsentTexts>> read_consent(const std::filesystem::path& folder);

// Of the store's own folder: what a power cut left of a text that was being taken is no text, and goes.
Result<std::optional<ui::ConsentTexts>> own_consent(const std::filesystem::path& folder);

// One folder of LANGUAGE.txt, under that name.
Result<ui::ConsentTexts> read_consent_version(const std::filesystem::path& folder,
                                              const std::string& version);
// A file as it is taken for text: UTF-8 without its mark, ends of lines as here, at most kMostConsentBytes.
Result<std::string> read_consent_text(const std::filesystem::path& file);
bool is_hidden(const std::filesystem::path& path);

// From the folder consent of a stick into that of the store, whole or not at all. None: the stick has what is
// in force. InvalidInput, NotFound, IoFailed. Thread: the keeper.
Result<std::optional<ui::ConsentTexts>> take_consent(const std::filesystem::path& stick,
                                                     const std::filesystem::path& own,
                                                     const std::optional<ui::ConsentTexts>& now);

// Of the texts that were ever in force, those that are gone from the store's folder consent or have other
// words. Errors: the store's.
Result<std::vector<Error>> broken_consents(storage::Store& store, const std::filesystem::path& folder);

class ConsentTextStore {
 public:
  // `folder` is the store's.
  ConsentTextStore(storage::Store& store, const std::filesystem::path& folder, hal::RemovableMedia& media,
                   SideTasks& side_tasks, EventLog& log)
      : store_(store), folder_(folder / "consent"), media_(media), side_tasks_(side_tasks), log_(log) {}

  // Before any thread uses it.
  Result<void> look(Console& console);
  // None: our sample, which nobody has reviewed. Valid until adopt().
  const ui::ConsentTexts* now() const { return now_ ? &*now_ : nullptr; }
  // Takes over what the stick has; view() tells how it ended.
  void take();
  // What was taken is in force from here on: while no visitor is in the middle of reading the one before.
  void adopt();
  // The last try is no news to who comes now.
  void opened();
  const ui::ConsentTextsView& view() const { return view_; }

 private:
  void failed(const Error& error);

  storage::Store& store_;
  std::filesystem::path folder_;
  hal::RemovableMedia& media_;
  SideTasks& side_tasks_;
  EventLog& log_;
  std::optional<ui::ConsentTexts> now_, next_;
  ui::ConsentTextsView view_;
  ui::Fault fault_;  // why the last try failed
};

}  // namespace relievo::firmware
