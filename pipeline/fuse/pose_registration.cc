// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/pose_registration.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"
#include "pipeline/fuse/skin_patches.h"
#include "pipeline/model/small_motion.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

using Square =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6 * (kMostPoses - 1), 6 * (kMostPoses - 1)>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6 * (kMostPoses - 1), 1>;

constexpr std::size_t kParts = 4;    // of a pose's samples, for the threads
constexpr float kLeastTrust = 0.2F;  // of a node that is laid onto another pose's
constexpr double kSameWay = 0.7;     // cosine between the normals of what is taken for the same skin
constexpr double kLeastSigmaMm = 0.03;
constexpr double kNeckMm = -60;  // above the tip of the nose
constexpr double kFewestSamples = 300, kFewestCoarse = 80;
constexpr double kRidge = 1e-9;
constexpr double kStillMm = 1e-5;
// How far apart two surfaces may lie to be taken for the same skin, and the scale beyond which a distance
// loses its say, round by round; and how many nodes of a lattice are laid onto the other poses, at most.
struct Round {
  double reach_mm, scale_mm;
  int times;
  double samples = 18'000;
};
constexpr double kFewSamples = 4'500;
constexpr std::array<Round, 5> kRounds{
    {{12, 6, 8, kFewSamples}, {6, 2, 6, kFewSamples}, {3, 0.7, 6}, {2, 0.25, 8}, {1.5, 0.12, 8}}};
constexpr Round kLast{1.5, 0.08, 12};
// Surfaces of calibrations that differ lie off everywhere: no scale is narrower than what is usual.
constexpr double kScaleOfUsual = 1.5;
// How one pose is laid onto those before it, and from where it is tried, where its own head frame is no good
// start.
constexpr std::array<Round, 4> kCoarse{
    {{25, 12, 8, kFewSamples}, {12, 6, 6, kFewSamples}, {6, 2, 6, kFewSamples}, {3, 0.7, 4, kFewSamples}}};
// A pose is well laid where so much of what lies near another pose's surface lies on it: from its own head
// frame, and from the best of all starts.
constexpr double kMetMm = 1;
constexpr double kWellMetShare = 0.8, kMetShare = 0.5;
constexpr std::array<Vec2d, 9> kTurnsDeg{
    {{0, 0}, {-25, 0}, {25, 0}, {-45, 0}, {45, 0}, {-65, 0}, {65, 0}, {0, -20}, {0, 20}}};  // yaw, pitch

