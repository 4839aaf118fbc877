// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// EnrolmentSession: everything the appliance knows about the person in front of it, and nothing
// afterwards. It owns the arenas; what the stages make lives in them, the products themselves too.
//
//   closed --open(subject)--> open --close()--> closed: every byte that was used is zero
//                             |   ^
//                             +---+ retake(): pictures and products go, the subject stays, and the live
//                                   picture if told so
//                                   rework(): only products go, of some stages or all
//
// Thread: main opens and closes, and only while no job runs; a running job has the products.
#pragma once

#include <string.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "firmware/base/boot_memory.h"
#include "firmware/base/budget.h"
#include "firmware/capture/stereo_grabber.h"
#include "firmware/machine/machine.h"
#include "hal/base/arena.h"
#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "pipeline/calibrate/drift.h"
#include "pipeline/fuse/pose_registration.h"
#include "pipeline/model/advice.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/stereo_frame.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

// LiveFeed: the newest small picture of the person, from the capture thread to the screen. Three buffers: one
// is being filled, one is the newest, one is on the screen; nobody waits.
// Thread: fill() and publish() capture, newest() main; wipe() and forget_guidance() main, and only while no
// job runs.

class LiveFeed {
 public:
  // `side_px`: the longer side of its pictures at most. Room for budget::kLiveSidePx is taken at once; for
  // more with the first larger picture (bad_alloc); it stays, for the screen may still hold a view of it.
  explicit LiveFeed(int side_px = budget::kLiveSidePx);
  // A copy of the picture, shrunk by a whole number.
  ImageView fill(const ImageView& picture);
  // What fill() made, to draw into before it is published.
  std::uint8_t* filled() { return slots_[filling_].rgb.data(); }
  // With what fill() made.
  void publish(ui::LiveView guidance);
  // Its picture is valid until the next newest(). Number 0: none since the last wipe.
  ui::LiveView newest();
  void wipe();
  // The newest picture stays; what was said of it goes.
  void forget_guidance();

 private:
  struct Slot {
    std::vector<std::uint8_t> rgb;
    ui::LiveView live;
  };
  int side_px_;
  std::array<Slot, budget::kLiveSlots> slots_;
  std::mutex mutex_;
  std::size_t filling_ = 0, newest_ = 1, shown_ = 2;
  bool fresh_ = false;
  std::uint32_t count_ = 0;
};

// StagePictures: small square pictures of the face for the screen: the photograph, then one for each stage
// that is done. Fixed memory, part of the session: wiped with it. Thread: who takes or makes it draws its
// picture before it reports; main reads those reported.
// Capture, Match, Reconstruct, Mesh, Texture; Assemble has none.
inline constexpr std::size_t kStagePictures = 5;

class StagePictures {
 public:
  static constexpr int kSide = budget::kStagePictureSidePx;

  StagePictures() {
    for (One& one : pictures_) one.rgb.resize(std::size_t{3} * kSide * kSide);
  }
  std::uint8_t* begin(std::size_t stage) { return pictures_[stage].rgb.data(); }
  void done(std::size_t stage) { pictures_[stage].number = ++count_; }
  std::uint32_t number(std::size_t stage) const { return pictures_[stage].number; }  // 0: not drawn
  ImageView view(std::size_t stage) const {
    return {reinterpret_cast<const std::byte*>(pictures_[stage].rgb.data()), kSide, kSide, 3 * kSide,
            PixelFormat::Rgb8};
  }
  void wipe() {
    for (One& one : pictures_) {
      if (one.number != 0) explicit_bzero(one.rgb.data(), one.rgb.size());
      one.number = 0;
    }
  }

 private:
  struct One {
    std::vector<std::uint8_t> rgb;
    std::uint32_t number = 0;
  };
  std::array<One, kStagePictures> pictures_;
  std::uint32_t count_ = 0;
};

// A picture's pixels, row by row without padding: how many bytes, and a copy of them.
std::size_t packed_bytes(const ImageView& view);
ImageView packed(const ImageView& view, std::byte* to);

// SidePairs: the pairs that show a head from its sides, on their way from the capture thread to the worker,
// and the room where the worker keeps what each pose comes to. A pair waits in the room of its own pose;
// next() hands out a copy, so that the pose can be made there.
//
//   capture: add() ... end()        worker: next() until there is none; kept(pose)
//
// Fixed memory, of the session: wipe() leaves no pixel behind. Thread: as shown; wipe() and begin() main,
// while no job runs.
class SidePairs {
 public:
  static constexpr std::size_t kPoses = pipeline::kSides + 1;  // the front's among them

