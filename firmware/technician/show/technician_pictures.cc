// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/technician_pictures.h"

#include <string.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "firmware/base/budget.h"
#include "firmware/checks/deviation_picture.h"
#include "firmware/compare/page/maps.h"
#include "firmware/measure/comparison.h"
#include "firmware/work/stage_drawing.h"
#include "hal/base/assert.h"
#include "hal/base/statistics.h"

namespace relievo::firmware {
namespace {

constexpr float kLeastFullColourMm = 0.5F, kLeastFullResidualMm = 0.1F;

using ui::TechnicianStage;
constexpr std::size_t kBytes = budget::kTechnicianPictureBytes;
constexpr std::array kWithRight{TechnicianStage::Input, TechnicianStage::Processed,
                                TechnicianStage::Rectified, TechnicianStage::Mesh, TechnicianStage::Poses};
// The plan counts the same pictures: of the newest result, and the left ones of what is put aside.
static_assert(budget::kTechnicianBytes ==
              (ui::kTechnicianStages + kWithRight.size() + ui::kTechnicianStages * budget::kKeptResults) *
                      kBytes +
                  budget::kKeptResults * budget::kKeptModelBytes);

// No two pictures have the same number: a renderer tells by it what it has to load.
std::uint32_t next_version() {
  static std::atomic<std::uint32_t> count{0};
  return ++count;
}

// Means over the pixels that fall into one; at(x, y, channel).
template <typename At>
void shrink(int width_px, int height_px, int to_width_px, int to_height_px, std::uint8_t* rgb, At&& at) {
  for (int y = 0; y < to_height_px; ++y) {
    const int v0 = y * height_px / to_height_px, v1 = std::max(v0 + 1, (y + 1) * height_px / to_height_px);
    for (int x = 0; x < to_width_px; ++x, rgb += 3) {
      const int u0 = x * width_px / to_width_px, u1 = std::max(u0 + 1, (x + 1) * width_px / to_width_px);
      float sum[3] = {0, 0, 0};
      for (int v = v0; v < v1; ++v) {
        for (int u = u0; u < u1; ++u) {
          for (int c = 0; c < 3; ++c) sum[c] += at(u, v, c);
        }
      }
      const float share = 1.0F / float((u1 - u0) * (v1 - v0));
      for (int c = 0; c < 3; ++c) rgb[c] = std::uint8_t(std::clamp(sum[c] * share, 0.0F, 255.0F));
    }
  }
}

}  // namespace

void HandChange::before(const pipeline::AlgorithmSet& set, const pipeline::RectifiedPair& pair,
                        const pipeline::FaceMesh& mesh) {
  before_ = depths_of(pair, mesh);
  set_ = set.to_text();
}

void HandChange::measure(const Making& making, const Products& products) {
  figures_ = {};
  now_ = {};
  if (!products.pair || !products.model) return;
  const pipeline::RectifiedPair& pair = *products.pair;
  if (making.by_hand.empty()) return before(making.set, pair, products.model->mesh);
  if (!has_before(making.set)) return;
  now_ = depths_of(pair, products.model->mesh);
  if (before_.values.size() != now_.values.size()) return;
  figures_.known = true;
  const auto focal = float(pair.focal_px);
  for (int y = 0; y < now_.height_px; ++y)
    for (int x = 0; x < now_.width_px; ++x) {
      if (!now_.known(x, y)) continue;
      const float pixel_mm = now_.at(x, y) / focal, nearer = nearer_mm(x, y);
      if (!before_.known(x, y)) figures_.new_mm2 += pixel_mm * pixel_mm;
      if (!(std::abs(nearer) > ui::kMovedMm)) continue;
      figures_.moved_mm2 += pixel_mm * pixel_mm;
      if (std::abs(nearer) > std::abs(figures_.farthest_mm)) figures_.farthest_mm = nearer;
    }
  figures_.full_colour_mm = std::max(kLeastFullColourMm, std::abs(figures_.farthest_mm));
}

float HandChange::nearer_mm(int x, int y) const {
  const bool both = figures_.known && now_.holds(x, y) && now_.known(x, y) && before_.known(x, y);
  return both ? before_.at(x, y) - now_.at(x, y) : std::numeric_limits<float>::quiet_NaN();
}

void HandChange::tell(std::span<ui::TechnicianPoint> points) const {
  if (!figures_.known) return;
  for (ui::TechnicianPoint& point : points) {
    const int x = int(std::lround(point.left_px.x)), y = int(std::lround(point.left_px.y));
    point.moved_mm = nearer_mm(x, y);
    point.new_surface = now_.holds(x, y) && now_.known(x, y) && !before_.known(x, y);
  }
}

TechnicianPictures::TechnicianPictures(bool right_too)
    : block_((ui::kTechnicianStages + (right_too ? kWithRight.size() : 0)) * kBytes) {
  auto* place = reinterpret_cast<std::uint8_t*>(block_.bytes().data());
  for (auto& stage : all_) stage[0].rgb = std::exchange(place, place + kBytes);
  if (!right_too) return;
  for (const TechnicianStage stage : kWithRight)
    all_[std::size_t(stage)][1].rgb = std::exchange(place, place + kBytes);
}

TechnicianPictures::One& TechnicianPictures::begin(TechnicianStage stage, std::size_t side, int width_px,
                                                   int height_px) {
  One& one = all_[std::size_t(stage)][side];
  RELIEVO_ASSERT(one.rgb != nullptr);  // a right one: kWithRight names its stage
  const double scale = std::min(1.0, double(kSide) / std::max(width_px, height_px));
  one.width_px = std::max(1, int(width_px * scale));
  one.height_px = std::max(1, int(height_px * scale));
  one.version = next_version();
  return one;
}

void TechnicianPictures::draw_input(const ImageView& view, std::size_t side) {
  One& one = begin(TechnicianStage::Input, side, view.width_px, view.height_px);
  const auto value = [&](int x, int y, int c) {
    return float(colour_of(view.row(y), x, view.format)[std::size_t(c)]);
  };
  shrink(view.width_px, view.height_px, one.width_px, one.height_px, one.rgb, value);
}

void TechnicianPictures::draw_pair(TechnicianStage stage, const pipeline::RectifiedPair& pair, bool colour) {
  for (std::size_t side = 0; side < 2; ++side) {
    const pipeline::RectifiedView& view = side == 0 ? pair.left : pair.right;
    One& one = begin(stage, side, pair.width_px, pair.height_px);
    const bool rgb = colour && view.rgb.size() == 3 * view.grey.size();
    const auto value = [&](int x, int y, int c) {
      const std::size_t i = std::size_t(y) * std::size_t(pair.width_px) + std::size_t(x);
      return rgb ? float(view.rgb[3 * i + std::size_t(c)]) : view.grey[i];
    };
    shrink(pair.width_px, pair.height_px, one.width_px, one.height_px, one.rgb, value);
  }
}

void TechnicianPictures::draw_rules(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches) {
  StageCanvas canvas(begin(TechnicianStage::Matches, 0).rgb, kSide);
  draw_photograph(pair, 1, canvas);
  const std::vector<std::uint8_t> rejected = compare::rejected_map(matches, pair.width_px, pair.height_px);
  paint(pair, canvas, [&](int x, int y) -> std::optional<compare::Rgb> {
    const std::uint8_t rule = rejected[std::size_t(y) * std::size_t(pair.width_px) + std::size_t(x)];
    if (rule == 0) return std::nullopt;
    return compare::rule_colour(rule - 1U);
  });
}

void TechnicianPictures::draw_disparity(const pipeline::RectifiedPair& pair,
                                        const pipeline::MatchSet& matches) {
  constexpr int kScatteredPx = 7;
  StageCanvas canvas(begin(TechnicianStage::Disparity, 0).rgb, kSide);
  compare::DisparityMap map = compare::disparity_map(matches, pair.width_px, pair.height_px);
  if (matches.lattice_step_px == 0) map = compare::thickened(map, kScatteredPx);
  const compare::Reach reach = compare::reach_of(map);
  paint(pair, canvas, [&](int x, int y) -> std::optional<compare::Rgb> {
    if (!map.known(x, y)) return std::nullopt;
    return compare::depth_colour((double(map.at(x, y)) - reach.least_px) / (reach.most_px - reach.least_px));
  });
}

void TechnicianPictures::draw_shapes(const Products& products) {
  const pipeline::RectifiedPair& pair = *products.pair;
  if (products.cloud) {
    StageCanvas canvas(begin(TechnicianStage::Cloud, 0).rgb, kSide);
    draw_cloud(pair, *products.cloud, canvas);
  }
  const pipeline::FaceMesh* mesh = products.model  ? &products.model->mesh
                                   : products.mesh ? &*products.mesh
                                                   : nullptr;
  if (mesh != nullptr) {
    StageCanvas canvas(begin(TechnicianStage::Mesh, 0).rgb, kSide);
    draw_surface(pair, *mesh, nullptr, canvas);
  }
  if (products.model) {
    StageCanvas canvas(begin(TechnicianStage::Texture, 0).rgb, kSide);
    draw_surface(pair, products.model->mesh, &products.model->texture, canvas);
  }
}

void TechnicianPictures::draw(const Products& products, const HandChange& change) {
  wipe();
  if (products.frame) {
    draw_input(products.frame->left, 0);
    draw_input(products.frame->right, 1);
  }
  if (!products.pair) return;
  draw_pair(TechnicianStage::Rectified, *products.pair, true);
  draw_pair(TechnicianStage::Processed, *products.pair, false);  // as the matcher was given it
  if (products.matches) {
    draw_rules(*products.pair, *products.matches);
    draw_disparity(*products.pair, *products.matches);
  }
  draw_shapes(products);
  if (!change.figures().known) return;
  StageCanvas canvas(begin(TechnicianStage::Mesh, 1).rgb, kSide);
  draw_nearer(
      *products.pair, [&change](int x, int y) { return change.nearer_mm(x, y); },
      change.figures().full_colour_mm, canvas);
}

float full_residual_mm(const pipeline::Registration& registration) {
  float most = kLeastFullResidualMm;
  for (const pipeline::RegisteredPose& pose : registration.poses)
    for (const pipeline::PoseMeeting& with : pose.meets) most = std::max(most, float(with.p95_mm));
  return most;
}

void TechnicianPictures::draw_poses(const Products& products, std::span<const pipeline::HeadPose> poses) {
  if (!products.registration || poses.empty()) return;
  const float full_mm = full_residual_mm(*products.registration);
  StageCanvas photographs(begin(TechnicianStage::Poses, 0).rgb, kSide);
  StageCanvas residuals(begin(TechnicianStage::Poses, 1).rgb, kSide);
  const int across = int(std::ceil(std::sqrt(double(poses.size()))));
  const int cell = kSide / across;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const pipeline::HeadPose& pose = poses[k];
    const pipeline::ResidualMap& map = products.registration->residuals[k];
    const int left = int(k) % across * cell, top = int(k) / across * cell;
    // What was measured of it, in the middle of its cell.
    const double nodes = double(std::max(pose.columns, pose.rows)) / cell;
    for (int y = 0; y < cell; ++y)
      for (int x = 0; x < cell; ++x) {
        const double column = pose.columns / 2.0 + (x - cell / 2.0) * nodes,
                     row = pose.rows / 2.0 + (y - cell / 2.0) * nodes;
        const int u = int(pose.first_px.x + column * pose.step_px),
                  v = int(pose.first_px.y + row * pose.step_px);
        if (u < 0 || v < 0 || u >= pose.width_px || v >= pose.height_px) continue;
        const std::uint8_t* rgb =
            &pose.left_rgb[3 * (std::size_t(v) * std::size_t(pose.width_px) + std::size_t(u))];
        photographs.put(left + x, top + y, {1.0 * rgb[0], 1.0 * rgb[1], 1.0 * rgb[2]});
        residuals.put(left + x, top + y, {0.5 * rgb[0], 0.5 * rgb[1], 0.5 * rgb[2]});
        if (column < 0 || row < 0 || column >= pose.columns || row >= pose.rows) continue;
        const float mm = map.mm[std::size_t(row / pipeline::kResidualEvery) * std::size_t(map.columns) +
                                std::size_t(column / pipeline::kResidualEvery)];
        if (std::isnan(mm)) continue;
        const auto c = deviation_colour(double(mm / full_mm));
        residuals.put(left + x, top + y, {1.0 * c[0], 1.0 * c[1], 1.0 * c[2]});
      }
  }
}

