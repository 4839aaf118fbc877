// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipeline/fuse/head_fuser.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kReachMm = 3;  // a surface further off is another one ...
constexpr float kReachSigmas = 3,
                kFarthestMm = 6;        // ... unless both are that unsure: what moved between exposures
constexpr float kSameWay = 0.6F;        // cosine between the normals of what is taken for the same skin
constexpr float kCellMm = 2;            // of the grid on which the displacement is smoothed
constexpr float kNothingSaid = 0.002F;  // weight that pulls to no displacement, beyond the overlap
constexpr float kLeastSigmaMm = 0.01F;
constexpr float kSureWeight = 400;  // of a surface with a sigma of 0.05 mm: more of it is no surer
constexpr float kOwnErrorSigmas = 3;
constexpr double kSkullSays = 0.3;  // weight that pulls to no displacement where skin hangs on the skull ...
constexpr double kSkullFromMm = -50, kSkullFadesMm = 30;  // ... behind the temples: of the tip of the nose
constexpr float kMovedSigma = 0.9F;  // what is not known of a displacement, share of its usual size around

struct Field {
  Field(int w, int h, std::pmr::memory_resource* memory)
      : columns(w),
        rows(h),
        sum(std::size_t(w) * std::size_t(h), 0.0F, memory),
        weight(sum.size(), 0.0F, memory),
        square(sum.size(), 0.0F, memory) {}
  int columns, rows;
  std::pmr::vector<float> sum, weight;  // displacement times weight; weight
  std::pmr::vector<float> square;       // of the displacement, its mean around
};

// A Gaussian by three boxes (Wells 1986), along rows and columns.
void blur(std::pmr::vector<float>& plane, int columns, int rows, double sigma_cells,
          std::pmr::memory_resource* memory) {
  const int reach = std::max(1, int(std::lround((std::sqrt(4 * sigma_cells * sigma_cells + 1) - 1) / 2)));
  std::pmr::vector<float> line(std::size_t(std::max(columns, rows)), 0.0F, memory);
  const auto pass = [&](int count, std::size_t first, std::size_t stride) {
    double sum = 0;
    const auto at = [&](int i) -> float& { return plane[first + std::size_t(i) * stride]; };
    for (int i = 0; i < std::min(reach, count); ++i) sum += double(at(i));
    for (int i = 0; i < count; ++i) {
      if (i + reach < count) sum += double(at(i + reach));
      if (i - reach - 1 >= 0) sum -= double(at(i - reach - 1));
      line[std::size_t(i)] = float(sum / (2 * reach + 1));
    }
    for (int i = 0; i < count; ++i) at(i) = line[std::size_t(i)];
  };
  for (int round = 0; round < 3; ++round) {
    for (int r = 0; r < rows; ++r) pass(columns, std::size_t(r) * std::size_t(columns), 1);
    for (int c = 0; c < columns; ++c) pass(rows, std::size_t(c), std::size_t(columns));
  }
}

class Bender {
 public:
  Bender(std::span<HeadPose> poses, const Registration& registration, const HeadFuser& limits,
         bool skull_stays, StageContext& context)
      : poses_(poses),
        registration_(registration),
        limits_(limits),
        skull_stays_(skull_stays),
        context_(context) {
    fixed_[0] = 1;
    for (std::size_t k = 1; k < poses.size(); ++k) fixed_[k] = registration.poses[k].joined ? 0 : 1;
  }

  void run() {
    while (std::count(fixed_.begin(), fixed_.end(), 0) > 0 && !context_.stop()) {
      std::size_t best = 0;
      double most = -1;
      for (std::size_t k = 1; k < poses_.size(); ++k)
        if (fixed_[k] == 0)
          if (const double share = overlap(k); share > most) {
            most = share;
            best = k;
          }
      bend(best);
      fixed_[best] = 1;
    }
  }

 private:
  static constexpr int kBands = 32;
  // By how much node i of pose k lies before what is fixed, and how sure that is.
  struct Gap {
    float distance = 0, weight = 0;
  };
  Gap gap(std::size_t k, std::size_t i) const {
    const RigidTransform& placed = registration_.poses[k].first_from_pose;
    const Vec3d at = apply(placed, wide(poses_[k].nodes[i].at_mm));
    const Vec3d normal = apply(placed.rotation, wide(poses_[k].nodes[i].normal));
    Gap sum;
    for (std::size_t j = 0; j < poses_.size(); ++j) {
      if (fixed_[j] == 0) continue;
      const auto hit = look(poses_[j], registration_.poses[j].first_from_pose, at);
      if (!hit || dot(hit->normal, normal) < double(kSameWay)) continue;
      const float d = float(hit->before_mm), sigma = hit->own.sigma_mm;
      const float unsure_mm = kReachSigmas * std::hypot(sigma, poses_[k].nodes[i].sigma_mm);
      if (std::abs(d) > std::clamp(unsure_mm, kReachMm, kFarthestMm)) continue;
      const float w = hit->own.trust / (sigma * sigma + kLeastSigmaMm * kLeastSigmaMm);
      sum.distance += w * d;
      sum.weight += w;
    }
    if (sum.weight > 0) sum.distance /= sum.weight;
    return sum;
  }

  double overlap(std::size_t k) const {
    constexpr std::size_t kEvery = 37;
    double met = 0;
    for (std::size_t i = 0; i < poses_[k].nodes.size(); i += kEvery)
      if (poses_[k].nodes[i].trust > 0 && gap(k, i).weight > 0) met += 1;
    return met;
  }