  // A tenth for the copy, the rest for the poses, alike. Empty: no sides are taken.
  explicit SidePairs(std::span<std::byte> block);
  // A session's first side comes next.
  void begin();
  // OutOfMemory: pictures larger than the room; InvalidState: all sides are there.
  Result<void> add(const pipeline::StereoFrame& pair);
  // No more will come.
  void end();
  std::size_t count() const;
  // As it lies in its room; while no job runs.
  const pipeline::StereoFrame& waiting(std::size_t side) const { return pairs_.at(side); }
  // Waits for the next; none: no more come, or the job was cancelled. Valid until the next call.
  std::optional<pipeline::StereoFrame> next(const std::atomic<bool>& cancelled);
  // Room of a pose: 0 is the front's, then the sides' in their order.
  Arena& kept(std::size_t pose) { return kept_.at(pose); }
  void wipe();

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::span<std::byte> copy_;
  std::array<std::span<std::byte>, kPoses> rooms_;
  std::array<Arena, kPoses> kept_;
  std::array<pipeline::StereoFrame, pipeline::kSides> pairs_{};  // as they lie in the rooms
  std::size_t added_ = 0, handed_out_ = 0;
  bool ended_ = false;
};

// What each stage leaves for the next.
struct Products {
  std::optional<pipeline::StereoFrame> frame;
  std::optional<pipeline::RectifiedPair> pair;
  std::optional<pipeline::MatchSet> matches;
  std::optional<pipeline::DriftJudgement> drift;  // what the matches say of the calibration
  std::optional<pipeline::PointCloud> cloud;
  std::optional<pipeline::FaceMesh> mesh;         // until it is in the model
  std::optional<pipeline::TextureAtlas> texture;  // so is this
  std::optional<pipeline::FaceModel> model;
  std::optional<pipeline::Registration> registration;  // where the model is a head from several pairs
};

class EnrolmentSession {
 public:
  explicit EnrolmentSession(const BootMemory& memory)
      : slot_(memory.frames().first(memory.frames().size() / 2)),
        spare_slot_(memory.frames().subspan(memory.frames().size() / 2)),
        output_(memory.output()),
        scratch_block_(memory.scratch()),
        sides_(memory.sides()),
        follow_block_(memory.follow()) {}
  ~EnrolmentSession() { close(); }
  EnrolmentSession& operator=(EnrolmentSession&&) = delete;

  // A subject's name longer than kSubjectNameBytes is InvalidInput; an open session InvalidState.
  Result<void> open(std::string_view subject);
  // With `keep_mirror` the newest live picture stays on the screen until there is another.
  void retake(bool keep_mirror = false);
  // The products of this stage and of those after it go, never the pictures: they can run once more. Also on
  // the worker.
  void rework(State from);
  // What comes into output() from now on is this stage's. Thread: worker.
  void begins(State stage) { stage_begins_.at(number_of(stage)) = output_.used(); }
  void close();
  bool is_open() const { return open_; }

  // A capture of the session; its views lie in one of the two slots. Thread: capture.
  void took(const pipeline::StereoFrame& frame);
  // The slot that no capture lies in: for pictures beside it, which their maker wipes. Thread: capture.
  StereoSlot& free_slot() { return holds_ == &slot_ ? spare_slot_ : slot_; }

  std::string_view subject() const { return {subject_.data()}; }
  Products& products() const;
  StereoSlot& slot() { return slot_; }
  // Small pictures for the screen: of the person, and of what the stages made.
  LiveFeed& live() { return live_; }
  StagePictures& stage_pictures() { return stage_pictures_; }
  StereoSlot& spare_slot() { return spare_slot_; }  // of a burst, which keeps its best pair in one of the two
  Arena& output() { return output_; }
  std::size_t stage_bytes() const { return output_.capacity() + scratch_block_.size(); }
  // Of a head that turns. Without memory for it (has_sides()) one pair makes a face.
  bool has_sides() const { return !follow_block_.empty(); }
  SidePairs& sides() { return sides_; }
  // For the capture thread, while the worker has output() and the scratch: cut in two.
  std::span<std::byte> follow_block() { return follow_block_; }
  // A scratch arena of one stage's own, so that its peak can be told; what it touched the session wipes.
  class Scratch {
   public:
    explicit Scratch(EnrolmentSession& session) : session_(session), arena_(session.scratch_block_) {}
    ~Scratch() { session_.scratch_touched_ = std::max(session_.scratch_touched_, arena_.high_water()); }
    Scratch& operator=(Scratch&&) = delete;
    Arena& arena() { return arena_; }

   private:
    EnrolmentSession& session_;
    Arena arena_;
  };

 private:
  void make_products();
  void wipe_products();
  void wipe_taken();
  void wipe();

  StereoSlot slot_;
  LiveFeed live_;
  StagePictures stage_pictures_;
  StereoSlot spare_slot_;
  const StereoSlot* holds_ = nullptr;  // the capture
  Arena output_;
  std::array<std::size_t, kStages.size()> stage_begins_{};  // in output_
  std::span<std::byte> scratch_block_;
  std::size_t scratch_touched_ = 0;
  SidePairs sides_;
  std::span<std::byte> follow_block_;
  bool open_ = false;             // the main thread's, while jobs make and wipe the products
  Products* products_ = nullptr;  // at the front of output_
  std::array<char, budget::kSubjectNameBytes + 1> subject_{};
};

}  // namespace relievo::firmware
