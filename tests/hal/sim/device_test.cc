// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Devices without hardware: pairing, turn-taking of the camera's states, time, sticks.
#include "hal/sim/device.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "hal/recording/capture_file.h"
#include "hal/sim/replay/replay_device.h"
#include "tests/hal/temporary_folder.h"
#include "tests/support/manual_clock.h"

namespace relievo::hal {
namespace {

void put_picture(const std::filesystem::path& file, int value, int width = 16) {
  const Picture p{std::vector<std::byte>(static_cast<std::size_t>(width * 10),
                                         std::byte(static_cast<unsigned char>(value))),
                  width, 10, PixelFormat::Grey8};
  ASSERT_TRUE(write_picture(file, p.view()));
}

int first_pixel(const Frame& frame) { return std::to_integer<int>(frame.raw().bytes[0]); }
Instant soon(Device& device) { return device.clock().now() + std::chrono::seconds(5); }

TEST(FolderDevice, ReplaysPairsInNameOrderForEver) {
  const TemporaryFolder folder;
  put_picture(folder / "left_000002.png", 2);
  put_picture(folder / "right_000002.png", 12);
  put_picture(folder / "left_000001.png", 1);
  put_picture(folder / "right_000001.png", 11);
  ASSERT_TRUE(write_capture_file(folder / "capture.json",
                                 {"A", "B", {{1, 1000, 181000, 4000, 1.0}, {2, 5000, 5000, 4000, 1.0}}}));
  auto made = make_folder_device(folder.path());
  ASSERT_TRUE(made) << made.error().what.view();
  Device& device = **made;
  EXPECT_EQ(device.name(), "folder");
  EXPECT_EQ(device.preferred_mode().exposure, std::chrono::microseconds(4000));
  for (Camera* camera : {&device.left(), &device.right()}) {
    ASSERT_TRUE(camera->open(device.preferred_mode()));
    ASSERT_TRUE(camera->start());
  }
  for (const int expected : {1, 2, 1}) {
    ASSERT_TRUE(device.trigger().pulse(std::chrono::microseconds(100)));
    const auto left = device.left().next_frame(soon(device));
    const auto right = device.right().next_frame(soon(device));
    ASSERT_TRUE(left && right);
    EXPECT_EQ(first_pixel(*left), expected);
    EXPECT_EQ(first_pixel(*right), expected + 10);
    EXPECT_EQ(left->sequence(), right->sequence());
    const auto skew = right->exposed_at() - left->exposed_at();
    EXPECT_EQ(skew, expected == 1 ? std::chrono::nanoseconds(180000) : std::chrono::nanoseconds(0));
  }
}

TEST(FolderDevice, PlainNamesWorkToo) {
  const TemporaryFolder folder;
  put_picture(folder / "left.png", 1);
  put_picture(folder / "right.jpg", 2);
  EXPECT_TRUE(make_folder_device(folder.path()));
}

TEST(FolderDevice, ANameWithoutItsPartnerIsNamed) {
  const TemporaryFolder folder;
  put_picture(folder / "left_01.png", 1);
  put_picture(folder / "right_01.png", 1);
  put_picture(folder / "right_02.png", 1);
  const auto made = make_folder_device(folder.path());
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, Errc::InvalidInput);
  EXPECT_NE(made.error().where().find("right_02.png"), std::string_view::npos);
  EXPECT_NE(made.error().what.view().find("partner"), std::string_view::npos);
}

TEST(FolderDevice, MissingEmptyAndBrokenFoldersAreErrors) {
  const TemporaryFolder folder;
  EXPECT_EQ(make_folder_device(folder / "none").error().code, Errc::NotFound);
  EXPECT_EQ(make_folder_device(folder.path()).error().code, Errc::NotFound);
  put_picture(folder / "left_1.png", 1);
  put_picture(folder / "right_1.png", 1, 20);
  EXPECT_EQ(make_folder_device(folder.path()).error().code, Errc::InvalidInput);
  put_picture(folder / "right_1.png", 1);
  for (const char* bad : {"{", "[]", "{\"frames\": 3}", "{\"frames\": [{\"number\": \"x\"}]}"}) {
    std::ofstream(folder / "capture.json") << bad;
    const auto made = make_folder_device(folder.path());
    ASSERT_FALSE(made) << bad;
    EXPECT_EQ(made.error().code, Errc::InvalidInput) << bad;
    EXPECT_NE(made.error().where().find("capture.json"), std::string_view::npos);
  }
}

TEST(Camera, ACallOutOfTurnNamesTheStateItNeeds) {
  const TemporaryFolder folder;
  put_picture(folder / "left_1.png", 1);
  put_picture(folder / "right_1.png", 1);
  auto made = make_folder_device(folder.path());
  ASSERT_TRUE(made);
  Camera& camera = (*made)->left();
  const Instant now = (*made)->clock().now();
  EXPECT_EQ(camera.start().error().code, Errc::InvalidState);
  EXPECT_EQ(camera.next_frame(now).error().code, Errc::InvalidState);
  EXPECT_EQ(camera.open({640, 480, {}}).error().code, Errc::Unsupported);
  EXPECT_EQ(camera.state(), Camera::State::Closed);
  ASSERT_TRUE(camera.open((*made)->preferred_mode()));
  EXPECT_EQ(camera.open((*made)->preferred_mode()).error().code, Errc::InvalidState);
  EXPECT_EQ(camera.next_frame(now).error().code, Errc::InvalidState);
  ASSERT_TRUE(camera.start());
  EXPECT_EQ(camera.start().error().code, Errc::InvalidState);
  EXPECT_EQ(camera.next_frame(now).error().code, Errc::Timeout) << "no pulse, no picture";
  camera.stop();
  EXPECT_EQ(camera.state(), Camera::State::Idle);
  camera.stop();
  EXPECT_TRUE(camera.start());
}

TEST(Camera, AClosedCameraOpensAgain) {
  const TemporaryFolder folder;
  put_picture(folder / "left_1.png", 1);
  put_picture(folder / "right_1.png", 1);
  auto made = make_folder_device(folder.path());
  ASSERT_TRUE(made);
  Device& device = **made;
  EXPECT_FALSE(device.exposes_together()) << "recordings are as they are";
  ASSERT_TRUE(device.left().open(device.preferred_mode()) && device.left().start());
  device.left().close();
  EXPECT_EQ(device.left().state(), Camera::State::Closed);
  EXPECT_EQ(device.left().set_exposure({}).error().code, Errc::InvalidState);
  ASSERT_TRUE(device.left().open(device.preferred_mode()) && device.left().start());
  EXPECT_EQ(device.left().set_exposure({}).error().code, Errc::Unsupported);
  ASSERT_TRUE(device.trigger().pulse(std::chrono::microseconds(10)));
  EXPECT_TRUE(device.left().next_frame(soon(device)));
}

TEST(Camera, HoldingEveryFrameStopsItUntilOneIsGivenBack) {
  const TemporaryFolder folder;
  put_picture(folder / "left_1.png", 1);
  put_picture(folder / "right_1.png", 1);
  auto made = make_folder_device(folder.path());
  ASSERT_TRUE(made);
  Device& device = **made;
  ASSERT_TRUE(device.left().open(device.preferred_mode()) && device.left().start());
  std::vector<Frame> held;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(device.trigger().pulse(std::chrono::microseconds(10)));
    auto frame = device.left().next_frame(soon(device));
    ASSERT_TRUE(frame);
    held.push_back(*std::move(frame));
  }
  ASSERT_TRUE(device.trigger().pulse(std::chrono::microseconds(10)));
  EXPECT_EQ(device.left().next_frame(soon(device)).error().code, Errc::Timeout);
  held.pop_back();
  EXPECT_TRUE(device.left().next_frame(soon(device)));
}

