// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/session_document.h"

#include <algorithm>
#include <new>
#include <string>
#include <string_view>

#include "firmware/base/version.h"
#include "hal/base/assert.h"

namespace relievo::firmware {
namespace {

State stage_of(const pipeline::OptionDescription& option) {
  const std::string& kind = option.kind.empty() ? option.key : option.kind;
  if (option.key.starts_with("face.")) return State::Match;  // what is matched is cut to it, too
  if (kind == "triangulator" || kind == "outliers") return State::Reconstruct;
  if (kind == "mesher" || kind == "completion") return State::Mesh;
  if (kind == "texturer") return State::Texture;
  if (kind == "fuser") return State::Review;  // of several pairs
  return kind == "relief" ? State::Assemble : State::Match;
}

std::string_view text_of(const pipeline::AlgorithmSet& set, const pipeline::OptionDescription& option) {
  const auto text = set.texts().find(option.key);
  return text == set.texts().end() ? std::string_view() : std::string_view(*text->second);
}

// A head's sides are not kept: its front is, as far as that was not made part of the head.
const pipeline::FaceModel* face_of(const Products& made) {
  return made.model && !made.registration ? &*made.model : nullptr;
}

std::size_t done(const Products& made) {
  return face_of(made) != nullptr ? kStages.size() : made.mesh ? 3 : made.cloud ? 2 : made.matches ? 1 : 0;
}

template <typename Product>
const Product* pointer(const std::optional<Product>& product) {
  return product ? &*product : nullptr;
}

Result<void> load_stage(const storage::Document& document, State stage, EnrolmentSession& session) {
  Products& made = session.products();
  Arena& memory = session.output();
  session.begins(stage);
  if (stage == State::Match) {
    RELIEVO_TRY_ASSIGN(made.pair, document.pair(&memory));
    RELIEVO_TRY_ASSIGN(made.matches, document.matches(*made.pair, &memory));
    made.drift = pipeline::judge_drift(made.matches->epipolar_shift, document.head().calibration);
  } else if (stage == State::Reconstruct) {
    RELIEVO_TRY_ASSIGN(made.cloud, document.cloud(*made.pair, &memory));
  } else if (stage == State::Mesh && document.head().stages.size() == storage::kDocumentStages) {
    RELIEVO_TRY_ASSIGN(made.model, document.model(&memory));  // and the mesh in it
    RELIEVO_TRY_ASSIGN(const auto set, pipeline::AlgorithmSet::from_text(document.head().algorithms));
    RELIEVO_TRY_ASSIGN(auto made_of, pipeline::make_algorithms(set));
    if (document.head().whole_view) made_of.relief.reset();
    made.model->unjudged = pipeline::why_unjudged(*made.model, made_of.relief);
  } else if (stage == State::Mesh) {
    RELIEVO_TRY_ASSIGN(made.mesh, document.mesh(&memory));
  }
  return {};
}

}  // namespace

State first_change(const pipeline::AlgorithmSet& before, const pipeline::AlgorithmSet& after) {
  State first = State::Review;
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms())
    if (before.get(option.key) != after.get(option.key) ||
        (option.file && text_of(before, option) != text_of(after, option)))
      first = std::min(first, stage_of(option));
  return first;
}

Result<std::vector<std::byte>> make_document(const Products& products, const Making& making) {
  RELIEVO_ASSERT(products.frame.has_value());
  storage::DocumentHead head{std::string(kVersion), making.set.to_text(),    making.whole_view,
                             making.calibration,    products.frame->skew_ns, {},
                             making.by_hand,        making.set.texts()};
  for (std::size_t i = 0; i < std::min(done(products), making.records.size()); ++i) {
    const StageRecord& record = making.records[i];
    head.stages.push_back({record.took, record.in, record.out, record.arena_peak_bytes});
  }
  return storage::make_document({head, *products.frame, pointer(products.pair), pointer(products.matches),
                                 pointer(products.cloud), pointer(products.mesh), face_of(products)});
}

Result<Making> making_of(const storage::Document& document) {
  const storage::DocumentHead& head = document.head();
  Making making{{}, head.whole_view, head.calibration, {}, head.by_hand};
  RELIEVO_TRY_ASSIGN(making.set, pipeline::AlgorithmSet::from_text(head.algorithms));
  for (const auto& [option, text] : head.texts) making.set.keep_text(option, *text);
  for (std::size_t i = 0; i < head.stages.size(); ++i) {
    const storage::DocumentStage& stage = head.stages[i];
    making.records.push_back(
        {name_of(kStages.at(i)), stage.took, stage.in, stage.out, stage.arena_peak_bytes});
  }
  return making;
}

Result<State> load_products(const storage::Document& document, State first, EnrolmentSession& session,
                            JobControl& control) {
  const std::size_t stages = std::min(document.head().stages.size(), number_of(first));
  try {
    for (std::size_t i = 0; i < stages; ++i) {
      if (control.cancelled.load()) return Error{Errc::Cancelled, "the reading was stopped"};
      RELIEVO_TRY(load_stage(document, kStages.at(i), session));
      control.progress.done.store(float(i + 1) / kStages.size());
    }
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "not enough memory for this saved reconstruction"};
  }
  const State left = stages == kStages.size() ? State::Review : kStages.at(stages);
  if (left == State::Review) return left;
  session.begins(left);
  session.rework(left);  // of a model only its mesh is wanted, or its texture, too
  return left;
}

}  // namespace relievo::firmware