  void bend(std::size_t k) {
    HeadPose& pose = poses_[k];
    const Arena::Mark mark(context_.scratch);
    const float node_mm = float(pose.step_px / pose.focal_px * distance_of(pose));
    const int every = std::max(1, int(std::lround(kCellMm / node_mm)));
    Field field((pose.columns + every - 1) / every + 1, (pose.rows + every - 1) / every + 1,
                &context_.scratch);
    // By whole rows of cells: no two threads add to one.
    const auto for_each_node = [&](const auto& work) {
      context_.pool.for_each_band(field.rows, kBands, [&](int begin, int end, int) {
        for (int r = begin * every; r < std::min(end * every, pose.rows); ++r)
          for (int c = 0; c < pose.columns; ++c)
            work(r, c, std::size_t(r) * std::size_t(pose.columns) + std::size_t(c));
      });
    };
    for_each_node([&](int r, int c, std::size_t i) {
      if (pose.nodes[i].trust <= 0 || (r + c) % 2 != 0) return;
      const std::size_t cell = std::size_t(r / every) * std::size_t(field.columns) + std::size_t(c / every);
      const Gap g = gap(k, i);
      if (g.weight <= 0 && !skull_stays_) return;
      if (g.weight <= 0) {
        const Vec3d at = apply(registration_.poses[k].first_from_pose, wide(pose.nodes[i].at_mm));
        const double z = apply(poses_[0].head_from_camera, at).z;
        field.weight[cell] += pose.nodes[i].trust *
                              float(kSkullSays * std::clamp((kSkullFromMm - z) / kSkullFadesMm, 0.0, 1.0));
        return;
      }
      const float w = pose.nodes[i].trust * std::min(1.0F, g.weight / kSureWeight);
      field.sum[cell] += w * g.distance;
      field.weight[cell] += w;
    });
    const double sigma_cells = limits_.bend_width_mm / (double(every) * double(node_mm));
    blur(field.sum, field.columns, field.rows, sigma_cells, &context_.scratch);
    blur(field.weight, field.columns, field.rows, sigma_cells, &context_.scratch);
    usual_square(field, sigma_cells);
    const float still = float(limits_.still_mm), most = float(limits_.most_bend_mm);
    for_each_node([&](int r, int c, std::size_t i) {
      if (pose.nodes[i].trust <= 0) return;
      const float d =
          read(field, (float(c) + 0.5F) / float(every) - 0.5F, (float(r) + 0.5F) / float(every) - 0.5F);
      const float moved = d * d * d / (d * d + still * still);
      // What is measured badly may lie further off without having moved.
      if (std::abs(moved) > most + kOwnErrorSigmas * pose.nodes[i].sigma_mm) {
        pose.nodes[i].trust = 0;
        return;
      }
      pose.nodes[i].at_mm = along(pose.nodes[i].at_mm, -moved, pose.nodes[i].normal);
      pose.nodes[i].sigma_mm = std::hypot(
          pose.nodes[i].sigma_mm,
          kMovedSigma * std::sqrt(field.square[std::size_t(r / every) * std::size_t(field.columns) +
                                               std::size_t(c / every)]));
    });
  }

  // Where nothing overlaps, the mean over all that does.
  void usual_square(Field& field, double sigma_cells) const {
    double sum = 0, weight = 1e-9;
    for (std::size_t k = 0; k < field.sum.size(); ++k) {
      const float w = field.weight[k], d = field.sum[k] / (w + kNothingSaid);
      field.square[k] = w * d * d;
      sum += double(field.square[k]);
      weight += double(w);
    }
    std::pmr::vector<float> around(field.weight, &context_.scratch);
    blur(field.square, field.columns, field.rows, sigma_cells, &context_.scratch);
    blur(around, field.columns, field.rows, sigma_cells, &context_.scratch);
    const float all = float(sum / weight);
    for (std::size_t k = 0; k < field.square.size(); ++k)
      field.square[k] = (field.square[k] + kNothingSaid * all) / (around[k] + kNothingSaid);
  }

  static double distance_of(const HeadPose& pose) {
    double sum = 0, count = 1e-9;
    for (std::size_t i = 0; i < pose.nodes.size(); i += 101)
      if (pose.nodes[i].trust > 0) {
        sum += double(pose.nodes[i].at_mm.z);
        count += 1;
      }
    return sum / count;
  }

  static float read(const Field& f, float x, float y) {
    x = std::clamp(x, 0.0F, float(f.columns - 1) - 1e-3F);
    y = std::clamp(y, 0.0F, float(f.rows - 1) - 1e-3F);
    const std::size_t k = std::size_t(y) * std::size_t(f.columns) + std::size_t(x);
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    float sum = 0, weight = kNothingSaid;
    for (std::size_t i = 0; i < 4; ++i) {
      const float share = (i % 2 == 0 ? 1 - fx : fx) * (i < 2 ? 1 - fy : fy);
      const std::size_t cell = k + i % 2 + (i / 2) * std::size_t(f.columns);
      sum += share * f.sum[cell];
      weight += share * f.weight[cell];
    }
    return sum / weight;
  }

  std::span<HeadPose> poses_;
  const Registration& registration_;
  const HeadFuser& limits_;
  bool skull_stays_;
  StageContext& context_;
  std::pmr::vector<std::uint8_t> fixed_{poses_.size(), 0, &context_.scratch};
};

}  // namespace

void bend_to_master(std::span<HeadPose> poses, const Registration& registration, const HeadFuser& limits,
                    bool skull_stays, StageContext& context) {
  Bender(poses, registration, limits, skull_stays, context).run();
}

}  // namespace relievo::pipeline
