// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaultyStore: a store that takes no enrolment while the test names an error: MediaFull of a disk that is
// full, Timeout of a store that another program locks, StoreCorrupt. All else is the real store's. Thread: as
// Store; the error any.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "storage/store.h"

namespace relievo::test {

class FaultyStore : public storage::Store {
 public:
  FaultyStore(std::unique_ptr<storage::Store> real, const std::atomic<std::optional<Errc>>& error)
      : real_(std::move(real)), error_(error) {}

  Result<void> check(const std::atomic<bool>& stop) override { return real_->check(stop); }
  Result<storage::SubjectId> add_subject(const storage::NewSubject& s) override {
    return real_->add_subject(s);
  }
  Result<std::vector<storage::Subject>> subjects(const storage::SubjectFilter& f) override {
    return real_->subjects(f);
  }
  Result<std::int64_t> count_subjects() override { return real_->count_subjects(); }
  Result<storage::WallTime> last_added_at() override { return real_->last_added_at(); }
  Result<storage::Subject> subject(storage::SubjectId id) override { return real_->subject(id); }
  Result<void> for_each_subject(Opened o, const Visit& v) override { return real_->for_each_subject(o, v); }
  Result<void> erase_subject(storage::SubjectId id) override { return real_->erase_subject(id); }
  Result<storage::EnrolmentId> add_enrolment(const storage::SubjectChoice& s, const storage::NewEnrolment& e,
                                             storage::Subject* owner = nullptr) override {
    if (const auto error = error_.load()) return Error{*error, "as the test says"};
    return real_->add_enrolment(s, e, owner);
  }
  Result<std::vector<storage::Enrolment>> enrolments(storage::SubjectId s) override {
    return real_->enrolments(s);
  }
  Result<storage::Enrolment> enrolment(storage::EnrolmentId id) override { return real_->enrolment(id); }
  Result<pipeline::FaceModel> load_model(storage::EnrolmentId id, std::pmr::memory_resource* m) override {
    return real_->load_model(id, m);
  }
  Result<storage::PersonRecord> person(storage::SubjectId id) override { return real_->person(id); }
  Result<storage::SubjectId> add_person(const storage::PersonRecord& p) override {
    return real_->add_person(p);
  }
  Result<std::uint32_t> save_calibration(const pipeline::StereoCalibration& c, std::string_view n,
                                         const storage::CalibrationFigures& f) override {
    return real_->save_calibration(c, n, f);
  }
  Result<std::uint32_t> know_calibration(const pipeline::StereoCalibration& c, std::string_view n) override {
    return real_->know_calibration(c, n);
  }
  Result<std::vector<storage::CalibrationInfo>> calibrations() override { return real_->calibrations(); }
  Result<pipeline::StereoCalibration> calibration(std::uint32_t r) override { return real_->calibration(r); }
  Result<pipeline::StereoCalibration> active_calibration() override { return real_->active_calibration(); }
  Result<void> activate_calibration(std::uint32_t r) override { return real_->activate_calibration(r); }
  Result<std::string> setting(std::string_view k) override { return real_->setting(k); }
  Result<void> set_setting(std::string_view k, std::string_view v) override {
    return real_->set_setting(k, v);
  }
  Result<bool> has_recovery_words() override { return real_->has_recovery_words(); }
  Result<void> keep_recovery_words(std::string_view w) override { return real_->keep_recovery_words(w); }
  Result<storage::Signed> sign(std::span<const std::byte> b) override { return real_->sign(b); }
  Result<void> append_audit(const storage::AuditEvent& e) override { return real_->append_audit(e); }
  Result<std::vector<storage::AuditRecord>> audit(std::int64_t a, std::int64_t l) override {
    return real_->audit(a, l);
  }

 private:
  std::unique_ptr<storage::Store> real_;
  const std::atomic<std::optional<Errc>>& error_;
};

}  // namespace relievo::test
