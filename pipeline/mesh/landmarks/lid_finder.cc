// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/mesh/landmarks/face_relief.h"
#include "pipeline/mesh/landmarks/landmark_finder.h"
#include "pipeline/model/photo_sampler.h"

namespace relievo::pipeline {
namespace {

// Where an eye is looked for, from the tip of the nose.
constexpr double kPupilMm = 31.5, kUpMm = 35;
constexpr double kHalfWidthMm = 24, kHalfHeightMm = 23;
constexpr double kStepMm = 0.5, kReliefMm = 1, kSmoothMm = 2;
constexpr double kNoise = 3;    // mean absolute deviations of skin
constexpr double kShare = 0.5;  // of what the least red two per cent differ by
constexpr float kGreyest = 30;  // added to the sum of the channels: what is dark has no colour
constexpr double kLeastChroma = 0.01;
// What eyes are like: half the width between corners, its middle from where pupils are, both lids' heights;
// and what a deviation costs, mm2.
constexpr double kHalfFissureMm = 14, kHalfFissureSigmaMm = 1.5, kFissureCost = 3;
constexpr double kAsideSigmaMm = 3, kAsideCost = 2;
constexpr double kUpperMm = 5.5, kLowerMm = 4, kHeightSigmaMm = 2, kHeightCost = 2;
constexpr double kTiltMm = 1, kTiltSigmaMm = 2, kTiltCost = 1;  // of the outer corner over the inner one
constexpr int kLowestMm = -12, kHighestMm = 12;                 // of the corners, from kUpMm
constexpr double kLeastOpenMm = 3, kLeastHeightMm = 0.5;
constexpr std::size_t kHighest = 9;
constexpr double kUnlikeCost = 0.5;  // of an eye's own almond, from the one of both
constexpr double kLeastShare = 0.2;  // by which more of the almond than of what lies around it is no skin
constexpr double kAroundMm = 2;

// Of an open eye either the half is that much less red than skin, or the lightest tenth that much lighter
// than the darkest: sclera beside an iris and lashes. A closed lid that shines is neither.
constexpr double kWhiteRed = 0.5, kIrisContrast = 1.8;
constexpr double kRimMm = 1;

// The surroundings of an eye, columns away from the nose, rows upwards.
struct Window {
  explicit Window(std::pmr::memory_resource* memory)
      : red(memory), light(memory), unlike_skin(memory), below(memory) {}
  static constexpr int columns = int(2 * kHalfWidthMm / kStepMm) + 1,
                       rows = int(2 * kHalfHeightMm / kStepMm) + 1;
  std::pmr::vector<float> red;    // (R - B) / (R + G + B): 0 for grey; the lamp's colour is in all of it. NaN
                                  // where nothing is known
  std::pmr::vector<float> light;  // R + G + B
  double skin = 0;                // how red that is
  std::pmr::vector<float> unlike_skin;  // 0.5 surely not, -0.5 surely skin
  std::pmr::vector<double> below;       // sum of a column's samples up to a row, mm2

