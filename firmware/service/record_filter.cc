// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/record_filter.h"

#include <algorithm>
#include <set>

#include "firmware/service/pin_hash.h"
#include "storage/text.h"

namespace relievo::firmware {

Result<void> for_each_record(
    storage::Store& store, const std::atomic<bool>& cancelled,
    const std::function<void(const storage::Subject&, const storage::Consent* newest)>& visit) {
  return store.for_each_subject(
      [&](storage::Subject& subject, const storage::Consent* newest) -> Result<void> {
        visit(subject, newest);
        wipe_text(subject.name);
        if (cancelled.load()) return Error{Errc::Cancelled, "the records were not all read"};
        return {};
      });
}

Result<std::vector<ui::RecordFilter>> record_filters(storage::Store& store,
                                                     const std::atomic<bool>& cancelled) {
  std::set<ui::RecordFilter> found;
  RELIEVO_TRY(
      for_each_record(store, cancelled, [&](const storage::Subject& subject, const storage::Consent* newest) {
        if (newest != nullptr && !newest->wording.empty()) found.insert({false, newest->wording});
        found.insert({true, storage::first_letter(subject.name)});
      }));
  std::vector<ui::RecordFilter> all(found.begin(), found.end());
  if (std::ranges::count(all, false, &ui::RecordFilter::letter) == 1) all.erase(all.begin());
  return all;
}

Result<std::vector<storage::SubjectId>> filtered_records(storage::Store& store,
                                                         const ui::RecordFilter& filter,
                                                         const std::atomic<bool>& cancelled) {
  std::vector<storage::SubjectId> passed;
  RELIEVO_TRY(
      for_each_record(store, cancelled, [&](const storage::Subject& subject, const storage::Consent* newest) {
        const bool passes = filter.letter ? storage::first_letter(subject.name) == filter.text
                                          : newest != nullptr && newest->wording == filter.text;
        if (passes) passed.push_back(subject.id);
      }));
  return passed;
}

}  // namespace relievo::firmware
