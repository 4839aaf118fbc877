// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/record_filter.h"

#include <algorithm>
#include <set>

#include "firmware/records/receipt.h"
#include "firmware/service/access.h"
#include "storage/text.h"

namespace relievo::firmware {

using Opened = storage::Store::Opened;

void RecordChoice::forget() {
  wipe_text(part);
  filter.reset();
}

Result<void> for_each_record(
    storage::Store& store, Opened opened, JobControl& control,
    const std::function<void(const storage::Subject&, const storage::Consent* newest)>& visit) {
  RELIEVO_TRY_ASSIGN(const std::int64_t all, store.count_subjects());
  std::int64_t read = 0;
  return store.for_each_subject(
      opened, [&](storage::Subject& subject, const storage::Consent* newest) -> Result<void> {
        visit(subject, newest);
        wipe_text(subject.name);
        control.progress.done.store(float(++read) / float(all));
        if (control.cancelled.load()) return Error{Errc::Cancelled, "the records were not all read"};
        return {};
      });
}

Result<std::vector<ui::RecordFilter>> record_filters(storage::Store& store, JobControl& control) {
  std::set<ui::RecordFilter> found;
  RELIEVO_TRY(for_each_record(store, Opened::NamesAndConsents, control,
                              [&](const storage::Subject& subject, const storage::Consent* newest) {
                                if (newest != nullptr && !newest->wording.empty())
                                  found.insert({false, newest->wording});
                                found.insert({true, storage::first_letter(subject.name)});
                              }));
  std::vector<ui::RecordFilter> all(found.begin(), found.end());
  if (std::ranges::count(all, false, &ui::RecordFilter::letter) == 1) all.erase(all.begin());
  return all;
}

Result<std::vector<storage::SubjectId>> chosen_records(storage::Store& store, const RecordChoice& choice,
                                                       JobControl& control) {
  std::vector<storage::SubjectId> passed;
  if (is_receipt(choice.part)) {
    const auto subject = find_by_receipt(store, choice.part);
    if (subject) passed.push_back(subject->id);
    else if (subject.error().code != Errc::NotFound) return subject.error();
    return passed;
  }
  const bool by_text = choice.filter && !choice.filter->letter;
  const auto passes = [&](const storage::Subject& subject, const storage::Consent* newest) {
    if (!choice.filter) return storage::contains_name(subject.name, choice.part);
    if (choice.filter->letter) return storage::first_letter(subject.name) == choice.filter->text;
    return newest != nullptr && newest->wording == choice.filter->text;
  };
  RELIEVO_TRY(for_each_record(store, by_text ? Opened::NamesAndConsents : Opened::Names, control,
                              [&](const storage::Subject& subject, const storage::Consent* newest) {
                                if (passes(subject, newest)) passed.push_back(subject.id);
                              }));
  return passed;
}

}  // namespace relievo::firmware
