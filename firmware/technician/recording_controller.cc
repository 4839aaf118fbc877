// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/test_capture.h"

#include <utility>

#include "firmware/base/output_folder.h"
#include "firmware/base/wall_time.h"
#include "hal/base/words.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCapturesFolder = "captures";  // on the stick

// What is compared and written is pixels alone.
ImageView copied(const ImageView& view, std::vector<std::byte>& room) {
  room.resize(packed_bytes(view));
  return packed(view, room.data());
}

// Pairs of its own, so that the session may be wiped while a slow stick is still being written to.
class CaptureCopy {
 public:
  // Of `as_taken` views and times are replaced.
  CaptureCopy(std::span<const pipeline::StereoFrame> shots, const hal::RecordedPair& as_taken)
      : rooms_(2 * shots.size()), pairs_(shots.size(), as_taken) {
    for (std::size_t i = 0; i < shots.size(); ++i) {
      pairs_[i].left = copied(shots[i].left, rooms_[2 * i]);
      pairs_[i].right = copied(shots[i].right, rooms_[2 * i + 1]);
      pairs_[i].left_ns = 0;
      pairs_[i].right_ns = shots[i].skew_ns;
      pairs_[i].of_head = shots.size() > 1;
    }
  }
  CaptureCopy(const CaptureCopy&) = delete;
  std::span<const hal::RecordedPair> pairs() const { return pairs_; }

 private:
  std::vector<std::vector<std::byte>> rooms_;
  std::vector<hal::RecordedPair> pairs_;
};

Result<void> write_pairs(std::span<const hal::RecordedPair> pairs, const fs::path& target,
                         hal::RemovableMedia& media, StickWork& work) {
  RELIEVO_TRY(work.reach(ExportStep::Write, 0.1F));
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(target));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    RELIEVO_TRY(hal::record_pair(folder.path(), pairs[i]));
    RELIEVO_TRY(work.reach(ExportStep::Write, 0.1F + 0.4F * float(i + 1) / float(pairs.size())));
  }
  RELIEVO_TRY(keep_folder(folder, target, media, &work));
  return {};
}

}  // namespace

bool RecordingController::begin() {
  if (running_) return false;
  running_ = true;
  stopped_ = false;
  outcome_ = ui::Outcome::None;
  where_.clear();
  return true;
}

void RecordingController::ended(const std::optional<Error>& error, const ExportTrace& trace,
                                const std::string& where) {
  running_ = false;
  outcome_ = error ? outcome_of_export(*error, trace) : ui::Outcome::Done;
  if (!error || outcome_ == ui::Outcome::StickHeld) where_ = where;
}

std::string RecordingController::saved_name(std::size_t row) const {
  if (!files_ || row >= files_->size()) return {};
  const std::string& file = shown_.at(row);
  return file.substr(0, file.size() - std::string_view(kSavedEnding).size());
}

void RecordingController::record(std::span<const pipeline::StereoFrame> shots,
                                 const hal::RecordedPair& as_taken) {
  if (!begin()) return;
  const auto trace = std::make_shared<ExportTrace>();
  const auto copy = std::make_shared<const CaptureCopy>(shots, as_taken);
  const std::string name = stick_name_of(device_.clock().wall_now());
  task_ = side_tasks_.send(
      JobLane::Keeper,
      [this, copy, trace, name](JobControl& control) -> Result<void> {
        StickWork work{control, *trace};
        hal::RemovableMedia& media = device_.media();
        return put_on_stick(media, fs::path(kCapturesFolder) / name, &work, [&](const fs::path& target) {
          return write_pairs(copy->pairs(), target, media, work);
        });
      },
      [this, trace, name](const std::optional<Error>& error) {
        ended(error, *trace, std::string(kCapturesFolder) + "/" + name);
      });
}

void RecordingController::save(std::function<Result<std::vector<std::byte>>()> make) {
  if (!begin()) return;
  task_ = side_tasks_.ask(
      JobLane::Worker, [make = std::move(make)](JobControl&) { return make(); },
      [this](Result<SavedBytes> document) {
        if (!document) ended(document.error(), {}, {});
        else if (stopped_) ended(Error{Errc::Cancelled, "it was stopped before it was on the stick"}, {}, {});
        else write(*std::move(document));
      });
}

void RecordingController::write(SavedBytes document) {
  const auto trace = std::make_shared<ExportTrace>();
  const std::string name = stick_name_of(device_.clock().wall_now());
  task_ = side_tasks_.send(
      JobLane::Keeper,
      [this, document = std::make_shared<const SavedBytes>(std::move(document)), trace,
       name](JobControl& control) {
        return save_reconstruction(*document, name, device_.media(), control, *trace);
      },
      [this, trace, name](const std::optional<Error>& error) {
        ended(error, *trace, std::string(kSavedFolder) + "/" + name + kSavedEnding);
      });
}

void RecordingController::list() {
  if (!begin()) return;
  task_ = side_tasks_.ask(
      JobLane::Keeper, [this](JobControl&) { return saved_reconstructions(device_.media(), ui::kSavedRows); },
      [this](Result<std::vector<std::string>> files) {
        running_ = false;
        if (!files) {
          outcome_ = outcome_of_export(files.error(), {});
          return;
        }
        files_ = *std::move(files);
        shown_.clear();
        for (const std::string& file : *files_) shown_.push_back(shown_name(file));
      });
}

void RecordingController::load(std::size_t row, std::function<void(SavedBytes)> read,
                               std::function<void(const Error&)> refused) {
  if (!files_ || row >= files_->size() || !begin()) return;
  const std::string name = files_->at(row);
  hide();
  task_ = side_tasks_.ask(
      JobLane::Keeper,
      [this, name](JobControl& control) { return read_saved(name, device_.media(), control); },
      [this, read = std::move(read), refused = std::move(refused)](Result<SavedBytes> saved) {
        running_ = false;
        if (saved) return read(*std::move(saved));
        const Errc code = saved.error().code;
        if (code == Errc::Cancelled || code == Errc::MediaMissing)
          outcome_ = outcome_of_export(saved.error(), {});
        else refused(saved.error());
      });
}

void RecordingController::stop() {
  if (!running_) return;
  stopped_ = true;
  side_tasks_.stop(task_);
}

void RecordingController::capture_gone() {
  outcome_ = ui::Outcome::None;
  where_.clear();
}

void RecordingController::forget() {
  running_ = false;
  hide();
  capture_gone();
}

ui::TechnicianRecording RecordingController::view() const {
  return {{running_, running_ ? side_tasks_.progress(JobLane::Keeper) : 0, outcome_}, where_};
}

}  // namespace relievo::firmware
