// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/gate_fixture.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

namespace relievo::test {
namespace {

using namespace pipeline;  // NOLINT: its fixture

template <typename T>
T need(Result<T> made) {
  if (made) return *std::move(made);
  std::fprintf(stderr, "gate: %s\n", std::string(made.error().what.view()).c_str());
  std::exit(1);
}

CaptureGate open(int reduction) {
  CaptureGateOptions options;
  options.relief.reduction = reduction;
  return need(CaptureGate::open(options));
}

}  // namespace

GateFixture::GateFixture(int reduction)
    : work_(2, std::size_t{8} << 20, std::size_t{64} << 20), gate_(open(reduction)) {}

GateLook GateFixture::look(const StereoFrame& frame, const StereoCalibration& calibration, GateTime now,
                           GateHistory& history) {
  work_.output.reset();
  return need(run_stage(work_.context,
                        [&](StageContext& c) { return gate_.look(frame, calibration, now, history, c); }));
}

GateLook GateFixture::look(const Album& album, const Shot& shot, const Developing& how, GateTime now,
                           GateHistory& history) {
  const hal::sim::PicturePair pair = album.develop(shot, how);
  return look({pair.left.view(), pair.right.view()}, album.calibration(), now, history);
}

GateLook GateFixture::first_look(const StereoFrame& frame, const StereoCalibration& calibration) {
  GateHistory history;
  return look(frame, calibration, GateTime{}, history);
}

GateLook GateFixture::first_look(const Album& album, const Shot& shot, const Developing& how) {
  GateHistory history;
  return look(album, shot, how, GateTime{}, history);
}

}  // namespace relievo::test
