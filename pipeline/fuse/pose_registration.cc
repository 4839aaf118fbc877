// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/pose_registration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
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
constexpr double kStillMm = 2e-4, kSkinStillMm = 1e-6;
constexpr std::array<RegistrationRound, 4> kRounds{
    {{12, 6, 8, kFewSamples}, {6, 2, 6, kFewSamples}, {3, 0.7, 6, kFewSamples}, {2, 0.25, 4, kFewSamples}}};
constexpr RegistrationRound kLast{1.5, 0.08, 20};
constexpr double kSlideSigmaMm = 0.1;
// Regions move together, as both cheeks in a smile: so much more than apart (of twelve heads, still and
// moving).
constexpr double kRegionsAlike = 2.5;
constexpr double kSlow = 0.5, kSlowest = 0.9;  // of a step, to the one before
constexpr int kSkinTimes = 100;                // at most; each costs a thousandth of a look at the surfaces

Vec3d vector(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
Eigen::Index place(std::size_t pose) { return 6 * (static_cast<Eigen::Index>(pose) - 1); }

// All poses at once, each against each.
class JointSolver {
 public:
  JointSolver(std::span<RegisteredPose> placed, PoseResiduals& residuals, StageContext& context)
      : placed_(placed), residuals_(residuals), context_(context), unknowns_(place(placed.size())) {}

  Result<void> run() {
    for (const RegistrationRound& round : kRounds)
      for (int k = 0; k < round.times && move(round) > round.still(); ++k)
        if (context_.stop()) return stopped();
    residuals_.skin().watch();
    for (int k = 0; k < kLast.times; ++k) {
      if (context_.stop()) return stopped();
      if (settle() <= kStillMm) break;
    }
    return measure();
  }

 private:
  // One Gauss-Newton step; returns how far it went, millimetres and radians together.
  double move(const RegistrationRound& round) {
    SharedArena memory(context_.scratch);
    struct Part {
      Square normal;
      Column right;
      std::pmr::vector<float> off;
    };
    std::pmr::vector<Part> parts(&memory);
    parts.reserve(placed_.size() * kParts);
    while (parts.size() < placed_.size() * kParts)
      parts.push_back({{}, {}, std::pmr::vector<float>(&memory)});  // a copy would leave the arena
    residuals_.for_each_part(parts.size(), [&](std::size_t i) {
      Part& part = parts[i];
      part.normal = Square::Zero(unknowns_, unknowns_);
      part.right = Column::Zero(unknowns_);
      residuals_.for_each_residual_of(i / kParts, i % kParts, kParts, round,
                                      [&](std::size_t a, std::size_t b, const PoseResidual& r) {
                                        add(part.normal, part.right, a, b, r);
                                        part.off.push_back(float(std::abs(r.value)));
                                      });
    });
    Square normal = kRidge * Square::Identity(unknowns_, unknowns_);
    Column right = Column::Zero(unknowns_);
    std::pmr::vector<float> off(&memory);
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
    add(normal, right, a, b, r.weight * r.toward * r.toward.transpose(), r.weight * r.value * r.toward);
  }
  static void add(Square& normal, Column& right, std::size_t a, std::size_t b, const Matrix6& square,
                  const Vector6& pull) {
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

  // How far skin that two poses share slid along itself: visit(pose, other pose, residual), the lower first.
  template <typename Visit>
  void for_each_slide(Visit&& visit) const {
    for (std::size_t p = 0; p < placed_.size(); ++p)
      for (const SharedSkin& skin : residuals_.surface(p).shared_skin) {
        const std::size_t from = skin.pose;
        if (!placed_[p].joined || !placed_[from].joined) continue;
        const HeadPose& surface = residuals_.surface(from);
        const RigidTransform& placed = placed_[from].first_from_pose;
        Vec3d at = apply(placed, wide(surface.nodes[skin.node].at_mm)),
              other = apply(placed_[p].first_from_pose, wide(skin.at_mm));
        const std::size_t patch = residuals_.patch_at(at);
        const auto along =
            residuals_.along_skin(apply(placed.rotation, wide(surface.nodes[skin.node].normal)));
        if (from > p) std::swap(at, other);
        for (std::size_t k = 0; k < 2; ++k) {
          PoseResidual r{};
          r.value = dot(along[k], minus(at, other));
          r.weight = 1 / (kSlideSigmaMm * kSlideSigmaMm);
          const Vec3d turn = cross(minus(at, residuals_.pivot()), along[k]);
          r.toward << turn.x, turn.y, turn.z, along[k].x, along[k].y, along[k].z;
          r.patch = SkinPatches::sliding(patch, k);
          visit(std::min(from, p), std::max(from, p), r);
        }
      }
  }

  // What the samples in one patch say between two poses about small motions of `a` against `b`, a < b.
  struct PatchTerms {
    std::size_t patch = 0, a = 0, b = 0;
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero(), toward = Vector6::Zero();
    double sum = 0, weight = 0;

    void add(const PoseResidual& r, double way) {
      normal += r.weight * r.toward * r.toward.transpose();
      right += way * r.weight * r.value * r.toward;
      toward += r.weight * r.toward;
      sum += way * r.weight * r.value;
      weight += r.weight;
    }
    void add(const PatchTerms& other) {
      normal += other.normal;
      right += other.right;
      toward += other.toward;
      sum += other.sum;
      weight += other.weight;
    }
  };

  std::pmr::vector<PatchTerms> patch_terms(SharedArena& memory) const {
    const std::size_t poses = placed_.size();
    std::pmr::vector<std::pmr::deque<PatchTerms>> parts(poses * kParts, &memory);
    residuals_.for_each_part(parts.size(), [&](std::size_t i) {
      std::pmr::vector<PatchTerms*> known(SkinPatches::kPatches * poses, &memory);
      std::pmr::deque<PatchTerms>& terms = parts[i];
      residuals_.for_each_residual_of(
          i / kParts, i % kParts, kParts, kLast, [&](std::size_t a, std::size_t b, const PoseResidual& r) {
            PatchTerms*& its = known[r.patch * poses + b];
            if (its == nullptr)
              its =
                  &terms.emplace_back(PatchTerms{.patch = r.patch, .a = std::min(a, b), .b = std::max(a, b)});
            its->add(r, a < b ? 1 : -1);
          });
    });
    std::pmr::map<std::array<std::size_t, 3>, PatchTerms> all(&memory);
    for (const auto& part : parts)
      for (const PatchTerms& t : part) {
        const auto [its, added] = all.try_emplace({t.patch, t.a, t.b}, t);
        if (!added) its->second.add(t);
      }
    for_each_slide([&](std::size_t a, std::size_t b, const PoseResidual& r) {
      all.try_emplace({r.patch, a, b}, PatchTerms{.patch = r.patch, .a = a, .b = b}).first->second.add(r, 1);
    });
    std::pmr::vector<PatchTerms> list(&memory);
    for (const auto& [key, terms] : all) list.push_back(terms);
    return list;
  }

  // How the poses lie and which patches of skin have moved hang on each other: both are found together, the
  // surfaces looked at once. Returns how far the poses went, millimetres and radians together.
  double settle() {
    SharedArena memory(context_.scratch);
    const auto terms = patch_terms(memory);
    std::pmr::vector<PatchMean> means(&memory);
    for (const PatchTerms& t : terms) means.push_back({t.patch, t.a, t.b, 0, t.weight});
    Column moved = Column::Zero(unknowns_);
    for (int k = 0; k < kSkinTimes; ++k) {
      const auto motion = [&](const PatchTerms& t) -> Vector6 {
        const Vector6 back = moved.segment<6>(place(t.b));
        return t.a == 0 ? Vector6(-back) : Vector6(moved.segment<6>(place(t.a)) - back);
      };
      for (std::size_t i = 0; i < terms.size(); ++i)
        means[i].mm = (terms[i].sum + terms[i].toward.dot(motion(terms[i]))) / terms[i].weight;
      const SkinPatches::Usual usual = SkinPatches::usual(means, memory);
      Square normal = kRidge * Square::Identity(unknowns_, unknowns_);
      Column right = Column::Zero(unknowns_);
      for (std::size_t i = 0; i < terms.size(); ++i) {
        const PatchTerms& t = terms[i];
        const double say = SkinPatches::say(means[i], usual);
        add(normal, right, t.a, t.b, say * t.normal, say * (t.right + t.normal * motion(t)));
      }
      const Column step = normal.ldlt().solve(right);
      moved -= step;
      if (step.norm() <= kSkinStillMm) break;
    }
    residuals_.skin().take(means);
    // Surfaces slide along each other by steps that shrink slowly and evenly: after two such steps go at once
    // where they lead (Aitken 1926).
    const double ratio = last_.size() == 0 ? 0 : moved.dot(last_) / last_.squaredNorm();
    last_ = moved;
    if (ratio > kSlow) {
      moved /= 1 - std::min(ratio, kSlowest);
      last_.resize(0);
    }
    for (std::size_t p = 1; p < placed_.size(); ++p)
      residuals_.move(p, vector(moved.segment<3>(place(p))), vector(moved.segment<3>(place(p) + 3)));
    return moved.norm();
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
    const auto take = [&](std::size_t a, std::size_t b, PoseResidual r) {
      r.weight *= residuals_.skin().say(r.patch, a, b);
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
    };
    for (std::size_t a = 0; a < placed_.size(); ++a) residuals_.for_each_residual_of(a, 0, 1, kLast, take);
    const Square bread = normal.ldlt().solve(Square::Identity(unknowns_, unknowns_));
    Square covariance = Square::Zero(unknowns_, unknowns_);
    for (const Column& pull : pulls) {
      if (pull.size() == 0) continue;
      const Column moved = bread * pull;
      covariance += moved * moved.transpose();
    }
    covariance *= kRegionsAlike * residuals_.skin().variance_mm2();
    for (std::size_t p = 0; p < placed_.size(); ++p) {
      RegisteredPose& pose = placed_[p];
      if (p > 0 && sums[p].count < kFewestSamples) pose.joined = false;
      if (sums[p].weight > 0) pose.rms_mm = std::sqrt(sums[p].squares / sums[p].weight);
      if (p == 0) continue;
      if (pose.rms_mm > kMostMovedMm) pose.joined = false;
      for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < 6; ++j)
          pose.covariance[std::size_t(6 * i + j)] = covariance(place(p) + i, place(p) + j);
    }
    return {};
  }

  std::span<RegisteredPose> placed_;
  PoseResiduals& residuals_;
  StageContext& context_;
  Eigen::Index unknowns_;
  Column last_;  // step of settle()
};

}  // namespace

Result<Registration> register_poses(std::span<HeadPose> poses, StageContext& context) {
  if (poses.empty() || !poses[0].has_head)
    return invalid("no head was found in the first pair: it must be the one from in front").at("pair 1");
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
        if (!made.poses[p].joined && !poses[p].nodes.empty()) {
          for (SurfaceHit& node : poses[p].nodes) node.trust = 0;
          any = !std::exchange(left_out[p], true) || any;
        }
      return any;
    };
    leave_out();
    do {
      RELIEVO_TRY(JointSolver(made.poses, residuals, context).run());
      made.skin_moved_mm = std::sqrt(residuals.skin().variance_mm2());
    } while (leave_out());
    if (std::none_of(made.poses.begin() + 1, made.poses.end(), [](const auto& p) { return p.joined; }))
      return Error{Errc::PoorGeometry,
                   "what this pair shows meets none of the others: turn the head by less between two of them"}
          .at("pair 2");
    measure_agreement(poses, made, context);
  }
  return made;
}

}  // namespace relievo::pipeline