TEST(SilentTrigger, ADeadlineComesByTheGivenClock) {
  ManualClock clock;
  SilentTrigger trigger(clock);
  EXPECT_EQ(trigger.wait_after(0, clock.now()).error().code, Errc::Timeout);
  EXPECT_EQ(trigger.pulse(std::chrono::microseconds(0)).error().code, Errc::InvalidInput);
  ASSERT_TRUE(trigger.pulse(std::chrono::microseconds(5)));
  clock.advance(std::chrono::seconds(9));
  const auto pulse = trigger.wait_after(0, clock.now());
  ASSERT_TRUE(pulse);
  EXPECT_EQ(clock.now() - pulse->at, std::chrono::seconds(9));
}

TEST(FolderMedia, ComesAndGoes) {
  const TemporaryFolder folder;
  FolderMedia media;
  EXPECT_FALSE(media.current());
  EXPECT_EQ(media.flush_and_eject().error().code, Errc::MediaMissing);
  media.plug(folder.path());
  EXPECT_TRUE(media.current());
  EXPECT_TRUE(media.flush_and_eject());
  EXPECT_FALSE(media.current());
  media.plug(folder / "pulled out");
  EXPECT_FALSE(media.current());
}

TEST(FolderMedia, IsTakenUpUntilAHandPullsItOut) {
  const TemporaryFolder folder;
  const auto root = folder / "stick";
  std::filesystem::create_directory(root);
  FolderMedia media;
  const auto take_up = [&] {
    media.plug(root);
    ASSERT_TRUE(media.flush_and_eject());
    ASSERT_TRUE(media.take_up_again());
    ASSERT_TRUE(media.current());
    EXPECT_TRUE(media.is_taken_up());
  };
  take_up();
  media.unplug();
  EXPECT_FALSE(media.is_taken_up());
  take_up();
  std::filesystem::rename(root, folder / "pulled out");
  EXPECT_FALSE(media.current());
  std::filesystem::rename(folder / "pulled out", root);
  ASSERT_TRUE(media.current());
  EXPECT_FALSE(media.is_taken_up()) << "plugged by a hand";
}

