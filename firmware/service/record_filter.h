// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ui::RecordFilter: which records an operator wants to see: those of one first letter, or those whose newest
// consent was given to one version of the text. All of it is sealed, so every record is opened for an answer.
// Thread: the keeper. Errors: Cancelled, the store's.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "storage/store.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

// As Store::for_each_subject. It is the visitor's business to wipe what it keeps of a name.
Result<void> for_each_record(
    storage::Store& store, const std::atomic<bool>& cancelled,
    const std::function<void(const storage::Subject&, const storage::Consent* newest)>& visit);

// All that let a record pass, in their order: texts (none where all agreed to one), then letters.
Result<std::vector<ui::RecordFilter>> record_filters(storage::Store& store,
                                                     const std::atomic<bool>& cancelled);

// Those that pass, the newest first.
Result<std::vector<storage::SubjectId>> filtered_records(storage::Store& store,
                                                         const ui::RecordFilter& filter,
                                                         const std::atomic<bool>& cancelled);

}  // namespace relievo::firmware