ui::Picture TechnicianPictures::picture(TechnicianStage stage, std::size_t side) const {
  const One& one = all_[std::size_t(stage)][side];
  if (one.version == 0) return {};
  return {{reinterpret_cast<const std::byte*>(one.rgb), one.width_px, one.height_px, 3 * one.width_px,
           PixelFormat::Rgb8},
          one.version};
}

void TechnicianPictures::copy_from(const TechnicianPictures& other) {
  wipe();
  for (std::size_t stage = 0; stage < all_.size(); ++stage) {
    const One& from = other.all_[stage][0];
    if (from.version == 0) continue;
    One& to = all_[stage][0];
    to.width_px = from.width_px;
    to.height_px = from.height_px;
    to.version = next_version();
    std::memcpy(to.rgb, from.rgb, std::size_t{3} * std::size_t(from.width_px) * std::size_t(from.height_px));
  }
}

void TechnicianPictures::wipe() {
  for (auto& stage : all_) {
    for (One& one : stage) {
      if (one.version != 0) explicit_bzero(one.rgb, kBytes);
      one.version = 0;
    }
  }
}

namespace {

constexpr int kSide = budget::kTechnicianPictureSidePx;
constexpr int kColours = 256;  // of the texture: the first is of what is not known, the second like the third

float texel_of(float share) {
  const float at =
      std::isnan(share) ? 0 : 2 + std::round((kColours - 3) * (std::clamp(share, -1.0F, 1.0F) + 1) / 2);
  return (at + 0.5F) / kColours;
}

}  // namespace

