// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two pictures of a face and a calibration file become a surface: two_pictures_to_ply LEFT RIGHT RIG.yml OUT.ply
#include <fstream>
#include <iostream>

#include <opencv2/imgcodecs.hpp>

#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/pipeline.h"

using namespace relievo;            // NOLINT(google-build-using-namespace): an example, not a header
using namespace relievo::pipeline;  // NOLINT(google-build-using-namespace)

Result<FaceMesh> measure(const cv::Mat& left, const cv::Mat& right, const char* rig, StageContext& context) {
  RELIEVO_TRY_ASSIGN(const StereoCalibration calibration, read_calibration(rig));
  AlgorithmSet algorithms;  // all as by default; any other by name:
  RELIEVO_TRY(algorithms.set("texturer", "single-view"));
  RELIEVO_TRY_ASSIGN(const Pipeline pipeline, Pipeline::make(algorithms, calibration));
  const auto view = [](const cv::Mat& m) { return ImageView{reinterpret_cast<const std::byte*>(m.data), m.cols, m.rows, static_cast<int>(m.step)}; };
  RELIEVO_TRY_ASSIGN(const RectifiedPair pair, pipeline.rectify({view(left), view(right)}, context));
  RELIEVO_TRY_ASSIGN(const MatchSet matches, pipeline.match(pair, context));
  RELIEVO_TRY_ASSIGN(const PointCloud cloud, pipeline.reconstruct(pair, matches, context));
  return pipeline.mesh(cloud, context);
}

int main(int argc, char** argv) {
  if (argc != 5) return std::cerr << "usage: two_pictures_to_ply LEFT RIGHT RIG.yml OUT.ply\n", 2;
  const cv::Mat left = cv::imread(argv[1], cv::IMREAD_GRAYSCALE), right = cv::imread(argv[2], cv::IMREAD_GRAYSCALE);
  std::vector<std::byte> kept(std::size_t{320} << 20), swept(std::size_t{640} << 20);  // all the memory there will be
  Arena output(kept), scratch(swept);
  ThreadPool pool(2);
  Progress progress;
  const std::atomic<bool> cancelled{false};
  StageContext context{output, scratch, pool, progress, cancelled};
  const Result<FaceMesh> mesh = measure(left, right, argv[3], context);
  if (!mesh) return std::cerr << mesh.error().where() << ": " << mesh.error().what.view() << "\n", 1;
  std::ofstream ply(argv[4]);
  ply << "ply\nformat ascii 1.0\nelement vertex " << mesh->vertices_mm.size() << "\nproperty float x\nproperty float y\nproperty float z\n"
      << "element face " << mesh->triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3f& v : mesh->vertices_mm) ply << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const auto& t : mesh->triangles) ply << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return ply.flush() ? 0 : (std::cerr << argv[4] << ": could not be written\n", 1);
}