TEST(FolderMedia, APipeThatLiesThereIsNotWaitedFor) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::ofstream(folder / "file") << "written";
  FolderMedia media;
  media.plug(folder.path());
  EXPECT_TRUE(media.settle(folder.path()));
  std::filesystem::create_symlink("loop", folder / "loop");
  EXPECT_EQ(media.settle(folder.path()).error().code, Errc::IoFailed);
}

TEST(SimDevice, ShowsCalibrationBoardsOneAfterAnother) {
  SimDeviceOptions options;
  options.simulation.scene = sim::SceneKind::Board;
  options.simulation.rig.width_px = 240;
  options.simulation.rig.height_px = 150;
  options.simulation.board_poses = 3;
  auto made = make_sim_device(options);
  ASSERT_TRUE(made) << made.error().what.view();
  Device& device = **made;
  for (Camera* camera : {&device.left(), &device.right()})
    ASSERT_TRUE(camera->open(device.preferred_mode()) && camera->start());
  std::vector<std::vector<std::byte>> rows;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(device.trigger().pulse(std::chrono::microseconds(100)));
    const auto left = device.left().next_frame(soon(device));
    const auto right = device.right().next_frame(soon(device));
    ASSERT_TRUE(left && right);
    const std::byte* row = left->raw().bytes + std::ptrdiff_t{75} * left->raw().stride_bytes;
    rows.emplace_back(row, row + 240);
  }
  EXPECT_NE(rows[0], rows[1]);
}

// The first picture that the left camera takes.
std::vector<std::byte> first_picture(const SimDeviceOptions& options) {
  auto made = make_sim_device(options);
  EXPECT_TRUE(made);
  Device& device = **made;
  EXPECT_TRUE(device.left().open(device.preferred_mode()) && device.left().start());
  EXPECT_TRUE(device.trigger().pulse(std::chrono::microseconds(100)));
  const auto frame = device.left().next_frame(soon(device));
  EXPECT_TRUE(frame);
  return {frame->raw().bytes, frame->raw().bytes + frame->raw().size_bytes};
}

TEST(SimDevice, KeepsAHeadInItsAlbumAndRendersItAnewWhereThatIsDamaged) {
  const TemporaryFolder folder;
  SimDeviceOptions options;
  options.simulation.rig.width_px = 240;
  options.simulation.rig.height_px = 150;
  options.album = folder.path();
  const auto rendered = first_picture(options);
  EXPECT_EQ(first_picture(options), rendered);

  const auto is_kept = std::filesystem::directory_iterator(folder.path());
  const std::filesystem::path file = is_kept->path();
  const auto size = std::filesystem::file_size(file);
  std::ofstream(file, std::ios::binary) << std::string(size, '\0');
  EXPECT_EQ(first_picture(options), std::vector<std::byte>(rendered.size())) << "the album was not asked";
  std::filesystem::resize_file(file, size - 1);
  EXPECT_EQ(first_picture(options), rendered);
  EXPECT_EQ(std::filesystem::file_size(file), size);
}

TEST(SimDevice, RefusesNonsense) {
  SimDeviceOptions options;
  options.simulation.pose.yaw_deg = 170;
  EXPECT_EQ(make_sim_device(options).error().code, Errc::InvalidInput);
  options = {};
  options.simulation.rig.width_px = 3;
  EXPECT_EQ(make_sim_device(options).error().code, Errc::InvalidInput);
  options = {};
  options.simulation.scene = sim::SceneKind::Board;
  options.simulation.board.square_mm = 200;
  EXPECT_EQ(make_sim_device(options).error().code, Errc::PoorGeometry);
}

}  // namespace
}  // namespace relievo::hal