compare::DisparityMap depths_of(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh) {
  compare::DisparityMap map = compare::model_view(pair, mesh);
  for (float& d : map.values)
    if (!std::isnan(d)) d = float(pair.depth_mm(double(d)));
  return map;
}

void draw_nearer(const pipeline::RectifiedPair& pair, const std::function<float(int x, int y)>& nearer_mm,
                 float full_colour_mm, StageCanvas& canvas) {
  draw_photograph(pair, 0.5, canvas);
  paint(pair, canvas, [&](int x, int y) -> std::optional<std::array<std::uint8_t, 3>> {
    const float nearer = nearer_mm(x, y);
    if (std::isnan(nearer)) return std::nullopt;
    return deviation_colour(double(nearer / full_colour_mm));
  });
}

std::span<const std::array<std::uint8_t, 3>> difference_scale() {
  static const auto kScale = [] {
    std::array<std::array<std::uint8_t, 3>, 21> scale;
    for (std::size_t i = 0; i < scale.size(); ++i)
      scale[i] = deviation_colour(2 * double(i) / (scale.size() - 1) - 1);
    return scale;
  }();
  return kScale;
}

void SurfaceDifference::measure(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& surface,
                                const compare::DisparityMap& other, std::uint32_t number) {
  forget();
  nearer_ = depths_of(pair, surface);
  if (nearer_.values.size() != other.values.size()) return forget();
  std::vector<float> known;
  for (std::size_t i = 0; i < nearer_.values.size(); ++i) {
    nearer_.values[i] = other.values[i] - nearer_.values[i];
    if (!std::isnan(nearer_.values[i])) known.push_back(nearer_.values[i]);
  }
  if (known.empty()) return;
  figures_.known = true;
  figures_.number = number;
  figures_.median_mm = float(percentile(known, 0.5));
  for (float& d : known) d = std::abs(d);
  figures_.most_mm = float(percentile(known, 0.95));
}

