// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the face in a picture (Haar cascades: Viola and Jones 2001; Lienhart 2002) and marks where in
// the left rectified view its head may be, so that nothing else is matched.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/rectified_pair.h"

namespace cv {
class CascadeClassifier;
}

namespace relievo::pipeline {

// Of opencv-data 4.6.0. Other files may be good too, but nobody has measured them here.
enum class FaceCascade : std::uint8_t { Alt2, Default, Alt, Profile };
inline constexpr std::size_t kFaceCascades = 4;
inline constexpr const char* kCascadeFolder = "/usr/share/opencv4/haarcascades";  // Debian's opencv-data

// A cascade's file as text, read whole and checked by its SHA-256 before any library parses it.
// Thread: any. Errors: NotFound (no such file), StoreCorrupt (not the file we know).
Result<std::string> read_cascade(const std::filesystem::path& folder, FaceCascade which);
// Errors: those, and LibraryFailed.
Result<void> load_cascade(const std::string& folder, FaceCascade which, cv::CascadeClassifier& cascade);

struct FaceBox {
  Vec2d centre_px;      // between the eyes and the mouth, in the picture given
  double width_px = 0;  // about 150 mm on a grown-up, whatever the cascade that saw it
  int votes = 0;        // overlapping hits: 5 doubtful, 50 certain
};

// Loads the cascades once, at boot; every file's SHA-256 is checked before it is parsed.
// Thread: one caller at a time. Memory: OpenCV's own, bounded by the size of the reduced picture.
class FaceFinder {
 public:
  // Errors: those of load_cascade().
  static Result<FaceFinder> open(const std::string& cascade_folder = kCascadeFolder);

  // The most certain face; takes longest (0.4 s) where there is none, and looks at `cancelled`, when
  // given, every 30 ms. Errors: InvalidInput (an empty picture), NoFace, LibraryFailed, Cancelled.
  Result<FaceBox> find(const ImageView& picture, const std::atomic<bool>* cancelled = nullptr) const;

 private:
  struct Cascades;
  explicit FaceFinder(std::shared_ptr<Cascades> cascades) : cascades_(std::move(cascades)) {}
  std::shared_ptr<Cascades> cascades_;
};

// Finds the face in the pair's left view. Errors: as find().
Result<FaceBox> find_face(const FaceFinder& finder, const RectifiedPair& pair, StageContext& context);

// Fills pair.region with an ellipse that holds everything within about 115 mm of the tip of the nose
// at the face's depth. Memory: the region's own, one exact reserve.
// Errors: InvalidInput (no pixels, or a box of no size); throws std::bad_alloc as every stage does.
Result<void> mark_face_region(RectifiedPair& pair, const FaceBox& face, StageContext& context);

}  // namespace relievo::pipeline
