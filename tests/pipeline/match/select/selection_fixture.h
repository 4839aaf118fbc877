// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Selectors by name, over a small scene rendered once.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "pipeline/algorithms.h"
#include "tests/support/bump_scene.h"
#include "tests/support/names_of.h"
#include "tests/support/stage_fixture.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {

inline pipeline::KeypointSelector make_selector(const std::string& name, const Settings& settings = {}) {
  return made(&pipeline::Algorithms::selector, "selector", name, settings);
}

// The selector `file-points` needs one.
class PointFile {
 public:
  PointFile() {
    std::ofstream out(path());
    out << "x,y\n";
    for (int y = 150; y >= 2; y -= 9)
      for (int x = 3; x < 198; x += 7) out << x + 0.5 << "," << y << "\n";
  }
  std::string path() const { return (folder_.path() / "points.csv").string(); }

 private:
  TemporaryFolder folder_;
};

struct SelectionFixture : StageFixture {
  explicit SelectionFixture(int threads = 2)
      : StageFixture(std::size_t{8} << 20, std::size_t{8} << 20, threads) {}

  static const BumpScene& scene() {
    static const BumpScene scene{.width_px = 200, .height_px = 160, .bump_radius_px = 40};
    return scene;
  }
  static const pipeline::RectifiedPair& rendered() {
    static const pipeline::RectifiedPair pair = scene().render(std::pmr::get_default_resource());
    return pair;
  }
  // A plain grey left view to paint on; the right one stays plain.
  pipeline::RectifiedPair plain(float grey = 40) {
    pipeline::RectifiedPair pair(&output);
    pair = rendered();
    pair.left.grey.assign(pair.left.grey.size(), grey);
    return pair;
  }
  Result<pipeline::Keypoints> select(const pipeline::KeypointSelector& selector,
                                     const pipeline::RectifiedPair& pair) {
    return pipeline::run_stage(context, [&](pipeline::StageContext& c) { return selector(pair, c); });
  }
};

}  // namespace relievo::test
