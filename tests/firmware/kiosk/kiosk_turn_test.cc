// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A visitor of the simulated rig who turns the head after the frontal picture, does not, or leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "firmware/service/export_records.h"
#include "hal/base/whole_file.h"
#include "hal/clock.h"
#include "hal/picture_file.h"
#include "hal/recording/capture_file.h"
#include "hal/sim/device.h"
#include "hal/sim/replay/replay_device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/model/vector3.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/firmware/kiosk/kiosk_hands.h"
#include "tests/support/small_rig.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

class KioskTurn : public KioskHands {
 protected:
  KioskTurn() {
    auto lent = test::small_device(0.3);  // small: turned heads are rendered while it waits
    lent.simulation.seed = 4;
    lend_small_rig(services, args, folder.path(), clock, lent);
    services.turn_head = [this](hal::Device& device, double yaw_deg) {
      if (turns) hal::turn_simulated_head(device, yaw_deg);
      if (yaw_deg != 0 && std::ranges::find(asked, yaw_deg) == asked.end()) asked.push_back(yaw_deg);
    };
    open(args, services);
  }
  void to_turn() {
    const auto played =
        play("wait attract\ntap start\ntap agree\ntype Ada\ntap done\nwait position\nwait turn 600\n");
    ASSERT_TRUE(played) << played.error().where();
  }
  // Which pairs measured the head that is shown; empty: it is a face of one pair.
  std::set<int> poses() const {
    const auto& pose = kiosk->view().model->mesh.pose;
    return {pose.begin(), pose.end()};
  }

  // Where, across the head, what a pair measured lies in the mean.
  std::vector<double> middles_mm() const {
    const pipeline::FaceModel& model = *kiosk->view().model;
    std::map<int, std::pair<double, double>> sums;
    for (std::size_t v = 0; v < model.mesh.vertices_mm.size(); ++v) {
      if (model.mesh.measured[v] == 0) continue;
      const auto& at = model.mesh.vertices_mm[v];
      auto& [sum, count] = sums[model.mesh.pose[v]];
      sum += apply(model.head_from_camera, pipeline::Vec3d{double(at.x), double(at.y), double(at.z)}).x,
          ++count;
    }
    std::vector<double> middles;
    for (const auto& [pose, of] : sums) middles.push_back(of.first / of.second);
    return middles;
  }

  test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  KioskArgs args;
  bool turns = true;
  std::vector<double> asked;  // each once, in turn
};

