// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A toed-in rig with awkward numbers, and ways to compare and to damage its files.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/calibrate/file/calibration_file.h"

namespace relievo::tests {

inline pipeline::StereoCalibration sample_rig() {
  pipeline::StereoCalibration c;
  c.left = {
      {2955.1234567890123, 2954.9}, {964.1, 609.2}, {-0.11, 0.12, -1.6e-4, 1.6e-4, 0.1 / 3}, 1920, 1200};
  c.right = {{2942.25, 2941.6}, {971.5, 599.1}, {-0.108, 0.119, 2.4e-4, -6.6e-4, 0}, 1920, 1200};
  const double s = 0.25;
  const double k = std::sqrt(1 - s * s);
  c.right_from_left.rotation = {{k, 0, s, 0, 1, 0, -s, 0, k}};
  c.right_from_left.translation_mm = {-136.1, 0.8, 17.0 / 3};
  c.rms_px = 0.0402;
  c.epipolar_shift_px = 0.0101;
  return c;
}

inline bool same(const pipeline::StereoCalibration& a, const pipeline::StereoCalibration& b) {
  return pipeline::calibration_text(a) == pipeline::calibration_text(b);
}

// The largest difference, relative to the size of the matrix or vector it stands in.
inline double difference(const pipeline::StereoCalibration& a, const pipeline::StereoCalibration& b) {
  double worst = 0;
  const auto compare = [&worst](std::initializer_list<double> x, std::initializer_list<double> y) {
    double size = 0, off = 0;
    for (auto i = x.begin(), j = y.begin(); i != x.end(); ++i, ++j)
      size = std::max(size, std::abs(*i)), off = std::max(off, std::abs(*i - *j));
    worst = std::max(worst, size > 0 ? off / size : off);
  };
  for (const auto& [p, q] : {std::pair(&a.left, &b.left), std::pair(&a.right, &b.right)}) {
    compare({p->focal_px.x, p->focal_px.y, p->centre_px.x, p->centre_px.y},
            {q->focal_px.x, q->focal_px.y, q->centre_px.x, q->centre_px.y});
    for (int i = 0; i < 5; ++i) compare({p->distortion[i]}, {q->distortion[i]});
    EXPECT_EQ(p->width_px, q->width_px);
    EXPECT_EQ(p->height_px, q->height_px);
  }
  const double* r = a.right_from_left.rotation.m;
  const double* s = b.right_from_left.rotation.m;
  for (int i = 0; i < 9; i += 3) compare({r[i], r[i + 1], r[i + 2]}, {s[i], s[i + 1], s[i + 2]});
  const pipeline::Vec3d& t = a.right_from_left.translation_mm;
  const pipeline::Vec3d& u = b.right_from_left.translation_mm;
  compare({t.x, t.y, t.z}, {u.x, u.y, u.z});
  return worst;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// The two files of OpenCV's stereo sample, out of ours: other names, no size, a relation of its own.
struct SampleFiles {
  std::string intrinsics, extrinsics;
};
inline SampleFiles opencv_sample_files() {
  const std::string text = pipeline::calibration_text(sample_rig());
  const auto k1 = text.find("K1:"), r = text.find("R:");
  std::string cameras = text.substr(k1, r - k1);
  cameras = replaced(replaced(cameras, "K1", "M1"), "K2", "M2");
  const std::string by_product =
      "R1: !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: d\n   data: [ 1., -2.e-01 ]\n";
  return {"%YAML:1.0\n---\n" + cameras, "%YAML:1.0\n---\n" + text.substr(r) + by_product};
}

}  // namespace relievo::tests