Vec3d vector(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// How much the skin at a place in the head's frame has to say of how the skull stands.
double say_of(const Vec3d& p) {
  const double side = std::abs(p.x);
  if (p.y < kNeckMm) return 0;                // neck
  if (p.y > 105) return 0.1;                  // hair
  if (p.z < -62) return p.y < -30 ? 0.1 : 1;  // temples, ears; the jaw's corner
  if (p.y > 52) return 1;                     // forehead
  if (side < 9 && p.y > 12) return 1;         // bridge of the nose
  if (p.y > 20 && side < 60) return 0.05;     // lids and brows
  if (p.y > 0) return side > 30 ? 0.3 : 0.1;  // cheek bones
  return 0.02;                                // lips, chin, jaw
}

// What one sample of a pose says against another one's surface.
struct Residual {
  double value, weight;
  Vector6 toward;  // derivative by a motion of the sample's pose; of the other one it is the opposite
  Vec3d at;
  std::size_t patch;
};

class Solver {
 public:
  Solver(std::span<const PoseSurface> poses, std::span<RegisteredPose> placed, StageContext& context)
      : poses_(poses),
        placed_(placed),
        context_(context),
        unknowns_(6 * static_cast<Eigen::Index>(poses.size() - 1)),
        skin_(poses.size(), &context.scratch),
        known_(&context.scratch) {
    pivot_ = apply(inverse(poses[0].head_from_camera), Vec3d{0, 20, -kHeadCentreMm});
  }

  // Each pose from its head frame or the start that serves best, the surest first.
  Result<void> place_all() {
    std::pmr::vector<std::size_t> left(&context_.scratch);
    for (std::size_t p = 1; p < poses_.size(); ++p) left.push_back(p);
    known_.assign(poses_.size(), 0);
    known_[0] = 1;
    for (const bool anywhere : {false, true})
      for (bool more = true; more;) {
        more = false;
        for (std::size_t i = 0; i < left.size(); ++i) {
          if (context_.stop()) return stopped();
          const Laid laid = anywhere ? lay_from_anywhere(left[i]) : lay_from_head(left[i]);
          if (laid.count < kFewestCoarse || laid.share < (anywhere ? kMetShare : kWellMetShare)) continue;
          placed_[left[i]].first_from_pose = laid.placed;
          known_[left[i]] = 1;
          left.erase(left.begin() + static_cast<std::ptrdiff_t>(i--));
          more = true;
        }
      }
    if (left.empty()) return {};
    return meets_none(left[0]);
  }

  Result<void> run() {
    RELIEVO_TRY(place_all());
    for (const Round& round : kRounds)
      for (int k = 0; k < round.times && move(round) > kStillMm; ++k)
        if (context_.stop()) return stopped();
    skin_.watch();
    for (int k = 0; k < kLast.times; ++k) {
      weigh_skin();
      if (context_.stop()) return stopped();
      if (move(kLast) <= kStillMm) break;
    }
    return measure();
  }
  const Vec3d& pivot() const { return pivot_; }

 private:
  struct Laid {
    RigidTransform placed;
    double count = 0;  // of samples on another pose's surface, each by its say
    double share = 0;  // of those near one
  };

  Laid lay_from_head(std::size_t p) {
    if (!poses_[p].has_head) return {};
    return lay(p, product(inverse(poses_[0].head_from_camera), poses_[p].head_from_camera));
  }
  // As if the head had turned before the same cameras.
  Laid lay_from_anywhere(std::size_t p) {
    Laid best = lay_from_head(p);
    for (const Vec2d& turn : kTurnsDeg) {
      if (context_.stop()) break;
      const Eigen::Matrix3d r = (Eigen::AngleAxisd(radians(turn.x), Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(radians(turn.y), Eigen::Vector3d::UnitX()))
                                    .toRotationMatrix();
      RigidTransform turned;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) turned.rotation.m[3 * i + j] = r(i, j);
      const Vec3d middle{0, 20, -kHeadCentreMm}, moved = apply(turned.rotation, middle);
      turned.translation_mm = minus(middle, moved);
      const RigidTransform& head = poses_[0].head_from_camera;
      const Laid laid = lay(p, product(inverse(head), product(turned, head)));
      if (laid.count * laid.share > best.count * best.share) best = laid;
    }
    return best;
  }

  // One pose onto the known ones, which stay.
  Laid lay(std::size_t p, const RigidTransform& start) {
    placed_[p].first_from_pose = start;
    Laid laid;
    double near = 0;
    struct Part {
      Matrix6 normal;
      Vector6 right;
      double near, count;
    };
    for (const Round& round : kCoarse)
      for (int k = 0; k < round.times; ++k) {
        std::array<Part, kParts> parts;
        for_each_part(kParts, [&](std::size_t i) {
          Part sum{Matrix6::Zero(), Vector6::Zero(), 0, 0};
          const auto against_known = [&](std::size_t node, const Vec3d& n, double say, Residual& res) {
            for (std::size_t b = 0; b < poses_.size(); ++b) {
              if (known_[b] == 0 || b == p || !meet(poses_[p], node, n, b, round, res)) continue;
              sum.normal += say * res.weight * res.toward * res.toward.transpose();
              sum.right += say * res.weight * res.value * res.toward;
              sum.near += say;
              sum.count += std::abs(res.value) < kMetMm ? say : 0;
            }
          };
          for_each_sample(p, round.samples, against_known, i, kParts);
          parts[i] = sum;
        });
        Matrix6 normal = kRidge * Matrix6::Identity();
        Vector6 right = Vector6::Zero();
        laid.count = near = 0;
        for (const Part& part : parts) {
          normal += part.normal;
          right += part.right;
          near += part.near;
          laid.count += part.count;
        }
        if (near < kFewestCoarse) return {};
        const Vector6 step = solved<6>(normal, right);
        placed_[p].first_from_pose =
            product(small_motion(vector(-step.head<3>()), vector(-step.tail<3>()), pivot_),
                    placed_[p].first_from_pose);
      }
    laid.placed = placed_[p].first_from_pose;
    laid.share = laid.count / near;
    return laid;
  }
  static Error meets_none(std::size_t p) {
    return Error{Errc::PoorGeometry,
                 "what this pair shows meets none of the others: turn the head by less between two of them"}
        .at("pair " + std::to_string(p + 1));
  }
  static Error stopped() { return {Errc::Cancelled, "stopped while the poses were laid onto each other"}; }
  static Eigen::Index place(std::size_t pose) { return 6 * (static_cast<Eigen::Index>(pose) - 1); }

  // Sums are made by parts, each by one thread, and put together in their order: the same for any number of
  // threads.
  template <typename Work>
  void for_each_part(std::size_t parts, Work&& work) const {
    context_.pool.for_each_band(static_cast<int>(parts), static_cast<int>(parts),
                                [&](int, int, int i) { work(static_cast<std::size_t>(i)); });
  }

  // One Gauss-Newton step; returns how far it went, millimetres and radians together.
  double move(const Round& round) {
    struct Part {
      Square normal;
      Column right;
      std::vector<float> off;
    };
    std::vector<Part> parts(poses_.size() * kParts);
    for_each_part(parts.size(), [&](std::size_t i) {
      Part& part = parts[i];
      part.normal = Square::Zero(unknowns_, unknowns_);
      part.right = Column::Zero(unknowns_);
      for_each_residual_of(i / kParts, i % kParts, kParts, round,
                           [&](std::size_t a, std::size_t b, const Residual& r) {
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
    usual_mm_ = off.empty() ? 0 : median(off);
    const Column step = normal.ldlt().solve(right);
    for (std::size_t p = 1; p < poses_.size(); ++p)
      placed_[p].first_from_pose = product(
          small_motion(vector(-step.segment<3>(place(p))), vector(-step.segment<3>(place(p) + 3)), pivot_),
          placed_[p].first_from_pose);
    return step.norm();
  }

  static void add(Square& normal, Column& right, std::size_t a, std::size_t b, const Residual& r) {
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

  // Places of a pose that say something of how the skull stands: visit(node, normal in the first pose's
  // frame, say, residual with its place and patch).
  template <typename Visit>
  void for_each_sample(std::size_t a, double most, Visit&& visit, std::size_t part = 0,
                       std::size_t parts = 1) const {
    const PoseSurface& from = poses_[a];
    const int every = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(from.trust.size()) / most)));
    const RigidTransform& placed = placed_[a].first_from_pose;
    const int step = every * static_cast<int>(parts);
    for (int r = every / 2 + every * static_cast<int>(part); r < from.rows; r += step)
      for (int c = every / 2; c < from.columns; c += every) {
        const std::size_t k = static_cast<std::size_t>(r) * static_cast<std::size_t>(from.columns) +
                              static_cast<std::size_t>(c);
        if (from.trust[k] < kLeastTrust) continue;
        Residual res{};
        res.at = apply(placed, wide(from.at_mm[k]));
        const Vec3d in_head = apply(poses_[0].head_from_camera, res.at);
        const double say = !skin_.watched() ? say_of(in_head) : in_head.y < kNeckMm ? 0 : 1;
        if (say == 0) continue;
        res.patch = SkinPatches::at(in_head);
        visit(k, apply(placed.rotation, wide(from.normal[k])), say, res);
      }
  }

  template <typename Visit>
  void for_each_residual(const Round& round, Visit&& visit) const {
    for (std::size_t a = 0; a < poses_.size(); ++a) for_each_residual_of(a, 0, 1, round, visit);
  }
  // Of one pose's samples, and of those every so many rows.
  template <typename Visit>
  void for_each_residual_of(std::size_t a, std::size_t part, std::size_t parts, const Round& round,
                            Visit&& visit) const {
    const auto against_others = [&](std::size_t k, const Vec3d& normal, double say, Residual& res) {
      for (std::size_t b = 0; b < poses_.size(); ++b)
        if (b != a && meet(poses_[a], k, normal, b, round, res)) {
          res.weight *= say * skin_.still(res.patch, a, b);
          visit(a, b, res);
        }
    };
    for_each_sample(a, round.samples, against_others, part, parts);
  }

  // False where pose `b` shows nothing near, or the other side of something.
  bool meet(const PoseSurface& from, std::size_t k, const Vec3d& normal, std::size_t b, const Round& round,
            Residual& res) const {
    const RigidTransform& placed = placed_[b].first_from_pose;
    const auto hit = poses_[b].look(narrow(apply(inverse(placed), res.at)));
    if (!hit || hit->trust < kLeastTrust) return false;
    const Vec3d n = apply(placed.rotation, wide(hit->normal));
    if (dot(n, normal) < kSameWay) return false;
    res.value = dot(n, minus(res.at, apply(placed, wide(hit->at_mm))));
    if (std::abs(res.value) > round.reach_mm) return false;
    const double a = static_cast<double>(from.sigma_mm[k]), s = static_cast<double>(hit->sigma_mm);
    const double scale = std::max(round.scale_mm, kScaleOfUsual * usual_mm_);
    const double kept = scale * scale / (scale * scale + res.value * res.value);
    res.weight = static_cast<double>(std::min(from.trust[k], hit->trust)) * kept * kept /
                 (a * a + s * s + kLeastSigmaMm * kLeastSigmaMm);
    const Vec3d turn = cross(minus(res.at, pivot_), n);
    res.toward << turn.x, turn.y, turn.z, n.x, n.y, n.z;
    return true;
  }

  // How far each patch of skin has moved between every two poses.
  void weigh_skin() {
    struct Said {
      std::size_t patch, a, b;
      double value, weight;
    };
    std::vector<std::vector<Said>> parts(poses_.size() * kParts);
    for_each_part(parts.size(), [&](std::size_t i) {
      for_each_residual_of(i / kParts, i % kParts, kParts, kLast,
                           [&](std::size_t a, std::size_t b, const Residual& r) {
                             parts[i].push_back({r.patch, a, b, r.value, r.weight});
                           });
    });
    SkinPatches::Sums sums = skin_.no_sums();
    for (const auto& part : parts)
      for (const Said& s : part) skin_.add(sums, s.patch, s.a, s.b, s.value, s.weight);
    skin_.take(sums);
  }

  // The covariance, and how well the poses lie on each other.
  Result<void> measure() {
    Square normal = kRidge * Square::Identity(unknowns_, unknowns_);
    Column none = Column::Zero(unknowns_);
    // What it does to all poses when a region of one pose's skin stands a millimetre out.
    std::pmr::vector<Column> pulls(SkinPatches::kRegions * poses_.size(), Column::Zero(0), &context_.scratch);
    struct Sum {
      double squares = 0, weight = 0, count = 0;
    };
    std::pmr::vector<Sum> sums(poses_.size(), Sum{}, &context_.scratch);
    for_each_residual(kLast, [&](std::size_t a, std::size_t b, const Residual& r) {
      add(normal, none, a, b, r);
      const Vector6 one = r.weight * r.toward;
      for (const std::size_t p : {a, b}) {
        Column& pull = pulls[SkinPatches::region_of(r.patch) * poses_.size() + p];
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
    covariance *= skin_.variance_mm2();
    for (std::size_t p = 0; p < poses_.size(); ++p) {
      RegisteredPose& pose = placed_[p];
      if (sums[p].count < kFewestSamples) return meets_none(p);
      pose.rms_mm = std::sqrt(sums[p].squares / sums[p].weight);
      if (p == 0) continue;
      for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < 6; ++j)
          pose.covariance[static_cast<std::size_t>(6 * i + j)] = covariance(place(p) + i, place(p) + j);
    }
    return {};
  }

  std::span<const PoseSurface> poses_;
  std::span<RegisteredPose> placed_;
  StageContext& context_;
  Eigen::Index unknowns_;
  double usual_mm_ = 0;                   // distance between the surfaces, in the step before
  SkinPatches skin_;                      // watched as soon as the poses lie on each other
  std::pmr::vector<std::uint8_t> known_;  // poses that others are laid onto, while they are placed
  Vec3d pivot_;
};

}  // namespace

Result<Registration> register_poses(std::span<const PoseSurface> poses, StageContext& context) {
  if (poses.empty() || !poses[0].has_head)
    return Error{Errc::InvalidInput, "no head was found in the first pair: it must be the one from in front"}
        .at("pair 1");
  Registration made(&context.output);
  made.poses.resize(poses.size());
  Solver solver(poses, made.poses, context);
  made.pivot_mm = solver.pivot();
  if (poses.size() > 1) RELIEVO_TRY(solver.run());
  return made;
}

}  // namespace relievo::pipeline
