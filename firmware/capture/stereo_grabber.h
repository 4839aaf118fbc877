// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StereoGrabber: one trigger pulse, one pair of pictures of the same instant.
//
//   pulse --> left frame: copied to the slot, given back --> right frame: the same
//     ^                                                          |
//     +-- apart, damaged: counted, once more, kGrabTries at most +--> exposed within the limit? --> pair
//
// Without a trigger line the cameras run on their own: the older of two that lie apart is dropped, and
// the next of its camera tried, until the deadline. Between pulse and pair nothing is allocated, but by
// the libraries that develop colour (hal/raw/develop.h), and each picture is copied once.
//
// Errors: Timeout (no picture, or none that fits the other), Disconnected (the camera is then opened
// again by start(), see CameraLink), InvalidInput (the views differ in size or do not fit the slot),
// IoFailed (damaged each time), Cancelled, and what the devices report. After an error the streams are
// restarted. Thread: capture, where nothing else is said.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>

#include "firmware/base/budget.h"
#include "firmware/capture/face_light.h"
#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/camera.h"
#include "hal/clock.h"
#include "hal/device.h"
#include "hal/raw/raw_image.h"
#include "hal/trigger_line.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::firmware {

// StereoSlot: room for one pair of pictures, in memory taken at boot. A driver's picture is developed
// straight into it (hal/raw/develop.h), rows without padding: the one copy. wipe() leaves no pixel behind.
// Errors: InvalidInput for a picture larger than the slot, and what develop() says.
// Thread: whoever holds the slot.
class StereoSlot {
 public:
  // Cuts the block as budget::kStereoSlotBytes does: three bytes a pixel for the left, three for the
  // right, and one for developing.
  explicit StereoSlot(std::span<std::byte> block)
      : left_{block.first(block.size() / 7 * 3)},
        right_{block.subspan(block.size() / 7 * 3, block.size() / 7 * 3)},
        scratch_(block.subspan(block.size() / 7 * 6)) {}

  Result<ImageView> keep_left(const hal::RawImage& raw) { return keep(left_, raw); }
  Result<ImageView> keep_right(const hal::RawImage& raw) { return keep(right_, raw); }
  bool holds(const ImageView& view) const {
    const std::byte* const end = right_.room.data() + right_.room.size();
    return view.bytes >= left_.room.data() && view.bytes < end;
  }
  void wipe();

 private:
  struct Plane {
    std::span<std::byte> room;
    std::size_t used = 0;  // the most ever written since the last wipe
  };
  Result<ImageView> keep(Plane& plane, const hal::RawImage& raw);

  Plane left_;
  Plane right_;
  std::span<std::byte> scratch_;
  std::size_t scratch_used_ = 0;
};

