// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eyes of simulated people, photographed, measured and laid on balls, against the people's own eyes.
#include "pipeline/mesh/eyes/eyeballs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <span>

#include "hal/sim/head/head_model.h"
#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/render.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/landmarks/landmark_finder.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "pipeline/pipeline.h"
#include "tests/support/proof.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

// A person before the rig, and the face as the mesher leaves it.
struct Sitter {
  explicit Sitter(const hal::sim::HeadTraits& traits, double scale = 0.8)
      : model(hal::sim::make_head(traits, fixture.pool)) {
    const hal::sim::SimRig rig = hal::sim::make_rig(test::small_rig(scale));
    const auto scene = hal::sim::make_head_scene(model, pose, fixture.pool);
    const auto pictures = hal::sim::render_pair(*scene, rig, {}, 1, fixture.pool);
    const auto pipeline = Pipeline::make({}, test::true_calibration(rig));
    StageContext& c = fixture.context;
    pair.emplace(*pipeline->rectify({pictures.left.view(), pictures.right.view(), 0, 0}, c));
    const auto matches = pipeline->match(*pair, c);
    const auto cloud = pipeline->reconstruct(*pair, *matches, c);
    mesh.emplace(*GridMesher({}).mesh(*cloud, c));
    head = find_head_frame(*mesh, c)->head_from_camera;
  }
  // Of a vertex before an eyeball, to that or the skin, whichever is nearer, mm; none towards the corners of
  // the eye, which flesh fills.
  std::optional<double> off(const Vec3f& v) const {
    const hal::sim::Vec3 p{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    const hal::sim::Vec3 h = pose.world_from_head().transposed() * (p - pose.origin_mm());
    for (const hal::sim::Vec3& centre : model->eye_centres)
      if (std::abs(h.x - centre.x) < 8)
        return std::min(std::abs(model->field.distance(h)),
                        std::abs(length(h - centre) - model->field.eye.radius()));
    return std::nullopt;
  }

  test::StageFixture fixture;
  hal::sim::HeadPose pose;
  std::shared_ptr<const hal::sim::HeadModel> model;
  std::optional<RectifiedPair> pair;
  std::optional<FaceMesh> mesh;
  RigidTransform head;
};

bool same_place(const Vec3f& a, const Vec3f& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

TEST(Eyeballs, LieWhereThePersonsOwnDo) {
  constexpr std::array kSeeds{4U, 7U};  // fair skin, dark skin
  for (const std::uint32_t seed : std::span(kSeeds).first(relievo::test::trials(2))) {
    Sitter s(hal::sim::traits_of(seed));
    const FaceMesh before = *s.mesh;
    lay_eyeballs(*s.mesh, s.head, *s.pair, s.fixture.context);
    ASSERT_EQ(s.mesh->vertices_mm.size(), before.vertices_mm.size());
    double then = 0, now = 0;
    int moved = 0;
    for (std::size_t v = 0; v < before.vertices_mm.size(); ++v) {
      if (same_place(before.vertices_mm[v], s.mesh->vertices_mm[v])) continue;
      EXPECT_EQ(s.mesh->measured[v], 0);
      const auto was = s.off(before.vertices_mm[v]), is = s.off(s.mesh->vertices_mm[v]);
      if (!was || !is) continue;
      ++moved;
      then += *was * *was;
      now += *is * *is;
    }
    ASSERT_GT(moved, 300) << seed;
    std::cout << "person " << seed << ": before the ball " << std::sqrt(now / moved) << " mm rms, as matched "
              << std::sqrt(then / moved) << "\n";
    EXPECT_LT(std::sqrt(now / moved), 0.4) << seed;
    EXPECT_LT(now, then) << seed;
  }
}

TEST(Eyeballs, ClosedEyesAndGreyPicturesAreLeftAlone) {
  hal::sim::HeadTraits traits = hal::sim::traits_of(4);
  traits.expression.lids_open = 0;
  Sitter closed(traits, 0.4);
  FaceMesh before = *closed.mesh;
  lay_eyeballs(*closed.mesh, closed.head, *closed.pair, closed.fixture.context);
  EXPECT_TRUE(std::equal(before.vertices_mm.begin(), before.vertices_mm.end(),
                         closed.mesh->vertices_mm.begin(), same_place));

  Sitter grey(hal::sim::traits_of(4), 0.4);
  FaceMesh open = *grey.mesh;  // so large an eye would be found, were it open and in colours
  lay_eyeballs(open, grey.head, *grey.pair, grey.fixture.context);
  EXPECT_FALSE(std::equal(open.vertices_mm.begin(), open.vertices_mm.end(), grey.mesh->vertices_mm.begin(),
                          same_place));
  for (std::size_t k = 0; k < grey.pair->left.rgb.size(); k += 3)
    grey.pair->left.rgb[k] = grey.pair->left.rgb[k + 2] = grey.pair->left.rgb[k + 1];
  before = *grey.mesh;
  lay_eyeballs(*grey.mesh, grey.head, *grey.pair, grey.fixture.context);
  EXPECT_TRUE(std::equal(before.vertices_mm.begin(), before.vertices_mm.end(), grey.mesh->vertices_mm.begin(),
                         same_place));
}

// They are as little red as the white of an eye, and wider.
TEST(Eyeballs, GreyBrowsAreNoEyes) {
  hal::sim::HeadTraits traits = hal::sim::traits_of(105060);
  traits.hair = {0.45, 0.44, 0.43};
  traits.brow_density = 2;
  Sitter s(traits, 0.4);
  const auto eyes = find_lids(*s.mesh, s.head, *s.pair, s.fixture.context);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(eyes[i]);
    const hal::sim::Vec3 centre = s.pose.world_from_head() * s.model->eye_centres[1 - i] + s.pose.origin_mm();
    const Vec3d at = apply(s.head, Vec3d{centre.x, centre.y, centre.z});
    EXPECT_NEAR((eyes[i]->inner.y + eyes[i]->outer.y) / 2, at.y, 3);
    EXPECT_NEAR((eyes[i]->inner.x + eyes[i]->outer.x) / 2, at.x, 3);
  }
}

}  // namespace
}  // namespace relievo::pipeline
