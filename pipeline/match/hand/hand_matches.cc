// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/hand/hand_matches.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <string>
#include <tuple>

#include "pipeline/base/parts.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

constexpr int kRadiusPx = 7;         // of the windows
constexpr float kLeastAlike = 0.6F;  // below it a match does not grow
constexpr float kMoreAlike = 0.05F;  // than the match it takes the place of
constexpr float kAgreePx = 1;        // matches closer than this are one surface
constexpr float kFadeLengths = 3;  // of the difference: the bent surface never turns steeper than this allows
constexpr float kLeastFadeNodes = 4;  // nor bends over fewer nodes
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

bool outside(const RectifiedPair& pair, const Match& m) {
  const float x = m.left_px.x - m.disparity_px, right = float(pair.width_px - 1);
  return !(m.left_px.x >= 0 && m.left_px.x <= right && m.left_px.y >= 0 &&
           m.left_px.y <= float(pair.height_px - 1) && x >= 0 && x <= right);
}

float apart(Vec2f a, Vec2f b) { return std::hypot(a.x - b.x, a.y - b.y); }

// A node that a match may grow to, with the match it would have.
struct Offer {
  float alike;
  std::uint32_t node, origin;  // origin: of by_hand
  float disparity_px, sigma_px;
  // The order of the queue never depends on how it was filled.
  bool operator<(const Offer& o) const {
    return std::tie(alike, o.node, o.origin) < std::tie(o.alike, node, origin);
  }
};

class Lattice {
 public:
  Lattice(const RectifiedPair& pair, std::span<const Match> by_hand, MatchSet& set,
          std::pmr::memory_resource* memory)
      : pair_(pair),
        by_hand_(by_hand),
        set_(set),
        step_(set.lattice_step_px),
        at_(memory, (pair.width_px - 1 - first_x_) / step_ + 1, (pair.height_px - 1 - first_y_) / step_ + 1,
            kNone),
        fixed_(memory, at_.width, at_.height),
        grown_(by_hand.size(), 0, memory),
        offers_(std::less<Offer>(), std::pmr::vector<Offer>(memory)) {
    for (std::uint32_t k = 0; k < set.matches.size(); ++k) at_.values[node_at(set.matches[k].left_px)] = k;
  }

  // As the surface was; then each place's own nodes, and what grows from them.
  Result<void> join(StageContext& context) {
    std::pmr::vector<float> before(&context.scratch);
    for (const Match& hand : by_hand_) before.push_back(disparity_near(hand.left_px));
    for (std::uint32_t k = 0; k < by_hand_.size(); ++k)
      around(by_hand_[k].left_px, float(step_), [&](std::size_t node, float distance) {
        if (distance >= float(step_)) return;
        fix(node, k, by_hand_[k].disparity_px, by_hand_[k].sigma_px, 0);
        offer_neighbours(node, k, by_hand_[k].disparity_px);
      });
    for (int turn = 0; !offers_.empty(); ++turn) {
      if (turn % 64 == 0 && context.stop()) return stopped();
      const Offer best = offers_.top();
      offers_.pop();
      if (fixed_.values[best.node] != 0) continue;
      fix(best.node, best.origin, best.disparity_px, best.sigma_px, 1 - best.alike);
      offer_neighbours(best.node, best.origin, best.disparity_px);
    }
    // Half a window's nodes, or a place's own.
    const int enough = std::max((2 * kRadiusPx / step_) * (2 * kRadiusPx / step_) / 2, 4);
    for (std::uint32_t k = 0; k < by_hand_.size(); ++k)
      if (grown_[k] <= enough) bend(by_hand_[k], before[k]);
    return {};
  }

 private:
  int phase(float at) const { return int(std::lround(at)) % step_; }
  std::size_t node_at(Vec2f px) const {
    const int c = int(std::lround((px.x - float(first_x_)) / float(step_))),
              r = int(std::lround((px.y - float(first_y_)) / float(step_)));
    return std::size_t(std::clamp(r, 0, at_.height - 1)) * std::size_t(at_.width) +
           std::size_t(std::clamp(c, 0, at_.width - 1));
  }
  Vec2f place_of(std::size_t node) const {
    const auto wide = std::size_t(at_.width);
    return {float(first_x_ + int(node % wide) * step_), float(first_y_ + int(node / wide) * step_)};
  }
  float reach_px(const Match& hand) const {
    const double depth = pair_.depth_mm(hand.disparity_px);
    return float(depth > 0 ? kHandReachMm * pair_.focal_px / depth : 0);
  }
  // The nodes of the square about a place, row by row.
  template <typename See>
  void around(Vec2f place, float reach, See&& see) {
    const std::size_t wide = std::size_t(at_.width);
    const std::size_t low = node_at({place.x - reach, place.y - reach}),
                      high = node_at({place.x + reach, place.y + reach});
    for (std::size_t r = low / wide; r <= high / wide; ++r)
      for (std::size_t c = low % wide; c <= high % wide; ++c)
        see(r * wide + c, apart(place_of(r * wide + c), place));
  }
  const Match* there(std::size_t node) const {
    const std::uint32_t k = at_.values[node];
    return k != kNone && set_.matches[k].rejected_by == 0 ? &set_.matches[k] : nullptr;
  }
  // Of the nearest accepted match within a window, or a step where that is more; NaN: there is none.
  float disparity_near(Vec2f place) {
    float best = float(std::max(kRadiusPx, step_)), found = std::nanf("");
    around(place, best, [&](std::size_t node, float distance) {
      if (there(node) != nullptr && distance < best) best = distance, found = there(node)->disparity_px;
    });
    return found;
  }

