// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/pose_registration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hal/base/statistics.h"
#include "pipeline/fuse/pose_residuals.h"

namespace relievo::pipeline {
namespace {

using Square =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6 * (kMostPoses - 1), 6 * (kMostPoses - 1)>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6 * (kMostPoses - 1), 1>;

constexpr std::size_t kParts = PoseResiduals::kParts;
constexpr double kFewestSamples = 300;
constexpr double kMostMovedMm = 1.5;
constexpr double kRidge = 1e-9;
constexpr double kStillMm = 1e-5;
constexpr std::array<RegistrationRound, 5> kRounds{
    {{12, 6, 8, kFewSamples}, {6, 2, 6, kFewSamples}, {3, 0.7, 6}, {2, 0.25, 8}, {1.5, 0.12, 8}}};
constexpr RegistrationRound kLast{1.5, 0.08, 12};

Vec3d vector(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
Eigen::Index place(std::size_t pose) { return 6 * (static_cast<Eigen::Index>(pose) - 1); }

// All poses at once, each against each.
class JointSolver {
 public:
  JointSolver(std::span<RegisteredPose> placed, PoseResiduals& residuals, StageContext& context)
      : placed_(placed), residuals_(residuals), context_(context), unknowns_(place(placed.size())) {}

  Result<void> run() {
    for (const RegistrationRound& round : kRounds)
      for (int k = 0; k < round.times && move(round) > kStillMm; ++k)
        if (context_.stop()) return registration_stopped();
    residuals_.skin().watch();
    for (int k = 0; k < kLast.times; ++k) {
      weigh_skin();
      if (context_.stop()) return registration_stopped();
      if (move(kLast) <= kStillMm) break;
    }
    return measure();
  }

 private:
  // One Gauss-Newton step; returns how far it went, millimetres and radians together.
  double move(const RegistrationRound& round) {
    struct Part {
      Square normal;
      Column right;
      std::vector<float> off;
    };
    std::vector<Part> parts(placed_.size() * kParts);
    residuals_.for_each_part(parts.size(), [&](std::size_t i) {
      Part& part = parts[i];
      part.normal = Square::Zero(unknowns_, unknowns_);
      part.right = Column::Zero(unknowns_);
      residuals_.for_each_residual_of(i / kParts, i % kParts, kParts, round,
                                      [&](std::size_t a, std::size_t b, const PoseResidual& r) {
                                        add(part.normal, part.right, a, b, r);
                                        part.off.push_back(static_cast<float>(std::abs(r.value)));
                                      });
    });
    Square normal = kRidge * Square::Identity(unknowns_, unknowns_);
    Column right = Column::Zero(unknowns_);
    std::vector<float> off;
    for (const Part& part : parts) {
      normal += part.normal;
      right += part.right;
      off.insert(off.end(), part.off.begin(), part.off.end());
    }
    residuals_.set_usual_mm(off.empty() ? 0 : median(off));
    const Column step = normal.ldlt().solve(right);
    for (std::size_t p = 1; p < placed_.size(); ++p)
      residuals_.move(p, vector(-step.segment<3>(place(p))), vector(-step.segment<3>(place(p) + 3)));
    return step.norm();
  }

  static void add(Square& normal, Column& right, std::size_t a, std::size_t b, const PoseResidual& r) {
    const Matrix6 square = r.weight * r.toward * r.toward.transpose();
    const Vector6 pull = r.weight * r.value * r.toward;
    if (a > 0) {
      normal.block<6, 6>(place(a), place(a)) += square;
      right.segment<6>(place(a)) += pull;
    }
    if (b > 0) {
      normal.block<6, 6>(place(b), place(b)) += square;
      right.segment<6>(place(b)) -= pull;
    }
    if (a > 0 && b > 0) {
      normal.block<6, 6>(place(a), place(b)) -= square;
      normal.block<6, 6>(place(b), place(a)) -= square;
    }
  }

  // How far each patch of skin has moved between every two poses.
  void weigh_skin() {
    struct Said {
      std::size_t patch, a, b;
      double value, weight;
    };
    std::vector<std::vector<Said>> parts(placed_.size() * kParts);
    residuals_.for_each_part(parts.size(), [&](std::size_t i) {
      residuals_.for_each_residual_of(i / kParts, i % kParts, kParts, kLast,
                                      [&](std::size_t a, std::size_t b, const PoseResidual& r) {
                                        parts[i].push_back({r.patch, a, b, r.value, r.weight});
                                      });
    });
    SkinPatches& skin = residuals_.skin();
    SkinPatches::Sums sums = skin.no_sums();
    for (const auto& part : parts)
      for (const Said& s : part) skin.add(sums, s.patch, s.a, s.b, s.value, s.weight);
    skin.take(sums);
  }

  // The covariance, and how well the poses lie on each other.
  Result<void> measure() {
    Square normal = kRidge * Square::Identity(unknowns_, unknowns_);
    Column none = Column::Zero(unknowns_);
    // What it does to all poses when a region of one pose's skin stands a millimetre out.
    std::pmr::vector<Column> pulls(SkinPatches::kRegions * placed_.size(), Column::Zero(0),
                                   &context_.scratch);
    struct Sum {
      double squares = 0, weight = 0, count = 0;
    };
    std::pmr::vector<Sum> sums(placed_.size(), Sum{}, &context_.scratch);
    residuals_.for_each_residual(kLast, [&](std::size_t a, std::size_t b, const PoseResidual& r) {
      add(normal, none, a, b, r);
      const Vector6 one = r.weight * r.toward;
      for (const std::size_t p : {a, b}) {
        Column& pull = pulls[SkinPatches::region_of(r.patch) * placed_.size() + p];
        if (pull.size() == 0) pull = Column::Zero(unknowns_);
        const double way = p == a ? 1 : -1;
        if (a > 0) pull.segment<6>(place(a)) += way * one;
        if (b > 0) pull.segment<6>(place(b)) -= way * one;
        sums[p].squares += r.weight * r.value * r.value;
        sums[p].weight += r.weight;
        sums[p].count += 1;
      }
    });
    const Square bread = normal.ldlt().solve(Square::Identity(unknowns_, unknowns_));
    Square covariance = Square::Zero(unknowns_, unknowns_);
    for (const Column& pull : pulls) {
      if (pull.size() == 0) continue;
      const Column moved = bread * pull;
      covariance += moved * moved.transpose();
    }
    covariance *= residuals_.skin().variance_mm2();
    for (std::size_t p = 0; p < placed_.size(); ++p) {
      RegisteredPose& pose = placed_[p];
      if (p > 0 && sums[p].count < kFewestSamples) pose.joined = false;
      if (sums[p].weight > 0) pose.rms_mm = std::sqrt(sums[p].squares / sums[p].weight);
      if (p == 0) continue;
      if (pose.rms_mm > kMostMovedMm) pose.joined = false;
      for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < 6; ++j)
          pose.covariance[static_cast<std::size_t>(6 * i + j)] = covariance(place(p) + i, place(p) + j);
    }
    return {};
  }

  std::span<RegisteredPose> placed_;
  PoseResiduals& residuals_;
  StageContext& context_;
  Eigen::Index unknowns_;
};

}  // namespace

Result<Registration> register_poses(std::span<PoseSurface> poses, StageContext& context) {
  if (poses.empty() || !poses[0].has_head)
    return Error{Errc::InvalidInput, "no head was found in the first pair: it must be the one from in front"}
        .at("pair 1");
  Registration made(&context.output);
  made.poses.resize(poses.size());
  PoseResiduals residuals(poses, made.poses, context);
  made.pivot_mm = residuals.pivot();
  std::array<bool, kMostPoses> left_out{};
  if (poses.size() > 1) {
    RELIEVO_TRY(place_poses(poses, made.poses, residuals, context));
    // What is left out pulls at none of the others.
    const auto leave_out = [&] {
      bool any = false;
      for (std::size_t p = 1; p < poses.size(); ++p)
        if (!made.poses[p].joined && !poses[p].trust.empty()) {
          poses[p].trust.assign(poses[p].trust.size(), 0);
          any = !std::exchange(left_out[p], true) || any;
        }
      return any;
    };
    leave_out();
    do {
      RELIEVO_TRY(JointSolver(made.poses, residuals, context).run());
    } while (leave_out());
    if (std::none_of(made.poses.begin() + 1, made.poses.end(), [](const auto& p) { return p.joined; }))
      return meets_no_other_pose(1);
  }
  return made;
}

}  // namespace relievo::pipeline
