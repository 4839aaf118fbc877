// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>

#include "pipeline/match/region/face_region.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kProfile = 3;
constexpr int kSearchHeightPx = 400;    // the picture is reduced to this height before the search
constexpr double kSmallestFace = 0.15;  // width of the smallest face, share of the picture's height
constexpr int kCertainVotes = 8;        // a hit with this many votes ends the search
constexpr int kLeastVotes = 4;          // fewer are no face
constexpr double kTiltDeg = 15;         // how far the picture is turned for tilted heads

// One look at the picture. Cheap and likely ones first.
struct Try {
  std::size_t cascade;
  bool local_contrast;  // CLAHE: faces in poor or one-sided light
  int tilt;             // times kTiltDeg
  bool mirrored;        // the profile cascade knows one side only
};
constexpr std::array<Try, 16> kTries = {{
    {0, false, 0, false},
    {1, false, 0, false},
    {2, false, 0, false},
    {0, true, 0, false},
    {1, true, 0, false},
    {2, true, 0, false},
    {0, false, 1, false},
    {0, false, -1, false},
    {1, false, 1, false},
    {1, false, -1, false},
    {0, true, 1, false},
    {0, true, -1, false},
    {kProfile, false, 0, false},
    {kProfile, false, 0, true},
    {kProfile, true, 0, false},
    {kProfile, true, 0, true},
}};

cv::Mat reduced_grey(const ImageView& view) {
  const int type = view.format == PixelFormat::Rgb8     ? CV_8UC3
                   : view.format == PixelFormat::Grey16 ? CV_16UC1
                                                        : CV_8UC1;
  // OpenCV wants a pointer it could write through; nothing here writes.
  const cv::Mat picture(view.height_px, view.width_px, type, const_cast<std::byte*>(view.bytes),
                        std::size_t(view.stride_bytes));
  const double scale = std::min(1.0, double(kSearchHeightPx) / view.height_px);
  cv::Mat small;
  const cv::Size size(std::max(1, int(std::lround(view.width_px * scale))),
                      std::max(1, int(std::lround(view.height_px * scale))));
  cv::resize(picture, small, size, 0, 0, cv::INTER_AREA);
  if (type == CV_8UC3) cv::cvtColor(small, small, cv::COLOR_RGB2GRAY);
  if (type == CV_16UC1) small.convertTo(small, CV_8U, 1.0 / 257);
  return small;
}

}  // namespace

Result<void> load_cascade(const std::string& folder, FaceCascade which, cv::CascadeClassifier& cascade) {
  RELIEVO_TRY_ASSIGN(const std::string text, read_cascade(folder, which));
  try {
    const cv::FileStorage file(text,
                               cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_XML);
    if (cascade.read(file.getFirstTopLevelNode())) return {};
  } catch (const cv::Exception&) {  // as unreadable as what read() refuses
  }
  return Error{Errc::LibraryFailed, "OpenCV cannot read the face cascades: reinstall the package opencv-data"}
      .at(folder);
}

struct FaceFinder::Cascades {
  std::array<cv::CascadeClassifier, kFaceCascades> files;

  // In the reduced picture.
  FaceBox look(const cv::Mat& grey, const cv::Mat& even, const Try& look_at) {
    cv::Mat picture = look_at.local_contrast ? even : grey;
    const double a = look_at.tilt * kTiltDeg * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
    const double cx = (grey.cols - 1) / 2.0, cy = (grey.rows - 1) / 2.0;
    const cv::Matx23d turn{c, -s, cx - c * cx + s * cy, s, c, cy - s * cx - c * cy};
    if (look_at.tilt != 0) {
      cv::Mat turned;
      cv::warpAffine(picture, turned, turn, picture.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      picture = turned;
    }
    if (look_at.mirrored) {
      cv::Mat other;
      cv::flip(picture, other, 1);
      picture = other;
    }
    const int least = std::max(20, int(kSmallestFace * grey.rows));
    std::vector<cv::Rect> boxes;
    std::vector<int> votes;
    files[look_at.cascade].detectMultiScale(picture, boxes, votes, 1.08, kLeastVotes - 1, 0, {least, least});
    // The most votes times width win: of faces as certain the wider one, which is nearer.
    FaceBox hit;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (double(votes[i]) * boxes[i].width <= hit.votes * hit.width_px) continue;
      hit = {{boxes[i].x + (boxes[i].width - 1) / 2.0, boxes[i].y + (boxes[i].height - 1) / 2.0},
             double(boxes[i].width),
             votes[i]};
    }
    if (look_at.mirrored) hit.centre_px.x = grey.cols - 1 - hit.centre_px.x;
    if (look_at.tilt != 0) {
      cv::Matx23d back;
      cv::invertAffineTransform(turn, back);
      hit.centre_px = {back(0, 0) * hit.centre_px.x + back(0, 1) * hit.centre_px.y + back(0, 2),
                       back(1, 0) * hit.centre_px.x + back(1, 1) * hit.centre_px.y + back(1, 2)};
    }
    return hit;
  }
};

Result<FaceFinder> FaceFinder::open(const std::string& cascade_folder) {
  auto cascades = std::make_shared<Cascades>();
  for (std::size_t i = 0; i < kFaceCascades; ++i)
    RELIEVO_TRY(load_cascade(cascade_folder, static_cast<FaceCascade>(i), cascades->files[i]));
  return FaceFinder(std::move(cascades));
}

Result<FaceBox> FaceFinder::find(const ImageView& picture, const std::atomic<bool>* cancelled) const {
  if (picture.empty()) return invalid("a picture without pixels has no face");
  try {
    const cv::Mat grey = reduced_grey(picture);
    cv::Mat even;
    cv::createCLAHE(3, {8, 8})->apply(grey, even);
    const double scale = double(picture.height_px) / grey.rows;
    FaceBox best;
    for (const Try& look_at : kTries) {
      if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) return stopped();
      const FaceBox hit = cascades_->look(grey, even, look_at);
      if (hit.votes < kLeastVotes || hit.votes <= best.votes) continue;
      best = {{(hit.centre_px.x + 0.5) * scale - 0.5, (hit.centre_px.y + 0.5) * scale - 0.5},
              hit.width_px * scale,
              hit.votes};
      if (best.votes >= kCertainVotes) break;
    }
    if (best.votes == 0)
      return Error{
          Errc::NoFace,
          "no face in the left picture: look straight into the cameras from about half a metre, with light on the face"};
    return best;
  } catch (const cv::Exception&) {
    return Error{Errc::LibraryFailed, "OpenCV gave up looking for a face in this picture"};
  }
}

}  // namespace relievo::pipeline