// Counter: counted by one thread, read by any.
class Counter {
 public:
  Counter() = default;
  Counter(const Counter& other) : count_(other) {}
  Counter& operator=(const Counter& other) {
    if (this != &other) count_.store(other, std::memory_order_relaxed);
    return *this;
  }
  operator std::uint64_t() const {  // NOLINT(google-explicit-constructor): read as the number it is
    return count_.load(std::memory_order_relaxed);
  }
  void operator++() { *this += 1; }
  void operator--() { *this += ~std::uint64_t{0}; }
  void operator+=(std::uint64_t more) { count_.store(*this + more, std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> count_{0};
};

// GrabCounts: what has gone well and wrong between the trigger and the slot since the cameras were
// first opened; for a technician, who reads a bad cable or a slow hub out of it.
struct CameraCounts {
  Counter frames;     // taken
  Counter late;       // exposed before the pulse they were waited for, or out of order: dropped
  Counter lost;       // numbers missing in the sequence, also when it has gone on
  Counter duplicate;  // a number twice: dropped
  Counter damaged;    // the driver says that bytes are wrong: refused
  Counter too_short;  // fewer bytes than the picture has: refused
  Counter missing;    // a wait that ended without a picture
  Counter vanished;   // the camera went away
  Counter returned;   // and came back
  Counter refused;    // attempts to open it again that failed
};

struct GrabCounts {
  CameraCounts left;
  CameraCounts right;
  Counter pairs;    // handed over
  Counter apart;    // refused: exposed further apart than the limit
  Counter slipped;  // pairs by time whose numbers moved against each other: a pulse was missed
};

// CameraLink: one camera of the pair, kept alive. It drops frames that are late or came twice, refuses
// damaged and short ones, and opens a camera that has vanished again, each time after a longer wait.
//
//   New --start()--> Running --vanishes--> Lost --start() when due, it answers--> Running
//                                           |  ^
//                                           +--+ start(), it does not: the wait doubles
//
// Thread: capture; gone() any.
class CameraLink {
 public:
  CameraLink(hal::Camera& camera, const hal::Clock& clock, CameraCounts& counts)
      : camera_(camera), clock_(clock), counts_(counts) {}

  // Opens and starts what is not. What a camera that never ran says, or Disconnected: it is lost and
  // either not due yet or still away.
  Result<void> start(const hal::CaptureMode& mode);
  void stop() { camera_.stop(); }
  // Stops and starts the stream; a camera that does not start again counts as lost.
  void restart();
  // The next whole frame exposed at `asked` or later. Timeout, Cancelled, Disconnected (and it is lost),
  // IoFailed (the frame was damaged or short), what the camera says.
  Result<hal::Frame> next(hal::Instant asked, hal::Instant deadline, const std::atomic<bool>& cancelled);
  bool gone() const { return gone_.load(std::memory_order_relaxed); }
  const hal::Camera& camera() const { return camera_; }
  // How often the camera was opened: each time it may be another one.
  int opened() const { return opened_; }

 private:
  enum class Verdict : std::uint8_t { Take, Skip, Refuse };
  Result<hal::Frame> wait(hal::Instant deadline, const std::atomic<bool>& cancelled);
  Verdict judge(const hal::Frame& frame, hal::Instant asked);
  Result<void> run(const hal::CaptureMode& mode);
  void lose();

  hal::Camera& camera_;
  const hal::Clock& clock_;
  CameraCounts& counts_;
  std::atomic<bool> gone_{false};
  std::optional<std::uint32_t> last_;  // sequence number of this stream's newest frame
  std::uint32_t gap_ = 0;              // numbers before it that have not come
  hal::Instant due_;
  int opened_ = 0;
  std::chrono::milliseconds wait_ = budget::kCameraRetryFirst;
};

// Which two cameras these are, and whether they are the ones a calibration was made with. A serial number
// tells a camera wherever it is plugged in; without one, or with the same one on both, it is told by its
// socket: that an equal camera was put there is then not seen. What a camera says of itself is untrusted: it
// is kept as printable ASCII, and its end where it is long. Thread: any, while no other opens the cameras.

// After both were opened. Empty of a camera that tells nothing of itself.
pipeline::RigCameras cameras_of(const hal::Camera& left, const hal::Camera& right);

// NotCalibrated: another camera, or the two exchanged; the sentence says which and what to do, where() what
// was expected and what is there. A side of which nothing is known says nothing.
Result<void> check_cameras(const pipeline::RigCameras& calibrated, const pipeline::RigCameras& found);

// What a screen may say of the cameras.
enum class CameraWatch : std::uint8_t { Well, LeftGone, RightGone, BothGone };

struct GrabberOptions {
  // Do both cameras expose at the pulse?
  bool together = true;
  // Between the two exposures of a pair.
  std::chrono::microseconds max_skew = budget::kMaxSkew;
  // How to wait until an instant; returns early when cancelled. Empty: asleep, by the clock.
  std::function<void(hal::Instant until, const std::atomic<bool>& cancelled)> wait{};
};
// The limit a device's cameras can keep: kMaxSkew at one trigger, kMaxFreeSkew without.
GrabberOptions grabber_options(const hal::Device& device);

class StereoGrabber {
 public:
  StereoGrabber(hal::Camera& left, hal::Camera& right, hal::TriggerLine& trigger, const hal::Clock& clock,
                const GrabberOptions& options = {})
      : trigger_(trigger),
        clock_(clock),
        options_(options),
        left_(left, clock, counts_.left),
        right_(right, clock, counts_.right) {}
  explicit StereoGrabber(hal::Device& device)
      : StereoGrabber(device.left(), device.right(), device.trigger(), device.clock(),
                      grabber_options(device)) {}
  ~StereoGrabber() { stop(); }
  StereoGrabber& operator=(StereoGrabber&&) = delete;

  // Opens the cameras where they are closed and starts the streams. Both are tried before it fails.
  Result<void> start(const hal::CaptureMode& mode);
  void stop();
  // The views of the result lie in the slot. Where there will be light the lamp's rest is waited for first
  // (hal::TriggerLine::flash_allowed_at()).
  Result<pipeline::StereoFrame> grab(StereoSlot& slot, const std::atomic<bool>& cancelled,
                                     hal::Light light = hal::Light::Off);

  // Has a stream been started that was not stopped? Thread: any.
  bool streams() const { return streams_.load(std::memory_order_acquire); }
  CameraWatch watch() const;
  // Those that were opened last; empty before. Thread: any.
  pipeline::RigCameras cameras() const;
  // The cameras of the calibration in use. Thread: any.
  void expect(pipeline::RigCameras calibrated);
  // Are those opened last the ones expected? As check_cameras(); nothing is refused by start() and grab(),
  // since who calibrates anew or looks for a fault needs any camera. Thread: any.
  Result<void> check_cameras() const;
  const GrabCounts& counts() const { return counts_; }  // thread: any

 private:
  struct Half {
    ImageView view;
    hal::Instant at;
    std::uint32_t sequence = 0;
  };
  struct Shot {
    StereoSlot& slot;
    hal::Instant asked;
    hal::Instant deadline;
    const std::atomic<bool>& cancelled;
  };
  std::atomic<bool> streams_{false};
  void recognise();
  Result<Half> take(CameraLink& camera, const Shot& shot);
  Result<pipeline::StereoFrame> grab_within(const Shot& shot, hal::Light light, bool lit);
  void rest(hal::Instant until, const std::atomic<bool>& cancelled) const;
  Result<pipeline::StereoFrame> grab_once(const Shot& shot);
  Result<pipeline::StereoFrame> pair_of(const Half& left, const Half& right);

  hal::TriggerLine& trigger_;
  const hal::Clock& clock_;
  GrabberOptions options_;
  GrabCounts counts_;
  CameraLink left_;
  CameraLink right_;
  int recognised_ = 0;        // after so many openings
  mutable std::mutex names_;  // of the two below
  pipeline::RigCameras found_, expected_;
  std::optional<std::uint32_t> offset_;  // right's number minus left's, of the last pair
};

// take_burst(): several pairs in a row, of which the sharpest, stillest one is kept.
//
//   pair --> into the slot that does not hold the best --> better? --> that slot now holds the best
//
// A pair's sharpness is the worse view's, since both are matched; its movement is how much the face has
// changed since the pair before. Sharpness decides, since a face that moves smears; of pairs within a tenth
// of the sharpest the stillest is better. A pair that cannot be had is passed over; without any the last
// error is told. With a lamp the burst waits for its rest, so that five flashes take 1.05 s at the least: a
// person's eyes count more than time. Allocates nothing of its own. Errors: Cancelled, Disconnected before
// the first pair, what StereoGrabber says. Thread: capture.

inline constexpr int kMostBurstPairs = 16;

struct BurstOptions {
  int pairs = budget::kBurstPairs;  // 1 to kMostBurstPairs
  hal::Light light = hal::Light::Off;
  std::optional<FaceBox> face;  // in both views; none: their middle
};

struct BurstPair {
  double sharpness = 0;  // of the worse view; see FaceLight
  double movement = 0;   // mean change of the face since the pair before, 0 to 1
};

struct BurstResult {
  pipeline::StereoFrame frame;  // its views lie in one of the two slots
  int best = 0;
  std::array<BurstPair, kMostBurstPairs> pairs{};
};

// The face, small: enough to see that it has moved.
struct Thumbnail {
  static constexpr int kWidth = 24;
  static constexpr int kHeight = 32;
  std::array<float, std::size_t{kWidth} * kHeight> level{};
};
// Means of the box's cells, 0 to 1. InvalidInput as face_light().
Result<Thumbnail> thumbnail(const ImageView& view, const FaceBox& box);
// The mean absolute difference.
double movement(const Thumbnail& a, const Thumbnail& b);

// InvalidInput: the number of pairs. The slots are two.
Result<BurstResult> take_burst(StereoGrabber& grabber, StereoSlot& first, StereoSlot& second,
                               const BurstOptions& options, const std::atomic<bool>& cancelled);

}  // namespace relievo::firmware
