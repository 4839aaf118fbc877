// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A head from several pairs by command, as a newcomer would try it.
#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

class HeadByCommand : public RelievoProcess {};

TEST_F(HeadByCommand, IsMadeOfSeveralPairsAndSaysHowTheyStand) {
  for (const std::string yaw : {"0", "-25", "25"})
    simulated({"face", "--seed", "3", "--scale", "0.6", "--yaw", yaw}, "y" + yaw);
  const std::vector<std::string> call{"reconstruct",    "y0/left.png",  "y0/right.png",  "y-25/left.png",
                                      "y-25/right.png", "y25/left.png", "y25/right.png", "--calibration",
                                      "y0/rig.yml",     "-o",           "head"};
  const std::string said = done(call).out;
  EXPECT_NE(said.find("Pair 2"), std::string::npos) << said;
  EXPECT_NE(said.find("Pair 3"), std::string::npos) << said;
  EXPECT_NE(read_text(here / "head/model.ply").substr(0, 2000).find("property uchar pose"),
            std::string::npos);
  const auto report = nlohmann::json::parse(read_text(here / "head/report.json"));
  ASSERT_EQ(report["poses"].size(), 3U);
  EXPECT_EQ(report["poses"][0]["turned_deg"], 0);
  for (const std::size_t k : {1U, 2U}) {
    EXPECT_NEAR(report["poses"][k]["turned_deg"].get<double>(), 25, 0.5);
    // About the upright axis: the middle row of the rotation stays.
    EXPECT_NEAR(report["poses"][k]["rotation"][4].get<double>(), 1, 1e-3);
  }

  // A calibration each does the same; two for three pairs are refused before anything is read.
  auto each = call;
  each.push_back("--watertight");
  each.insert(each.begin() + 9, {"y-25/rig.yml", "y25/rig.yml"});
  each[each.size() - 2] = "each";
  EXPECT_NE(done(each).out.find("solid: "), std::string::npos);
  EXPECT_EQ(read_text(here / "each/model.ply"), read_text(here / "head/model.ply"));

  // The solid beside it, as a printer reads it: every edge is run once in each direction.
  const std::string stl = read_text(here / "each/solid.stl");
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, int> edges;
  ASSERT_GT(stl.size(), 84U + 50U * 100'000U);
  for (std::size_t at = 84; at + 50 <= stl.size(); at += 50) {
    std::array<Place, 3> corner;
    std::memcpy(corner.data(), stl.data() + at + 12, sizeof corner);
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{corner[k], corner[(k + 1) % 3]}];
      --edges[{corner[(k + 1) % 3], corner[k]}];
    }
  }
  EXPECT_TRUE(std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; }));

  // What is no head's picture is named.
  auto wrong = call;
  wrong[5] = "y25/right.png", wrong[6] = "y25/left.png";
  wrong.back() = "wrong";
  const Said refused = relievo(wrong);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("y25/right.png"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(here / "wrong"));
}

}  // namespace
}  // namespace relievo::test
