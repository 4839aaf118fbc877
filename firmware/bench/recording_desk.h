// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RecordingDesk: the button that puts the test capture on the stick (record_capture.h), how far it is, how it
// ended, and where it lies. One at a time; who leaves ends it, and nothing half written stays.
// Thread: main; the stick is the keeper's. Errors: none are returned, view() has them.
#pragma once

#include <memory>
#include <string>

#include "firmware/bench/record_capture.h"
#include "firmware/service/errands.h"
#include "ui/bench/bench_view.h"

namespace relievo::firmware {

class RecordingDesk {
 public:
  RecordingDesk(Errands& errands, hal::Board& board) : errands_(errands), board_(board) {}
  // `as_taken`: exposure and serial numbers.
  void record(const pipeline::StereoFrame& frame, hal::RecordedPair as_taken);
  void stop();
  // There is another capture now.
  void capture_gone();
  void forget();
  ui::BenchRecording view() const;

 private:
  Errands& errands_;
  hal::Board& board_;
  std::string where_;
  ui::Outcome outcome_ = ui::Outcome::None;
  bool running_ = false;
  std::uint32_t visit_ = 0;   // what a visit to the pages before this one asked for is not told here
};

}  // namespace relievo::firmware
