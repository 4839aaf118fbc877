// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A reconstruction as a document: pictures, calibration, algorithms, and what each stage made of them, in one
// SQLite database (application_id "RLVO", user_version its form, table `part`), each part under SHA-256. It
// is made and read in memory: whoever has the bytes writes them to a file whole. It holds a person's face,
// unencrypted.
//
// Errors: InvalidInput (no such document, cut, changed), Unsupported (of a newer form), OutOfMemory; none of
// the store's, since it is a file that somebody brought. Thread: any, one at a time.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <memory_resource>
#include <span>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::storage {

inline constexpr std::size_t kDocumentStages = 5;  // match, reconstruct, mesh, texture, assemble
inline constexpr std::size_t kMaxDocumentBytes = std::size_t{800} << 20;

// What a stage took and made.
struct DocumentStage {
  std::chrono::nanoseconds took{0};
  std::uint64_t in = 0, out = 0;
  std::uint64_t arena_peak_bytes = 0;
};

// What is not the product of a stage.
struct DocumentHead {
  std::string version;      // of Relievo, that made it
  std::string algorithms;   // "key = value" a line
  bool whole_view = false;  // else the face
  pipeline::StereoCalibration calibration;
  std::int64_t skew_ns = 0;              // as in StereoFrame
  std::vector<DocumentStage> stages;     // those that are done, in their order; kDocumentStages at most
  std::vector<pipeline::Match> by_hand;  // beside the matcher's (pipeline/match/hand); cost is not kept
  // What was in the files that algorithms read, by the option that names the file.
  std::map<std::string, std::shared_ptr<const std::string>, std::less<>> texts = {};
};

// What is saved; borrowed. The products of the stages that head names are there: a mesh only while it is in
// no model, a texture only in one.
struct DocumentParts {
  const DocumentHead& head;
  pipeline::StereoFrame frame;
  const pipeline::RectifiedPair* pair = nullptr;
  const pipeline::MatchSet* matches = nullptr;
  const pipeline::PointCloud* cloud = nullptr;
  const pipeline::FaceMesh* mesh = nullptr;
  const pipeline::FaceModel* model = nullptr;
};
Result<std::vector<std::byte>> make_document(const DocumentParts& parts);

class Document {
 public:
  // Borrows the bytes. All of it is checked against its checksums.
  static Result<Document> open(std::span<const std::byte> bytes);
  const DocumentHead& head() const { return head_; }
  struct Picture {
    std::vector<std::byte> bytes;
    ImageView view;
  };
  Result<Picture> picture(bool left) const;
  Result<pipeline::RectifiedPair> pair(std::pmr::memory_resource* memory) const;
  Result<pipeline::MatchSet> matches(const pipeline::RectifiedPair& of,
                                     std::pmr::memory_resource* memory) const;
  Result<pipeline::PointCloud> cloud(const pipeline::RectifiedPair& of,
                                     std::pmr::memory_resource* memory) const;
  Result<pipeline::FaceMesh> mesh(std::pmr::memory_resource* memory) const;
  Result<pipeline::FaceModel> model(std::pmr::memory_resource* memory) const;

 private:
  struct Inside;
  Document() = default;
  std::shared_ptr<Inside> inside_;
  DocumentHead head_;
};

}  // namespace relievo::storage
