// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page/recovery_controller.h"

#include <algorithm>
#include <memory>

#include "firmware/kiosk/code/code_picture.h"
#include "firmware/service/pin_hash.h"
#include "storage/cipher/recovery.h"

namespace relievo::firmware {

void RecoveryController::opened() {
  closed();
  state_ = ui::SheetState::Asked;
  outcome_ = ui::Outcome::None;
  if (!services().words_due) return;
  words_ = storage::draw_recovery_words();
  for (std::size_t at = 0; at < words_.size();) {
    const std::size_t end = std::min(words_.find(' ', at), words_.size());
    each_.emplace_back(std::string_view(words_).substr(at, end - at));
    at = end + 1;
  }
  to_type_ = storage::words_to_ask();
  typed_ = 0;
  code_ = code_picture(words_);
  ++version_;
}

void RecoveryController::closed() {
  each_.clear();
  wipe_text(words_);
  std::ranges::fill(code_.bytes, std::byte{255});
  ++version_;
}

void RecoveryController::ask(const ui::StaffRequest& request) {
  if (request.as<ui::OfferWord>() == nullptr || each_.empty() || state_ == ui::SheetState::Saving) return;
  std::string word(request.text());
  std::ranges::transform(word, word.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  std::erase(word, ' ');
  const bool right = word == each_[to_type_[typed_]];
  wipe_text(word);
  state_ = right ? ui::SheetState::Asked : ui::SheetState::Wrong;
  if (right && ++typed_ == to_type_.size()) keep();
}

void RecoveryController::keep() {
  state_ = ui::SheetState::Saving;
  typed_ = 0;
  const auto kept = std::make_shared<std::string>(words_);
  services().side_tasks.send(
      JobLane::Keeper,
      [this, kept](JobControl&) {
        const auto done = services().store.keep_recovery_words(*kept);
        wipe_text(*kept);
        return done;
      },
      [this](const std::optional<Error>& error) {
        state_ = error ? ui::SheetState::Failed : ui::SheetState::Done;
        if (error) {
          services().log.fault(*error);
          outcome_ = outcome_of(*error);
          return;
        }
        services().words_due = false;
        closed();
      },
      SideTasks::Whose::Device);
}

void RecoveryController::show(ui::ServiceView& view) {
  view_ = {each_, {}, 0, state_};
  if (!each_.empty()) {
    view_.code = {code_.view(), version_};
    view_.asked = static_cast<int>(to_type_[typed_]) + 1;
  }
  view.work.outcome = outcome_;
  view.recovery = services().words_due || state_ == ui::SheetState::Done ? &view_ : nullptr;
}

}  // namespace relievo::firmware
