// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/record_filter.h"

#include <set>
#include <utility>

#include "firmware/service/pin_hash.h"
#include "storage/text.h"

namespace relievo::firmware {
namespace {

constexpr std::int64_t kAtOnce = 200;

// Empty: nobody knows.
Result<std::string> newest_text(storage::Store& store, storage::SubjectId id) {
  RELIEVO_TRY_ASSIGN(auto enrolments, store.enrolments(id));
  return enrolments.empty() ? std::string() : std::move(enrolments.back().consent.wording);
}

}  // namespace

Result<void> for_each_record(storage::Store& store, const std::atomic<bool>& cancelled,
                             const std::function<Result<void>(const storage::Subject&)>& visit) {
  for (std::int64_t skip = 0;; skip += kAtOnce) {
    RELIEVO_TRY_ASSIGN(auto subjects, store.subjects({.skip = skip, .limit = kAtOnce}));
    Result<void> done;
    for (storage::Subject& subject : subjects) {
      if (done && cancelled.load()) done = Error{Errc::Cancelled, "the records were not all read"};
      if (done) done = visit(subject);
      wipe_text(subject.name);
    }
    if (!done || std::int64_t(subjects.size()) < kAtOnce) return done;
  }
}

Result<std::vector<ui::RecordFilter>> record_filters(storage::Store& store,
                                                     const std::atomic<bool>& cancelled) {
  std::set<ui::RecordFilter> found;
  std::size_t texts = 0;
  RELIEVO_TRY(for_each_record(store, cancelled, [&](const storage::Subject& subject) -> Result<void> {
    RELIEVO_TRY_ASSIGN(std::string text, newest_text(store, subject.id));
    if (!text.empty() && found.insert({false, std::move(text)}).second) ++texts;
    found.insert({true, storage::first_letter(subject.name)});
    return {};
  }));
  std::vector<ui::RecordFilter> all(found.begin(), found.end());
  if (texts == 1) all.erase(all.begin());
  return all;
}

Result<std::vector<storage::SubjectId>> filtered_records(storage::Store& store,
                                                         const ui::RecordFilter& filter,
                                                         const std::atomic<bool>& cancelled) {
  std::vector<storage::SubjectId> passed;
  RELIEVO_TRY(for_each_record(store, cancelled, [&](const storage::Subject& subject) -> Result<void> {
    std::string text;
    if (filter.letter) {
      text = storage::first_letter(subject.name);
    } else {
      RELIEVO_TRY_ASSIGN(text, newest_text(store, subject.id));
    }
    if (text == filter.text) passed.push_back(subject.id);
    return {};
  }));
  return passed;
}

}  // namespace relievo::firmware
