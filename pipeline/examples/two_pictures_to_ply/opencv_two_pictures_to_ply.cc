// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two pictures of a face and a calibration file become a surface: two_pictures_to_ply LEFT RIGHT RIG.yml
// OUT.ply
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include "pipeline/base/workspace.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/pipeline.h"
using namespace relievo::pipeline;  // NOLINT(google-build-using-namespace): an example, not a header

relievo::Result<FaceMesh> measure(const StereoFrame& pictures, const char* rig, StageContext& context) {
  RELIEVO_TRY_ASSIGN(const StereoCalibration calibration, read_calibration(rig));
  RELIEVO_TRY_ASSIGN(const Pipeline pipeline, Pipeline::make({}, calibration));  // {}: the default algorithms
  RELIEVO_TRY_ASSIGN(RectifiedPair pair, pipeline.rectify(pictures, context));
  RELIEVO_TRY_ASSIGN(const MatchSet matches, pipeline.match(pair, context));
  RELIEVO_TRY_ASSIGN(const PointCloud cloud, pipeline.reconstruct(pair, matches, context));
  return pipeline.mesh(cloud, pair, context);
}

int main(int argc, char** argv) {
  if (argc != 5) return std::cerr << "usage: two_pictures_to_ply LEFT RIGHT RIG.yml OUT.ply\n", 2;
  const cv::Mat left = cv::imread(argv[1], cv::IMREAD_GRAYSCALE),
                right = cv::imread(argv[2], cv::IMREAD_GRAYSCALE);
  const auto view = [](const cv::Mat& m) {
    return relievo::ImageView{reinterpret_cast<const std::byte*>(m.data), m.cols, m.rows, int(m.step)};
  };
  Workspace workspace;
  const auto mesh = measure({view(left), view(right)}, argv[3], workspace.context);
  if (!mesh) return std::cerr << mesh.error().where() << ": " << mesh.error().what.view() << "\n", 1;
  std::ofstream ply(argv[4]);
  ply << "ply\nformat ascii 1.0\nelement vertex " << mesh->vertices_mm.size()
      << "\nproperty float x\nproperty float y\nproperty float z\n"
      << "element face " << mesh->triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& v : mesh->vertices_mm) ply << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const auto& t : mesh->triangles) ply << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return ply.flush() ? 0 : (std::cerr << argv[4] << ": could not be written\n", 1);
}
