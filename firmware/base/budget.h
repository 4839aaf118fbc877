// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every limit of the appliance, with its name: memory, sizes, times. Nowhere else is one written down.
// Memory is one block taken at boot and cut by BootMemory; pages of it that nothing touches cost
// nothing. Bytes; pixels; std::chrono.
#pragma once

#include <chrono>
#include <cstddef>

namespace relievo::firmware::budget {

inline constexpr std::size_t kMiB = std::size_t{1} << 20;

// --- pictures -----------------------------------------------------------------------------------
// Of the largest sensor of the parts list: 5 megapixels.
inline constexpr std::size_t kMostFramePixels = std::size_t{2448} * 2048;
inline constexpr std::size_t kFrameBytes = 3 * kMostFramePixels;
// Two pictures, and a byte a pixel to develop one behind a colour filter.
inline constexpr std::size_t kStereoSlotBytes = 2 * kFrameBytes + kFrameBytes / 3;
inline constexpr int kLiveSidePx = 640;          // longer side of the live picture on the screen
inline constexpr int kWatchedSidePx = 1920;      // of a camera's on the technician's: a page's own pixels
inline constexpr int kStagePictureSidePx = 400;  // of a stage's picture, a square
inline constexpr int kTechnicianPictureSidePx = 720;  // longer side of a picture on the technician's pages
inline constexpr std::size_t kStereoSlots =
    2;  // a burst's best pair, kept until the session closes, and its newest

// --- memory -------------------------------------------------------------------------------------
// The appliance's block by the size of its cameras' pictures. What lies on a picture's lattice grows with
// them; what lies on the head does not. Measured at 1920 x 1200 with every algorithm: products 100 MiB (with
// the completed head 141), scratch of one pair 183, of a head of six pairs 241 (completed 325), a pose 21
// to 24.
struct MemoryPlan {
  std::size_t frames = 0, products = 0, scratch = 0;
  std::size_t sides = 0, follow = 0;  // without these one pair makes a face
  constexpr std::size_t all() const { return frames + products + scratch + sides + follow; }
};
inline constexpr std::size_t kHeadPoses = 5;  // the front and four sides
// Of a head from several pairs each has both rectified photographs, 6 bytes a pixel, and its surface, 32
// bytes a node: of the picture's pixels one in six was a node at most.
constexpr std::size_t pose_bytes(std::size_t pixels) { return 47 * pixels / 4; }
constexpr MemoryPlan plan_of_a_face(std::size_t pixels) {
  return {kStereoSlots * 7 * pixels, 64 * kMiB + 44 * pixels, 48 * kMiB + 84 * pixels};
}
// One pose more is copied to be worked on; the head is followed while the worker is at the pairs before.
constexpr MemoryPlan plan_of_a_head(std::size_t pixels) {
  MemoryPlan plan = plan_of_a_face(pixels);
  plan.scratch = plan.scratch < 480 * kMiB ? 480 * kMiB : plan.scratch;
  plan.sides = kHeadPoses * pose_bytes(pixels) * 10 / 9;
  plan.follow = 48 * kMiB;
  return plan;
}
inline constexpr MemoryPlan kLargestPlan = plan_of_a_head(kMostFramePixels);

// The technician's pages: both pictures of five stages and one of four; beside them, of every result that
// was put aside, one picture of each stage and the model (a simulated face at 1920 x 1200: 463,000 triangles
// and 775,000 texels, 26 MiB; what is larger than the room is not kept).
inline constexpr std::size_t kTechnicianPictureBytes =
    std::size_t{3} * kTechnicianPictureSidePx * kTechnicianPictureSidePx;
inline constexpr std::size_t kKeptResults = 3;
inline constexpr std::size_t kKeptModelBytes = 40 * kMiB;
inline constexpr std::size_t kTechnicianBytes =
    (14 + 9 * kKeptResults) * kTechnicianPictureBytes + kKeptResults * kKeptModelBytes;

// Live pictures (session/session.h): the visitor's, two of a calibration, one of a relief; two cameras'
// that are watched, whose room is taken when they are.
inline constexpr std::size_t kLiveSlots = 3;  // one is filled, one is the newest, one is on the screen
constexpr std::size_t live_feed_bytes(std::size_t side_px) { return kLiveSlots * 3 * side_px * side_px; }
inline constexpr std::size_t kLiveBytes =
    4 * live_feed_bytes(kLiveSidePx) + 2 * live_feed_bytes(kWatchedSidePx);

// The heap, everybody's: screen, store, libraries, and the textures of a GL driver that draws in software.
// What comes on top of it is refused (base/process_memory.h): pages that a driver maps, and stacks.
inline constexpr std::size_t kHeapBytes = 384 * kMiB, kDriverBytes = 128 * kMiB;
// For the solid beside an exported model, while it is made: 27 and 147 MiB of a face at 1920 x 1200, which
// grow with its mesh.
inline constexpr std::size_t kSolidProductBytes = 80 * kMiB, kSolidScratchBytes = 400 * kMiB;
inline constexpr std::size_t kSolidBytes = kSolidProductBytes + kSolidScratchBytes;
// Of the machine's memory, for the process.
constexpr std::size_t appliance_bytes(std::size_t pixels) {
  return plan_of_a_head(pixels).all() + kTechnicianBytes + kLiveBytes + kHeapBytes + kDriverBytes +
         kSolidBytes;
}

// --- queues and names ---------------------------------------------------------------------------
inline constexpr std::size_t kEventQueueLength = 32;
inline constexpr std::size_t kSubjectNameBytes = 200;  // as many as the store takes

// --- threads ------------------------------------------------------------------------------------
inline constexpr int kMaxPoolThreads = 4;  // inside the worker, the worker counted

// --- time ---------------------------------------------------------------------------------------
using std::chrono::microseconds;
using std::chrono::milliseconds;
inline constexpr milliseconds kTick{50};  // the main loop turns at least this often
inline constexpr milliseconds kHangLimit{
    8'000};  // the main loop has not turned: the program is ended (base/sentinel.h)
inline constexpr milliseconds kLivePause{30};  // between two live pictures: others need the processor, too
inline constexpr microseconds kTriggerPulse{100};
inline constexpr milliseconds kFrameWait{2000};         // from the trigger to both pictures
inline constexpr microseconds kMaxSkew{100};            // between the two exposures of a pair at one trigger
inline constexpr microseconds kMaxFreeSkew{17'000};     // without a trigger wire: half a frame at 30 a second
inline constexpr microseconds kStampSlack{1000};        // how much a frame may seem older than its pulse
inline constexpr microseconds kLongestExposure{8'000};  // a face that moves 25 mm a second smears 0.2 mm
inline constexpr int kGrabTries = 3;                    // pulses, until a pair that was refused is an error
inline constexpr milliseconds kCameraRetryFirst{
    250};  // after a camera has vanished; doubles with each attempt
inline constexpr milliseconds kCameraRetryMost{8'000};
inline constexpr milliseconds kCameraReturn{
    20'000};                                // a self-test waits this long for a camera that was there
inline constexpr int kCaptureAttempts = 3;  // until a person is asked to come again
inline constexpr int kBurstPairs = 5;       // of which the sharpest, stillest is kept
inline constexpr milliseconds kSelfTestLimit{30'000};
// The three that wait for a person outlast the question whether somebody is there, however it is set
// (appliance/appliance.cc): they end it only where the page does not.
inline constexpr milliseconds kPositionLimit{240'000};  // nobody touches the screen: nothing is photographed
inline constexpr milliseconds kCaptureLimit{30'000};
inline constexpr milliseconds kTurnPatience{20'000};  // without a new side: what there is will do
inline constexpr milliseconds kTurnLimit{90'000};
inline constexpr milliseconds kFuseLimit{120'000};    // of the pairs that are left and the head of all
inline constexpr milliseconds kStageLimit{60'000};    // a stage that runs longer is stopped
inline constexpr milliseconds kReviewLimit{240'000};  // nobody answers: nothing is kept
inline constexpr milliseconds kStoreLimit{30'000};
inline constexpr milliseconds kExportLimit{600'000};    // since its progress grew last
inline constexpr milliseconds kTakeHomeLimit{180'000};  // 80 MB on a slow stick, twice
inline constexpr milliseconds kStickLook{500};          // between two looks for a visitor's stick
inline constexpr milliseconds kCalibrateLimit{600'000};
inline constexpr milliseconds kStaffLimit{360'000};
inline constexpr milliseconds kFaultRetry{5'000};  // a fault tests itself again after this
inline constexpr milliseconds kShortOfMemory{
    2'000};  // what was asked could not be done for so long: the program is ended
inline constexpr milliseconds kMemoryIsBack{10'000};  // when so long nothing failed for want of it
inline constexpr milliseconds kHealthLook{10'000};    // between two looks at heat and the disk's room
inline constexpr milliseconds kMovedFacesRetry{
    60'000};                           // until what could not be noted of them is tried again
inline constexpr int kMovedFaces = 2;  // on end that say the cameras have moved: one may have nodded

}  // namespace relievo::firmware::budget
