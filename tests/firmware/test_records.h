// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Records in memory, that do as a test says.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <string>
#include <thread>

#include "firmware/work/jobs.h"

namespace relievo::firmware {

// Keeps names, or gives out one error after the other.
class TestRecords final : public VisitRecords {
 public:
  TestRecords(std::string& kept, std::deque<Errc>& errors) : kept_(kept), errors_(errors) {}
  RecordAnswer known;
  Result<KeptVisit> keep(const VisitRecord& record, const pipeline::FaceModel&) override {
    if (!errors_.empty()) {
      const Errc code = errors_.front();
      errors_.pop_front();
      return Error{code, "as the test says"};
    }
    kept_ += record.name.view();
    keeping = true;
    while (held.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    KeptVisit visit;
    visit.receipt = std::string_view("receipt");
    return visit;
  }
  Result<RecordAnswer> look_up(const RecordQuestion& question) override {
    asked = std::string(question.name.view()) + "/" + std::string(question.code.view());
    while (held.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return known;
  }
  std::string asked;
  std::atomic<bool> held{false}, keeping{false};

 private:
  std::string& kept_;
  std::deque<Errc>& errors_;
};

inline VisitRecord named(std::string_view name) {
  VisitRecord record;
  record.name = name;
  return record;
}

}  // namespace relievo::firmware
