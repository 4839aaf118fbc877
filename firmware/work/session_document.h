// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A session's pictures and products as a document (storage/document) and back, bit for bit.
// Thread: whoever has the session's products. Errors: the document's; Cancelled.
#pragma once

#include <vector>

#include "firmware/jobs/job_thread.h"
#include "firmware/machine/machine.h"
#include "firmware/session/session.h"
#include "firmware/work/stage_runner.h"
#include "pipeline/algorithms.h"
#include "storage/document/document.h"

namespace relievo::firmware {

// Where a reconstruction has to begin again when its algorithms change: the first stage that one of the
// differing choices has a part in; Review: none differs. Thread: any. Errors: none.
State first_change(const pipeline::AlgorithmSet& before, const pipeline::AlgorithmSet& after);

// How a reconstruction was made.
struct Making {
  pipeline::AlgorithmSet set;
  bool whole_view = false;
  pipeline::StereoCalibration calibration;
  std::vector<StageRecord> records;      // of the stages that are done
  std::vector<pipeline::Match> by_hand;  // beside the matcher's, from Reconstruct on
};

Result<std::vector<std::byte>> make_document(const Products& products, const Making& making);
// Errors: also AlgorithmSet::from_text()'s.
Result<Making> making_of(const storage::Document& document);
// The products of the stages before `first`, as far as the document has them, into an open session without
// any. Gives the first stage that is left to do; Review: none is.
Result<State> load_products(const storage::Document& document, State first, EnrolmentSession& session,
                            JobControl& control);

}  // namespace relievo::firmware
