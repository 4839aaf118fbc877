// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What others make of our files, and we of theirs: OpenCV's FileStorage reads and writes the same
// numbers; pictures rectified by a camera_info pair, as ROS's image_proc does it (OpenCV's
// undistortion with K, D, R and P), have every point on one row at the right disparity; Python's YAML
// reader sees what was written.
#include <gtest/gtest.h>

#include <cstdio>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/pipeline/calibrate/file/sample_rig.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace relievo::tests {
namespace {

using pipeline::StereoCalibration;

cv::Mat matrix_of(const pipeline::CameraIntrinsics& c) {
  return (cv::Mat_<double>(3, 3) << c.focal_px.x, 0, c.centre_px.x, 0, c.focal_px.y, c.centre_px.y, 0, 0, 1);
}
cv::Mat distortion_of(const pipeline::CameraIntrinsics& c) {
  return cv::Mat(1, 5, CV_64F, const_cast<double*>(c.distortion)).clone();
}
cv::Mat rotation_of(const StereoCalibration& c) {
  return cv::Mat(3, 3, CV_64F, const_cast<double*>(c.right_from_left.rotation.m)).clone();
}
cv::Mat translation_of(const StereoCalibration& c) {
  const auto& t = c.right_from_left.translation_mm;
  return (cv::Mat_<double>(3, 1) << t.x, t.y, t.z);
}
double off(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(Interchange, OpenCvReadsOurs) {
  const test::TemporaryFolder here;
  ASSERT_TRUE(pipeline::write_calibration(here / "rig.yml", sample_rig()));
  const cv::FileStorage file((here / "rig.yml").string(), cv::FileStorage::READ);
  cv::Mat k1, d1, k2, d2, r, t;
  file["K1"] >> k1, file["D1"] >> d1, file["K2"] >> k2, file["D2"] >> d2, file["R"] >> r, file["T"] >> t;
  const StereoCalibration c = sample_rig();
  EXPECT_EQ(static_cast<int>(file["image_width"]), 1920);
  EXPECT_EQ(static_cast<double>(file["pair_rms_px"]), c.rms_px);
  EXPECT_EQ(off(k1, matrix_of(c.left)), 0);
  EXPECT_EQ(off(d2, distortion_of(c.right)), 0);
  EXPECT_EQ(off(r, rotation_of(c)), 0);
  EXPECT_EQ(off(t, translation_of(c)), 0);
}

TEST(Interchange, WeReadOpenCvs) {
  const test::TemporaryFolder here;
  const StereoCalibration c = sample_rig();
  cv::Mat d8 = cv::Mat::zeros(8, 1, CV_64F);
  cv::Mat(distortion_of(c.right).t()).copyTo(d8.rowRange(0, 5));
  {
    cv::FileStorage in((here / "intrinsics.yml").string(), cv::FileStorage::WRITE);
    in << "M1" << matrix_of(c.left) << "D1" << distortion_of(c.left) << "M2" << matrix_of(c.right) << "D2"
       << d8;
    cv::Mat r1, r2, p1, p2, q;
    cv::stereoRectify(matrix_of(c.left), distortion_of(c.left), matrix_of(c.right), d8, {1920, 1200},
                      rotation_of(c), translation_of(c), r1, r2, p1, p2, q);
    cv::FileStorage ex((here / "extrinsics.yml").string(), cv::FileStorage::WRITE);
    ex << "R" << rotation_of(c) << "T" << translation_of(c) << "R1" << r1 << "R2" << r2 << "P1" << p1 << "P2"
       << p2 << "Q" << q;
  }
  const auto read = pipeline::read_calibration(here / "intrinsics.yml", {1920, 1200, 0});
  ASSERT_TRUE(read) << read.error().where() << ": " << read.error().what.view();
  EXPECT_LT(difference(*read, c), 1e-15);
}

// stereoRectify's own matrices, as ROS's calibrator stores them, give the relation back.
TEST(Interchange, TheRelationIsFoundInBouguetsRectification) {
  const StereoCalibration c = sample_rig();
  cv::Mat r1, r2, p1, p2, q;
  cv::stereoRectify(matrix_of(c.left), distortion_of(c.left), matrix_of(c.right), distortion_of(c.right),
                    {1920, 1200}, rotation_of(c), translation_of(c) / 1000, r1, r2, p1, p2, q,
                    cv::CALIB_ZERO_DISPARITY, 0);
  const auto list = [](const cv::Mat& m) {
    std::string text;
    for (int i = 0; i < m.rows * m.cols; ++i) {
      char number[40];
      std::snprintf(number, sizeof number, "%s%.17g", i == 0 ? "" : ", ",
                    m.at<double>(i / m.cols, i % m.cols));
      text += number;
    }
    return "  rows: " + std::to_string(m.rows) + "\n  cols: " + std::to_string(m.cols) + "\n  data: [" +
           text + "]\n";
  };
  const auto info = [&](const pipeline::CameraIntrinsics& camera, const cv::Mat& r, const cv::Mat& p) {
    return "image_width: 1920\nimage_height: 1200\ncamera_name: x\ncamera_matrix:\n" +
           list(matrix_of(camera)) + "distortion_model: plumb_bob\ndistortion_coefficients:\n" +
           list(distortion_of(camera)) + "rectification_matrix:\n" + list(r) + "projection_matrix:\n" +
           list(p);
  };
  const auto read = pipeline::parse_calibration_pair(info(c.left, r1, p1), info(c.right, r2, p2));
  ASSERT_TRUE(read) << read.error().where() << ": " << read.error().what.view();
  EXPECT_LT(difference(*read, c), 1e-11);
}

struct Rectified {
  cv::Mat k, d, r, p;
};
Rectified rectified(const std::string& text) {
  // OpenCV reads any YAML of this form once its own first line stands before it.
  cv::FileStorage file("%YAML:1.0\n---\n" + text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  const auto matrix = [&file](const char* name) {
    const cv::FileNode node = file[name];
    std::vector<double> values;
    node["data"] >> values;
    return cv::Mat(values, true).reshape(1, static_cast<int>(node["rows"]));
  };
  return {matrix("camera_matrix"), matrix("distortion_coefficients"), matrix("rectification_matrix"),
          matrix("projection_matrix")};
}

TEST(Interchange, ImageProcWouldRectifyRightly) {
  const StereoCalibration c = sample_rig();
  const auto texts = pipeline::camera_info_texts(c);
  ASSERT_TRUE(texts);
  const Rectified left = rectified(texts->left), right = rectified(texts->right);
  std::vector<cv::Point3d> points;
  for (double z : {450.0, 560.0, 700.0})
    for (double x : {-60.0, 0.0, 70.0})
      for (double y : {-80.0, 10.0, 90.0}) points.emplace_back(x + 40, y, z);
  cv::Mat turn;
  cv::Rodrigues(rotation_of(c), turn);
  std::vector<cv::Point2d> in_left, in_right, l, r;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix_of(c.left), distortion_of(c.left), in_left);
  cv::projectPoints(points, turn, translation_of(c), matrix_of(c.right), distortion_of(c.right), in_right);
  const auto undistort = [](const std::vector<cv::Point2d>& from, const Rectified& by,
                            std::vector<cv::Point2d>& to) {
    cv::undistortPoints(from, to, by.k, by.d, by.r, by.p,
                        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-14));
  };
  undistort(in_left, left, l);
  undistort(in_right, right, r);
  const double f = left.p.at<double>(0, 0), baseline_mm = -1000 * right.p.at<double>(0, 3) / f;
  EXPECT_EQ(left.p.at<double>(1, 2), right.p.at<double>(1, 2)) << "one row for both";
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(l[i].y, r[i].y, 1e-6);
    const cv::Mat seen = left.r * cv::Mat(points[i]);
    const double disparity = (l[i].x - left.p.at<double>(0, 2)) - (r[i].x - right.p.at<double>(0, 2));
    EXPECT_NEAR(f * baseline_mm / disparity, seen.at<double>(2), 1e-5);
    EXPECT_TRUE(l[i].x > 0 && l[i].x < 1920 && r[i].x > 0 && r[i].x < 1920)
        << "the middle of the field stays in the pictures";
  }
}

TEST(Interchange, PythonReadsTheSame) {
  const test::TemporaryFolder here;
  if (test::run_program({"/usr/bin/python3", "-c", "import yaml"}, here.path()).exit_code != 0)
    GTEST_SKIP() << "python3-yaml is not installed";
  const auto texts = pipeline::camera_info_texts(sample_rig());
  ASSERT_TRUE(texts);
  test::write_text(here / "right.yaml", texts->right);
  const auto said = test::run_program(
      {"/usr/bin/python3", "-c",
       "import yaml; d = yaml.safe_load(open('right.yaml')); "
       "print(d['image_width'], d['camera_name'], d['distortion_model'], repr(d['camera_matrix']['data'][0]), "
       "repr(d['distortion_coefficients']['data'][2]), d['projection_matrix']['rows'], len(d['projection_matrix']['data']))"},
      here.path());
  EXPECT_EQ(said.out, "1920 right plumb_bob 2942.25 0.00024 3 12\n") << said.err;
}

}  // namespace
}  // namespace relievo::tests