TEST_F(KioskTurn, WhoTurnsTheHeadSeesAllOfIt) {
  to_turn();
  EXPECT_TRUE(says("I cannot turn my head"));
  std::string told;  // what the page said, where it changed
  ASSERT_TRUE(until([&] {
    if (const auto& turn = kiosk->view().live.turn) {
      const std::string now = std::to_string(static_cast<int>(turn->advice)) + "@" +
                              std::to_string(std::lround(turn->yaw_deg)) + "/" +
                              std::to_string(turn->taken.count()) + " ";
      if (!told.ends_with(now)) told += now;
    }
    return kiosk->ui().visit().step == ui::Step::Review;
  }));
  kiosk->turn();
  ASSERT_NE(kiosk->view().model, nullptr);
  std::string made;
  for (const StageRecord& record : kiosk->appliance().records()) made += std::string(record.name) + " ";
  ASSERT_EQ(made, "Match Reconstruct Mesh Texture Assemble Pose Pose Pose Pose Pose Fuse ") << told;
  EXPECT_EQ(poses(), (std::set<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(std::set<double>(asked.begin(), asked.end()), (std::set<double>{-45, -25, 25, 45}));
  // Who turns to the picture's right shows the right half of the head, where x is below zero.
  const auto middles = middles_mm();
  ASSERT_EQ(middles.size(), asked.size() + 1);
  for (std::size_t p = 1; p < middles.size(); ++p)
    EXPECT_LT(middles[p] * asked[p - 1], -500) << "pair " << p << " lies at " << middles[p] << " mm";
  tap("accept");
  ASSERT_TRUE(reach(ui::Step::Thanks));
  kiosk.reset();

  // What is stored is exported whole: which pair measured what, and on request a solid.
  auto store = storage::open_sqlite_store(args.store, clock, {});
  ASSERT_TRUE(store);
  const auto subjects = (*store)->subjects({});
  ASSERT_EQ(subjects->size(), 1U);
  hal::FolderMedia stick;
  std::filesystem::create_directories(folder.path() / "stick");
  stick.plug(folder.path() / "stick");
  const std::atomic<bool> cancelled{false};
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  ExportTrace trace;
  const auto exported =
      export_records(**store, clock, stick, {subjects->front().id}, {.watertight = true}, control, trace);
  ASSERT_TRUE(exported) << exported.error().what.view();
  const Path record = std::filesystem::directory_iterator(folder.path() / "stick/relievo")->path();
  const auto bytes = read_whole_file(record / "model.ply", std::size_t{1} << 28);
  ASSERT_TRUE(bytes);
  const std::string_view ply(reinterpret_cast<const char*>(bytes->data()), 4000);
  EXPECT_NE(ply.find("property uchar pose"), std::string_view::npos);
  EXPECT_GT(std::filesystem::file_size(record / "solid.stl"), 1'000'000U);
}

// Its sides lie in another order than the kiosk asks for them, and one is none.
TEST_F(KioskTurn, ARecordedHeadIsMadeFromAllItsSides) {
  const auto made = folder.path() / "visit", head = folder.path() / "head";
  hal::sim::SimulationOptions simulation;
  simulation.scene = hal::sim::SceneKind::Visit;
  simulation.seed = 4;
  simulation.drift = 0;
  simulation.rig = test::small_rig(0.3);
  ASSERT_TRUE(hal::sim::render_to_folder(simulation, made));
  for (const int pair : {0, 5, 2, 3, 4, 1}) {  // in front, nods, 25, -45, 45, -25
    const auto from = made / std::to_string(pair);
    const auto left = hal::read_picture(from / "left.png"), right = hal::read_picture(from / "right.png");
    ASSERT_TRUE(left && right);
    hal::RecordedPair recorded{left->view(), right->view(), 0, 0, 4000, 1, "", ""};
    recorded.of_head = true;
    ASSERT_TRUE(hal::record_pair(head, recorded));
  }
  kiosk.reset();
  services.open_device = [&](std::string_view) { return hal::make_folder_device(head); };
  args.device = "folder:" + head.string();
  args.calibration = made / "rig.yml";
  open(args, services);
  to_turn();
  ASSERT_TRUE(reach(ui::Step::Review));
  kiosk->turn();
  ASSERT_NE(kiosk->view().model, nullptr);
  EXPECT_EQ(poses(), (std::set<int>{0, 1, 2, 3, 4}));
}

TEST_F(KioskTurn, WhoCannotHasTheFaceOfOnePicture) {
  turns = false;
  to_turn();
  tap("enough");
  const auto reviewed = play("wait review 600\n");
  ASSERT_TRUE(reviewed) << reviewed.error().where();
  kiosk->turn();
  ASSERT_NE(kiosk->view().model, nullptr);
  EXPECT_TRUE(poses().empty());
  for (const ui::Picture& stage : kiosk->view().stages) EXPECT_FALSE(stage.pixels.empty());
}

TEST_F(KioskTurn, WhoLeavesLeavesNothing) {
  turns = false;
  to_turn();
  ASSERT_TRUE(until([this] { return kiosk->view().live.turn.has_value(); }));
  tap("help");
  EXPECT_TRUE(says("Pictures from the sides"));
  tap("close");
  tap("leave");
  tap("answer_quiet");
  ASSERT_TRUE(reach(ui::Step::Attract));
  EXPECT_EQ(kiosk->appliance().state(), State::Idle);
  EXPECT_FALSE(kiosk->appliance().session().is_open());
}

}  // namespace
}  // namespace relievo::firmware