void SurfaceDifference::draw(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& surface,
                             float full_colour_mm) {
  rgb_.assign(std::size_t{3} * kSide * kSide, 0);
  StageCanvas canvas(rgb_.data(), kSide);
  draw_nearer(
      pair, [this](int x, int y) { return nearer_mm(x, y); }, full_colour_mm, canvas);
  figures_.map = {
      {reinterpret_cast<const std::byte*>(rgb_.data()), kSide, kSide, 3 * kSide, PixelFormat::Rgb8},
      figures_.number};
  colours_.width_px = kColours, colours_.height_px = 1;
  colours_.rgb.assign(std::size_t{3} * kColours, 128);
  for (int i = 1; i < kColours; ++i)
    std::ranges::copy(deviation_colour(2.0 * (std::max(i, 2) - 2) / (kColours - 3) - 1),
                      colours_.rgb.begin() + 3 * i);
  std::vector<float> share(surface.vertices_mm.size());
  for (std::size_t i = 0; i < share.size(); ++i) {
    const auto& v = surface.vertices_mm[i];
    const auto p = apply(pair.rectified_from_left, pipeline::Vec3d{v.x, v.y, v.z});
    share[i] = nearer_mm(int(std::lround(pair.left_centre_px.x + pair.focal_px * p.x / p.z)),
                         int(std::lround(pair.left_centre_px.y + pair.focal_px * p.y / p.z))) /
               full_colour_mm;
  }
  // Between a known and an unknown corner lies no colour of the scale.
  colours_.uv.clear();
  for (const auto& t : surface.triangles) {
    const float sum = share[t[0]] + share[t[1]] + share[t[2]];
    for (const std::uint32_t at : t)
      colours_.uv.push_back({texel_of(std::isnan(sum) ? sum : share[at]), 0.5F});
  }
}

ui::TechnicianDifference SurfaceDifference::view() const {
  ui::TechnicianDifference view = figures_;
  view.colours = colours_.uv.empty() ? nullptr : &colours_;
  return view;
}

}  // namespace relievo::firmware
