// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>

#include "pipeline/gate/face/face_watch.h"

namespace relievo::pipeline {
namespace {

constexpr int kSearchHeightPx = 180;   // the picture is reduced to this height
constexpr double kSmallestFace = 0.2;  // width of the smallest face, share of the picture's height
constexpr int kLeastVotes = 4;
constexpr double kLeanDeg = 22;  // the cascades stand 15 themselves
constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

struct FaceWatch::Cascades {
  cv::CascadeClassifier frontal, profile;

  void look(cv::CascadeClassifier& cascade, const cv::Mat& grey, double scale, bool mirrored,
            FaceHits& hits) {
    const int least = std::max(20, int(kSmallestFace * grey.rows));
    std::vector<cv::Rect> boxes;
    std::vector<int> votes;
    cascade.detectMultiScale(grey, boxes, votes, 1.12, kLeastVotes - 1, 0, {least, least});
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const cv::Rect& box = boxes[i];
      double x = box.x + (box.width - 1) / 2.0;
      if (mirrored) x = grey.cols - 1 - x;
      add({{(x + 0.5) * scale - 0.5, (box.y + (box.height - 1) / 2.0 + 0.5) * scale - 0.5},
           box.width * scale,
           votes[i]},
          hits);
    }
  }

  // In the picture turned about its middle.
  void look_leaning(const cv::Mat& grey, double scale, double lean_deg, FaceHits& hits) {
    const cv::Point2f middle(float(grey.cols - 1) / 2, float(grey.rows - 1) / 2);
    cv::Mat upright;
    cv::warpAffine(grey, upright, cv::getRotationMatrix2D(middle, lean_deg, 1), grey.size());
    const int before = hits.count;
    look(frontal, upright, scale, false, hits);
    const double sine = std::sin(lean_deg * kDegree), cosine = std::cos(lean_deg * kDegree);
    for (int i = before; i < hits.count; ++i) {
      Vec2d& at = hits.hit[std::size_t(i)].centre_px;
      const double x = (at.x + 0.5) / scale - 0.5 - double(middle.x),
                   y = (at.y + 0.5) / scale - 0.5 - double(middle.y);
      at = {(cosine * x - sine * y + double(middle.x) + 0.5) * scale - 0.5,
            (sine * x + cosine * y + double(middle.y) + 0.5) * scale - 0.5};
    }
  }

  // Keeps the more certain of two that are one face.
  static void add(const FaceBox& hit, FaceHits& hits) {
    for (FaceBox& known : std::span(hits.hit).first(std::size_t(hits.count)))
      if (std::hypot(known.centre_px.x - hit.centre_px.x, known.centre_px.y - hit.centre_px.y) <
          0.6 * std::max(known.width_px, hit.width_px)) {
        if (hit.votes > known.votes) known = hit;
        return;
      }
    if (hits.count < int(hits.hit.size())) hits.hit[std::size_t(hits.count++)] = hit;
  }
};

Result<FaceWatch> FaceWatch::open(const std::string& cascade_folder) {
  auto cascades = std::make_shared<Cascades>();
  RELIEVO_TRY(load_cascade(cascade_folder, FaceCascade::Alt2, cascades->frontal));
  RELIEVO_TRY(load_cascade(cascade_folder, FaceCascade::Profile, cascades->profile));
  return FaceWatch(std::move(cascades));
}

Result<FaceHits> FaceWatch::look(const Relief& relief) {
  if (relief.width_px <= 0 || relief.height_px <= 0)
    return invalid("a picture without pixels has no face").at("face-watch");
  try {
    const cv::Mat picture(relief.height_px, relief.width_px, CV_8UC1,
                          const_cast<std::uint8_t*>(relief.grey.data()));
    const double scale = std::max(1.0, double(relief.height_px) / kSearchHeightPx);
    cv::Mat grey;
    cv::resize(picture, grey,
               {int(std::lround(relief.width_px / scale)), int(std::lround(relief.height_px / scale))}, 0, 0,
               cv::INTER_AREA);
    FaceHits hits{};
    cascades_->look(cascades_->frontal, grey, scale, false, hits);
    if (hits.count == 0) {  // poor or one-sided light
      cv::createCLAHE(3, {8, 8})->apply(grey, grey);
      cascades_->look(cascades_->frontal, grey, scale, false, hits);
    }
    if (hits.count == 0) {  // turned aside; the profile cascade knows one side only
      cascades_->look(cascades_->profile, grey, scale, false, hits);
      cv::Mat other;
      cv::flip(grey, other, 1);
      cascades_->look(cascades_->profile, other, scale, true, hits);
    }
    for (int i = 0; i < 2 && hits.count == 0; ++i)  // an ear to a shoulder
      cascades_->look_leaning(grey, scale, i == 0 ? kLeanDeg : -kLeanDeg, hits);
    // The most certain to the front; among equals the wider, which is nearer.
    const auto worth = [](const FaceBox& hit) { return hit.votes * hit.width_px; };
    for (std::size_t i = 1; i < std::size_t(hits.count); ++i)
      if (worth(hits.hit[i]) > worth(hits.hit[0])) std::swap(hits.hit[i], hits.hit[0]);
    return hits;
  } catch (const cv::Exception&) {
    return Error{Errc::LibraryFailed, "OpenCV gave up looking for faces in the live picture"}.at(
        "face-watch");
  }
}

}  // namespace relievo::pipeline
