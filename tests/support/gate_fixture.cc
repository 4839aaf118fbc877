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

CaptureGate open(int reduction) { return need(CaptureGate::open({.reduction = reduction})); }

}  // namespace

GateMeasures good_measures() {
  GateMeasures m;
  m.faces = 1;
  m.head.known = true;
  m.head.tip_mm = {70, 10, 540};
  m.head.relief_mm = 28;
  m.light.known = true;
  m.light.luminance_mean = 0.5;
  m.blur_mm = 0.5;
  for (EyeMeasurement& eye : m.eyes) eye.known = true, eye.contrast = 0.28;
  m.mouth.known = true, m.mouth.steps_mm = 0, m.mouth.before_mm = -2;
  return m;
}

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
