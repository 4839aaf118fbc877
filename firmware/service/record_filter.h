// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RecordChoice: which records an operator wants to see: those with a part of a name, those of one first
// letter, or those whose newest consent was given to one version of the text. All of it is sealed, so every
// record is opened for an answer; the control hears how far that is. Thread: the keeper. Errors: Cancelled,
// the store's.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware/jobs/job_thread.h"
#include "storage/store.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

// At most one of both is there: one filters, or searches.
struct RecordChoice {
  std::string part;  // of a name; ASCII letters in either case
  std::optional<ui::RecordFilter> filter;
  bool everybody() const { return part.empty() && !filter; }
  void forget();  // wipes the part
};

// As Store::for_each_subject. It is the visitor's business to wipe what it keeps of a name.
Result<void> for_each_record(
    storage::Store& store, storage::Store::Opened opened, JobControl& control,
    const std::function<void(const storage::Subject&, const storage::Consent* newest)>& visit);

// All that let a record pass, in their order: texts (none where all agreed to one), then letters.
Result<std::vector<ui::RecordFilter>> record_filters(storage::Store& store, JobControl& control);

// The newest first; without a choice all. The code that a person quotes for their erasure leads to them, too.
Result<std::vector<storage::SubjectId>> chosen_records(storage::Store& store, const RecordChoice& choice,
                                                       JobControl& control);

}  // namespace relievo::firmware