  void put(std::size_t node, float disparity, float sigma, float cost) {
    const Match match{place_of(node), disparity, cost, sigma, 0};
    if (at_.values[node] != kNone) {
      set_.matches[at_.values[node]] = match;
      return;
    }
    at_.values[node] = std::uint32_t(set_.matches.size());
    set_.matches.push_back(match);
  }
  void fix(std::size_t node, std::uint32_t origin, float disparity, float sigma, float cost) {
    fixed_.values[node] = 1;
    ++grown_[origin];
    put(node, disparity, sigma, cost);
  }

  void offer_neighbours(std::size_t node, std::uint32_t origin, float disparity) {
    for_each_beside(node, std::size_t(at_.width), at_.values.size(),
                    [&](std::size_t beside) { offer(beside, origin, disparity); });
  }
  void offer(std::size_t node, std::uint32_t origin, float disparity) {
    const Vec2f place = place_of(node);
    if (fixed_.values[node] != 0 ||
        (!pair_.region.empty() && pair_.region[pair_.index(int(place.x), int(place.y))] == 0) ||
        apart(place, by_hand_[origin].left_px) > reach_px(by_hand_[origin]))
      return;
    const Match* old = there(node);
    if (old != nullptr && std::abs(old->disparity_px - disparity) <= kAgreePx) return;
    const auto nearby = double(disparity);
    const auto found = match_on_row(pair_, place, nearby - step_ - 1, nearby + step_ + 1, kRadiusPx);
    if (!found || 1 - found->cost < kLeastAlike || std::abs(found->disparity_px - disparity) > float(step_))
      return;
    if (old != nullptr &&
        (std::abs(old->disparity_px - found->disparity_px) <= kAgreePx ||
         found->cost + kMoreAlike > window_cost(pair_, place, old->disparity_px, kRadiusPx)))
      return;
    offers_.push({1 - found->cost, std::uint32_t(node), origin, found->disparity_px, found->sigma_px});
  }

  // Matches around bend to the hand's; a hole has it within a window.
  void bend(const Match& hand, float before) {
    const float off = std::isnan(before) ? 0 : hand.disparity_px - before;
    const float fade =
        std::min(reach_px(hand), std::max(kFadeLengths * std::abs(off), kLeastFadeNodes * float(step_)));
    around(hand.left_px, std::max(fade, float(kRadiusPx)), [&](std::size_t node, float distance) {
      if (fixed_.values[node] != 0) return;
      if (const Match* old = there(node); old != nullptr && distance < fade) {
        const float t = distance / fade, share = (1 - t) * (1 - t) * (1 + 2 * t);
        put(node, old->disparity_px + off * share,
            std::hypot(old->sigma_px, share * hand.sigma_px, off * share * (1 - share)), old->cost);
      } else if (old == nullptr && distance <= kRadiusPx) {
        put(node, hand.disparity_px, std::hypot(hand.sigma_px, distance / kRadiusPx), 0);
      }
    });
  }

  const RectifiedPair& pair_;
  std::span<const Match> by_hand_;
  MatchSet& set_;
  int step_, first_x_{phase(set_.matches.empty() ? 0 : set_.matches.front().left_px.x)},
      first_y_{phase(set_.matches.empty() ? 0 : set_.matches.front().left_px.y)};
  Plane<std::uint32_t> at_;      // a node's match
  Plane<std::uint8_t> fixed_;    // 1: the hand's, or grown from it
  std::pmr::vector<int> grown_;  // nodes, of each of by_hand
  std::priority_queue<Offer, std::pmr::vector<Offer>> offers_;
};

}  // namespace

Result<MatchSet> join_by_hand(const RectifiedPair& pair, const MatchSet& matches,
                              std::span<const Match> by_hand, StageContext& context) {
  for (std::size_t k = 0; k < by_hand.size(); ++k)
    if (outside(pair, by_hand[k]) || !(by_hand[k].sigma_px > 0))
      return invalid("this match made by hand lies outside the pictures: remove or move it")
          .at("by hand " + std::to_string(k + 1));
  MatchSet set(&context.scratch);
  set.epipolar_shift = matches.epipolar_shift;
  set.motion_px = matches.motion_px;
  set.lattice_step_px = matches.lattice_step_px;
  set.matches.reserve(matches.matches.size() + matches.matches.size() / 16 + 4096);
  set.matches.assign(matches.matches.begin(), matches.matches.end());
  if (set.lattice_step_px == 0) {
    std::erase_if(set.matches, [&](const Match& m) {
      return std::ranges::any_of(by_hand, [&](const Match& hand) {
        const float distance = apart(m.left_px, hand.left_px);
        return distance <= kRadiusPx && std::abs(m.disparity_px - hand.disparity_px) > distance;
      });
    });
    for (const Match& hand : by_hand)
      set.matches.push_back({hand.left_px, hand.disparity_px, 0, hand.sigma_px, 0});
    return set;
  }
  RELIEVO_TRY(Lattice(pair, by_hand, set, &context.scratch).join(context));
  return set;
}

PointsByHand::PointsByHand(const PointCloud& cloud, std::span<const Match> by_hand,
                           std::pmr::memory_resource* memory)
    : points_(memory) {
  const auto near = float(std::max(1, cloud.lattice_step_px));
  for (const CloudPoint& p : cloud.points)
    if (std::ranges::any_of(by_hand,
                            [&](const Match& hand) { return apart(p.left_px, hand.left_px) < near; }))
      points_.push_back(p);
}

void PointsByHand::put_back(PointCloud& cloud) const {
  for (const CloudPoint& p : points_)
    if (std::ranges::none_of(cloud.points,
                             [&](const CloudPoint& q) { return apart(p.left_px, q.left_px) == 0; }))
      cloud.points.push_back(p);
}

}  // namespace relievo::pipeline