  double x_mm(int c) const { return kPupilMm - kHalfWidthMm + c * kStepMm; }
  double y_mm(int r) const { return kUpMm - kHalfHeightMm + r * kStepMm; }
  std::size_t index(int c, int r) const { return std::size_t(c * (rows + 1) + r); }
  double sum_below(int c, double y) const {
    const double r = std::clamp((y - y_mm(0)) / kStepMm + 0.5, 0.0, rows - 1e-6);
    const int whole = int(r);
    const double share = r - whole;
    return (1 - share) * below[index(c, whole)] + share * below[index(c, whole + 1)];
  }
};

void blur(std::pmr::vector<float>& v, int columns, int rows) {
  const auto along = [&](int lines, int length, int line_step, int step) {
    for (int l = 0; l < lines; ++l) {
      float* p = &v[std::size_t(l * line_step)];
      float before = p[0];
      for (int i = 0; i < length; ++i) {
        const float here = p[i * step], after = p[std::min(i + 1, length - 1) * step];
        p[i * step] = (before + 2 * here + after) / 4;
        before = here;
      }
    }
  };
  along(rows, columns, columns, 1);
  along(columns, rows, 1, columns);
}

void sample(Window& w, const FaceRelief& relief, const RigidTransform& camera_from_head,
            const RectifiedPair& pair, double side) {
  w.red.assign(std::size_t(w.columns * w.rows), std::nanf(""));
  w.light.assign(w.red.size(), 0);
  const PhotoSampler photo(pair.left.rgb, pair.width_px, pair.height_px);
  for (int r = 0; r < w.rows; ++r)
    for (int c = 0; c < w.columns; ++c) {
      const double x = side * w.x_mm(c), y = w.y_mm(r), z = relief.at(x, y);
      if (std::isnan(z)) continue;
      const Vec3d p = apply(pair.rectified_from_left, apply(camera_from_head, Vec3d{x, y, z}));
      const double u = p.x / p.z * pair.focal_px + pair.left_centre_px.x,
                   v = p.y / p.z * pair.focal_px + pair.left_centre_px.y;
      const double apart = kStepMm / 3 * pair.focal_px / p.z;  // of nine places in a sample
      if (u < 0 || v < 0 || u > pair.width_px - 1 || v > pair.height_px - 1) continue;
      float sum[3] = {0, 0, 0};
      for (const double dv : {-apart, 0.0, apart})
        for (const double du : {-apart, 0.0, apart}) {
          float rgb[3];
          photo.read(float(u + du), float(v + dv), rgb);
          for (std::size_t i = 0; i < 3; ++i) sum[i] += rgb[i] / 9;
        }
      const std::size_t k = std::size_t(r * w.columns + c);
      w.light[k] = sum[0] + sum[1] + sum[2];
      w.red[k] = (sum[0] - sum[2]) / (w.light[k] + kGreyest);
    }
}

// False where there is nothing to tell by.
bool tell_skin(Window& w, Arena& scratch) {
  std::pmr::vector<float> known(&scratch);
  for (const float v : w.red)
    if (!std::isnan(v)) known.push_back(v);
  if (known.size() * 2 < w.red.size()) return false;
  w.skin = median(known);
  for (float& v : w.red)
    if (std::isnan(v)) v = float(w.skin);
  blur(w.red, w.columns, w.rows);
  std::pmr::vector<float> reds(w.red, &scratch);
  const double least_red = percentile(reds, 0.02);
  if (!(w.skin - least_red > kLeastChroma)) return false;
  for (float& v : known) v = float(std::abs(double(v) - w.skin));
  const double scale = std::max(kNoise * median(known), kShare * (w.skin - least_red));
  w.unlike_skin.reserve(w.red.size());
  for (const float red : w.red) {
    const double unlike = (w.skin - double(red)) / scale;
    w.unlike_skin.push_back(unlike < -0.5 ? 0
                                          : float(std::clamp(unlike, 0.0, 1.0) -
                                                  0.5));  // redder than skin: a lid's margin, or a brown iris
  }
  w.below.assign(std::size_t(w.columns * (w.rows + 1)), 0);
  for (int c = 0; c < w.columns; ++c)
    for (int r = 0; r < w.rows; ++r)
      w.below[w.index(c, r + 1)] =
          w.below[w.index(c, r)] + kStepMm * kStepMm * double(w.unlike_skin[std::size_t(r * w.columns + c)]);
  return true;
}

double squared(double v) { return v * v; }

double middle_mm(const Lids& l) { return (l.inner.y + l.outer.y) / 2; }  // of the corners, upwards

// What an almond's corners and its opening cost, mm2.
double cost(const Lids& l) {
  return kFissureCost * squared(((l.outer.x - l.inner.x) / 2 - kHalfFissureMm) / kHalfFissureSigmaMm) +
         kAsideCost * squared(((l.inner.x + l.outer.x) / 2 - kPupilMm) / kAsideSigmaMm) +
         kTiltCost * squared((l.outer.y - l.inner.y - kTiltMm) / kTiltSigmaMm) +
         kHeightCost * (squared((l.upper - kUpperMm) / kHeightSigmaMm) +
                        squared((l.lower - kLowerMm) / kHeightSigmaMm));
}

// What lies below a parabola over the line between two corners, mm2.
double sum_below(const Window& w, const Vec2d& inner, const Vec2d& outer, double height) {
  double sum = 0;
  const int first = std::max(0, int(std::ceil((inner.x - w.x_mm(0)) / kStepMm)));
  for (int c = first; c < w.columns && w.x_mm(c) < outer.x; ++c) {
    const double along = (w.x_mm(c) - inner.x) / (outer.x - inner.x);
    sum += w.sum_below(c, inner.y + along * (outer.y - inner.y) + height * 4 * along * (1 - along));
  }
  return sum;
}

double worth(const Window& w, const Lids& l) {
  if (l.outer.x - l.inner.x < 20 || std::min(l.upper, l.lower) < kLeastHeightMm ||
      l.upper + l.lower < kLeastOpenMm || std::max(l.upper, l.lower) > double(kHighest))
    return -1e9;
  return sum_below(w, l.inner, l.outer, l.upper) - sum_below(w, l.inner, l.outer, -l.lower) - cost(l);
}

// How many times lighter the lightest of an open eye is than its darkest; 0 where none is seen in the almond.
double eye_contrast(const Window& w, const Lids& lids, Arena& scratch) {
  const Arena::Mark mark(scratch);
  std::pmr::vector<float> red(&scratch), light(&scratch);
  double within = 0, around = 0;
  int inside = 0, outside = 0;
  for (int r = 0; r < w.rows; ++r)
    for (int c = 0; c < w.columns; ++c) {
      const std::size_t k = std::size_t(r * w.columns + c);
      const double x = w.x_mm(c), depth = lids.depth({x, w.y_mm(r)});
      if (depth > kRimMm) red.push_back(w.red[k]), light.push_back(w.light[k]);
      if (depth > 0) within += double(w.unlike_skin[k]), ++inside;
      else if (depth > -kAroundMm && x > lids.inner.x && x < lids.outer.x)
        around += double(w.unlike_skin[k]), ++outside;
    }
  if (red.empty() || inside == 0 || outside == 0 || within / inside - around / outside < kLeastShare)
    return 0;
  const double contrast = percentile(light, 0.9) / percentile(light, 0.1);
  return median(red) < kWhiteRed * w.skin || contrast > kIrisContrast ? contrast : 0;
}

// Of all almonds whose corners lie no higher than `highest_mm` over kUpMm the best, within a millimetre or
// two.
Lids search(const Window& w, int highest_mm, ThreadPool& pool) {
  struct Best {
    Lids lids;
    double value = -1e9;
  };
  // Both lids of an almond with these corners do not depend on one another.
  const auto consider = [&](const Vec2d& inner, const Vec2d& outer, Best& best) {
    std::array<double, kHighest + 1> upper{}, lower{};
    for (std::size_t h = 1; h <= kHighest; ++h) {
      upper[h] = sum_below(w, inner, outer, double(h));
      lower[h] = sum_below(w, inner, outer, -double(h));
    }
    for (std::size_t u = 1; u <= kHighest; ++u)
      for (std::size_t l = 1; l <= kHighest; ++l) {
        const Lids lids{inner, outer, double(u), double(l)};
        const double value = upper[u] - lower[l] - cost(lids);
        if (lids.upper + lids.lower >= kLeastOpenMm && value > best.value) best = {lids, value};
      }
  };
  std::array<Best, 7> found;  // one for each place of the inner corner
  pool.for_each(7, 7, [&](int k) {
    const int from = 2 * k - 19;
    for (int width = 22; width <= std::min(34, 20 - from); width += 2)
      for (int up = kLowestMm; up <= highest_mm; ++up)
        for (const double tilt : {-4.0, -2.0, 0.0, 2.0, 4.0})
          consider({kPupilMm + from, kUpMm + up - tilt / 2}, {kPupilMm + from + width, kUpMm + up + tilt / 2},
                   found[std::size_t(k)]);
  });
  return std::ranges::max_element(found, [](const Best& l, const Best& r) { return l.value < r.value; })
      ->lids;
}

// The best near `common`, uphill.
Lids refine(const Window& w, const Lids& common) {
  const auto own = [&](const Lids& l) {
    return worth(w, l) -
           kUnlikeCost * (squared(l.inner.x - common.inner.x) + squared(l.inner.y - common.inner.y) +
                          squared(l.outer.x - common.outer.x) + squared(l.outer.y - common.outer.y) +
                          squared(l.upper - common.upper) + squared(l.lower - common.lower));
  };
  Lids best = common;
  double most = own(best);
  double step = 1;
  while (step > 0.2) {
    const double before = most;
    const Lids from = best;
    const auto consider = [&](const Lids& lids) {
      const double value = own(lids);
      if (value > most) most = value, best = lids;
    };
    for (const double d : {-step, step}) {
      consider({{from.inner.x + d, from.inner.y}, from.outer, from.upper, from.lower});
      consider({{from.inner.x, from.inner.y + d}, from.outer, from.upper - d / 2, from.lower + d / 2});
      consider({from.inner, {from.outer.x + d, from.outer.y}, from.upper, from.lower});
      consider({from.inner, {from.outer.x, from.outer.y + d}, from.upper - d / 2, from.lower + d / 2});
      consider({{from.inner.x, from.inner.y + d}, {from.outer.x, from.outer.y + d}, from.upper, from.lower});
      consider({from.inner, from.outer, from.upper + d, from.lower});
      consider({from.inner, from.outer, from.upper, from.lower + d});
    }
    if (most <= before) step /= 2;
  }
  return best;
}

// Both eyes near the almond that is best for both.
struct Eyes {
  std::array<std::optional<Lids>, 2> lids;  // columns away from the nose
  double contrast = 0;                      // of the one that has more
};
Eyes eyes_near(const std::array<Window, 2>& windows, const Lids& common, Arena& scratch) {
  Eyes eyes;
  for (std::size_t i = 0; i < 2; ++i) {
    if (windows[i].below.empty()) continue;
    const Lids lids = refine(windows[i], common);
    const double contrast = eye_contrast(windows[i], lids, scratch);
    if (contrast > 0) eyes.lids[i] = lids;
    eyes.contrast = std::max(eyes.contrast, contrast);
  }
  return eyes;
}

}  // namespace

std::array<std::optional<Lids>, 2> find_lids(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                                             const RectifiedPair& pair, StageContext& context) {
  Arena& scratch = context.scratch;
  const Arena::Mark mark(scratch);
  const double reach = kPupilMm + kHalfWidthMm + kReliefMm;
  FaceRelief relief({-reach, reach, kUpMm - kHalfHeightMm - 1, kUpMm + kHalfHeightMm + 1, kReliefMm},
                    &scratch);
  relief.add(mesh, head_from_camera, true);
  relief.smooth(kSmoothMm, &scratch);
  const RigidTransform camera_from_head = inverse(head_from_camera);
  std::array<Window, 2> windows{Window(&scratch), Window(&scratch)};
  Window both(&scratch);
  for (std::size_t i = 0; i < 2; ++i) {
    Window& w = windows[i];
    sample(w, relief, camera_from_head, pair, i == 0 ? -1 : 1);
    if (!tell_skin(w, scratch)) continue;
    both.below.resize(w.below.size(), 0);
    for (std::size_t k = 0; k < w.below.size(); ++k) both.below[k] += w.below[k] / 2;
  }
  if (both.below.empty()) return {};
  const Lids best = search(both, kHighestMm, context.pool);
  Eyes eyes = eyes_near(windows, best, scratch);
  // Grey brows are less red than skin, too, and lie over another eye; below an eye nothing looks like one.
  const int below_mm = int(std::floor(middle_mm(best) - best.lower - kUpperMm - kUpMm));
  if (below_mm >= kLowestMm) {
    const Eyes lower = eyes_near(windows, search(both, below_mm, context.pool), scratch);
    const bool apart = std::ranges::all_of(lower.lids, [&](const std::optional<Lids>& eye) {
      return !eye || middle_mm(*eye) + eye->upper < middle_mm(best) - best.lower;
    });
    if (apart && lower.contrast > eyes.contrast) eyes = lower;
  }
  if (auto& right = eyes.lids[0]) right->inner.x *= -1, right->outer.x *= -1;
  return eyes.lids;
}

}  // namespace relievo::pipeline
