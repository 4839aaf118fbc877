// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/surface_refiner.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr int kBlockRadius = 3;  // nodes: about the reach of the fit on skin
constexpr int kBlock = 2 * kBlockRadius + 1;
constexpr int kMeanRadius = 6;  // over which the blocks' variance is taken

// What independent residuals leave of their own variance in the sum of a block, after the fit: it answers
// to waves longer than 1 / reach, reach = (data / bending)^(1/4) a node. The ratio of the integrals of
// B^2 H^2 and B^2, B the block's and H = L / (reach^4 + L) the remainder's transfer function, L that of
// the squared second differences; within 3 % from 0.1 to 0.8.
float left_by_the_fit(float reach) { return 1 / (1 + std::pow(3.05F * reach, 1.95F)); }

constexpr float kLeastExcess = 0.5F;  // calmer by more is chance. Cut off at 1, the mean would be too large.

// Of what bends differently along x and y the integral is that of the geometric mean. At a rim one is
// missing.
float bend_of(float xx, float yy) { return xx > 0 && yy > 0 ? std::sqrt(xx * yy) : xx; }

}  // namespace

void measure_score_excess(const BendingSystem& system, const Plane<float>& pull, const Plane<float>& real,
                          int step, ThreadPool& pool, std::pmr::memory_resource& scratch,
                          Plane<float>& excess) {
  const int w = system.width();
  const int h = system.height();
  Plane<float> across(&scratch, w, h), told(&scratch, w, h), answers(&scratch, w, h), bend(&scratch, w, h);
  box_sum(pull, kBlockRadius, pool, across, excess);
  for (float& v : excess.values) v *= v;
  box_sum(excess, kMeanRadius, pool, across, excess);
  box_sum(system.data, kBlockRadius, pool, across, told);
  box_sum(told, kMeanRadius, pool, across, told);
  box_sum(real, kBlockRadius, pool, across, answers);
  box_sum(answers, kMeanRadius, pool, across, answers);
  for (std::size_t k = 0; k < bend.values.size(); ++k)
    bend.values[k] = bend_of(system.bend_xx.values[k], system.bend_yy.values[k]);
  box_sum(bend, kMeanRadius, pool, across, bend);
  constexpr float kCells = kBlock * kBlock;
  // Tents overlap by half: a block of them counts the pixels along its edges in part.
  const float along = step == 1 ? 1.0F : (2.0F * kBlock - 0.5F) / (2.0F * kBlock), share = along * along;
  for (std::size_t k = 0; k < excess.values.size(); ++k) {
    if (!(told.values[k] > 0 && bend.values[k] > 0)) {
      excess.values[k] = 1;
      continue;
    }
    const float reach = std::sqrt(
        std::sqrt(std::max(answers.values[k], kLeastReal * told.values[k]) / kCells / bend.values[k]));
    const float expected = told.values[k] * share * left_by_the_fit(reach);
    excess.values[k] = std::max(kLeastExcess, excess.values[k] / expected);
  }
}

namespace {

constexpr float kLoud = 12;   // grey levels: more is no noise, and a few such pixels would drown it
constexpr int kFurthest = 2;  // shift in pixels over which hanging noise is looked for

// Mean products of residuals, and of gradients, with themselves some pixels further; 0 where none meet.
struct Alike {
  double residual = 0, gradient = 0;
};

Alike likeness(const WarpTerms& terms, int dx, int dy) {
  constexpr int kEvery = 3;  // rows looked at
  const int w = terms.residual.width;
  Alike sum;
  double count = 0;
  const auto calm = [](float v) { return double(std::clamp(v, -kLoud, kLoud)); };
  for (int y = 0; y + dy < terms.residual.height; y += kEvery) {
    const float* in = terms.mask.row(y);
    const float* in_too = terms.mask.row(y + dy) + dx;
    const float *r = terms.residual.row(y), *r_too = terms.residual.row(y + dy) + dx;
    const float *g = terms.gradient.row(y), *g_too = terms.gradient.row(y + dy) + dx;
    for (int x = kFurthest; x < w - kFurthest; ++x) {
      if (in[x] == 0 || in_too[x] == 0) continue;
      sum.residual += calm(r[x]) * calm(r_too[x]);
      sum.gradient += calm(g[x]) * calm(g_too[x]);
      count += 1;
    }
  }
  return count > 0 ? Alike{sum.residual / count, sum.gradient / count} : Alike{};
}

}  // namespace

float hanging_noise(const WarpTerms& terms, ThreadPool& pool) {
  constexpr float kWhite = 1.6F;  // of pictures with white noise: by warping and the skin's own detail
  constexpr float kMost = 6;
  // A shift and its opposite say the same: half of them, after none at all.
  constexpr int kShifts = kFurthest * (2 * kFurthest + 2) + 1;
  std::array<Alike, kShifts> alike;
  pool.for_each(kShifts, kShifts, [&](int k) {
    const int side = 2 * kFurthest + 1;
    const int dy = (k + kFurthest) / side;
    alike[std::size_t(k)] = likeness(terms, (k + kFurthest) % side - kFurthest, dy);
  });
  const Alike& same = alike[0];
  if (!(same.residual > 0 && same.gradient > 0)) return 1;
  double sum = 1;
  for (std::size_t k = 1; k < alike.size(); ++k)
    sum += 2 * (alike[k].residual / same.residual) * (alike[k].gradient / same.gradient);
  return std::clamp(float(sum) / kWhite, 1.0F, kMost);
}

namespace {

constexpr int kRefinedBands = 16;
constexpr int kFarLevel = 2;
// Of the squared residual: the next warp solves what is left anew. A tenth of this changes no figure.
constexpr double kSolved = 1e-3;
constexpr int kNoiseStep = 1;  // when the fit is close enough for its residuals to be noise

// The node window that holds the domain with a margin, and the pixel window below it.
struct Extent {
  Window nodes;
  Window pixels;
};

Extent extent_of(const SurfaceField& field, const RefinerScene& scene) {
  int x0 = field.domain.width, y0 = field.domain.height, x1 = -1, y1 = -1;
  for (int y = 0; y < field.domain.height; ++y)
    for (int x = 0; x < field.domain.width; ++x) {
      if (field.domain.row(y)[x] == 0) continue;
      x0 = std::min(x0, x);
      x1 = std::max(x1, x);
      y0 = std::min(y0, y);
      y1 = std::max(y1, y);
    }
  if (x1 < 0) return {};
  x0 = std::max(0, x0 - 2);
  y0 = std::max(0, y0 - 2);
  x1 = std::min(field.domain.width - 1, x1 + 2);
  y1 = std::min(field.domain.height - 1, y1 + 2);
  const int step = field.step_px >> scene.level;
  Extent extent;
  extent.nodes = {x0, y0, x1 - x0 + 1, y1 - y0 + 1};
  extent.pixels = {x0 * step, y0 * step, std::min(extent.nodes.width * step, scene.left.width - x0 * step),
                   std::min(extent.nodes.height * step, scene.left.height - y0 * step)};
  return extent;
}

struct Work {
  PlaneShape shape;
  BendingSystem system{shape.memory, shape.width, shape.height};
  Plane<float> pull{shape};    // weight * gradient * residual, gathered
  Plane<float> agreed{shape};  // weight * agreed, gathered by judge()
  Plane<float> d{shape}, delta{shape}, wrinkled{shape};
  Plane<std::uint8_t> domain{shape};
};

// Adds what every pixel says to the nodes around it.
void gather_data(const WarpTerms& terms, const SigmaTerms* for_sigma, int step, Work& work,
                 ThreadPool& pool) {
  BendingSystem& system = work.system;
  pool.for_each(system.height(), kRefinedBands, [&](int j) {
    for (int i = 0; i < system.width(); ++i) {
      float a = 0;
      float b = 0;
      float real = 0;
      for (int dy = 1 - step; dy < step; ++dy)
        for (int dx = 1 - step; dx < step; ++dx) {
          const int x = i * step + dx;
          const int y = j * step + dy;
          if (x < 0 || y < 0 || x >= terms.weight.width || y >= terms.weight.height) continue;
          const float tent = (dx == 0 ? 1.0F : 0.5F) * (dy == 0 ? 1.0F : 0.5F);
          const float wg = tent * terms.weight.row(y)[x] * terms.gradient.row(y)[x];
          a += wg * terms.gradient.row(y)[x];
          b += wg * terms.residual.row(y)[x];
          if (for_sigma != nullptr) real += tent * terms.weight.row(y)[x] * for_sigma->agreed.row(y)[x];
        }
      system.data.row(j)[i] = a;
      work.pull.row(j)[i] = b;
      work.agreed.row(j)[i] = real;
    }
  });
}

// The prior expects bends of every length alike; of skin the short ones are less (relief and pores apart, it
// is smooth), so that the less far the fit reaches down, the more the posterior overstates. Errors of
// rendered heads of two makers, from half the contrast to twice and up to twice the noise, come to this share
// of it for a reach of a node, and go with its fourth root. Where hardly anything is seen the prior is all
// there is, and it is believed.
constexpr float kShareAtANode = 1.2F;
constexpr float kShareOfReach = 0.25F;
constexpr float kLeastReach = 0.15F;

// sigma of a node: the square root of the integral over the plane of
//   (A + lambda k^4) / (a + lambda k^4)^2
// with A the information that the gradients seem to carry, noise included, and a what both views' gradients
// agree on, without noise: the fit answers to a, yet is shaken by A. reach = (a / lambda)^(1/4) a node.
float posterior_sigma(double seeming, double agreed, double bend) {
  const double real = std::clamp(agreed, double(kLeastReal) * seeming, seeming);
  const double variance = 1 / (8 * std::sqrt(real * bend)) * (1 + (seeming - real) / (2 * real));
  const float reach = std::sqrt(std::sqrt(float(real / bend)));
  return kShareAtANode * std::pow(std::max(reach, kLeastReach), kShareOfReach) * float(std::sqrt(variance));
}

}  // namespace

void misread_px(const Plane<float>& in, ThreadPool& pool, std::pmr::memory_resource& scratch,
                Plane<float>& ratio) {
  constexpr int kRadius = 3;       // nodes
  constexpr float kPxAShare = 15;  // of simulated people in full and half size
  const PlaneShape shape{&scratch, ratio.width, ratio.height};
  Plane<float> count(shape), squares(shape), across(shape);
  double all = 0;
  double known = 1e-6;
  for (std::size_t k = 0; k < ratio.values.size(); ++k) {
    all += in.values[k] != 0 ? double(ratio.values[k]) : 0.0;
    known += double(in.values[k]);
  }
  // About the mean: what is squared is small then.
  const auto mean = float(all / known);
  for (std::size_t k = 0; k < ratio.values.size(); ++k) {
    ratio.values[k] = in.values[k] != 0 ? ratio.values[k] - mean : 0.0F;
    squares.values[k] = ratio.values[k] * ratio.values[k];
  }
  box_sum(in, kRadius, pool, across, count);
  box_sum(squares, kRadius, pool, across, squares);
  box_sum(ratio, kRadius, pool, across, ratio);
  for (std::size_t k = 0; k < ratio.values.size(); ++k) {
    const float n = 1 / std::max(count.values[k], 1.0F);
    const float here = ratio.values[k] * n;
    const float variance = std::max(squares.values[k] * n - here * here, 0.0F);
    ratio.values[k] = kPxAShare * std::sqrt(variance) / std::max(mean + here, 0.1F);
  }
}

namespace {

// sigma and cost of every node.
void judge(const WarpTerms& terms, const SigmaTerms& for_sigma, int step, double lambda, const Window& nodes,
           const Work& work, std::pmr::memory_resource& scratch, ThreadPool& pool, SurfaceField& field) {
  Plane<float> mean(&scratch, nodes.width, nodes.height);
  Plane<float> noise(&scratch, nodes.width, nodes.height);
  Plane<float> area(&scratch, nodes.width, nodes.height);
  Plane<float> across(&scratch, nodes.width, nodes.height);
  Plane<float> excess(&scratch, nodes.width, nodes.height);
  measure_score_excess(work.system, work.pull, work.agreed, step, pool, scratch, excess);
  const auto pixel = [&](int x, int y) {
    return std::size_t(std::min(y * step, terms.cost.height - 1)) * std::size_t(terms.cost.width) +
           std::size_t(std::min(x * step, terms.cost.width - 1));
  };
  Plane<float> misread(&scratch, nodes.width, nodes.height);
  for (int y = 0; y < nodes.height; ++y)
    for (int x = 0; x < nodes.width; ++x) {
      area.row(y)[x] = work.domain.row(y)[x] != 0 ? terms.mask.values[pixel(x, y)] : 0.0F;
      misread.row(y)[x] = for_sigma.ratio.values[pixel(x, y)];
    }
  misread_px(area, pool, scratch, misread);
  constexpr int kRadius = 6;  // about the reach of one pixel's influence on skin
  constexpr double kCells = (2 * kRadius + 1) * (2 * kRadius + 1);
  box_sum(work.system.data, kRadius, pool, across, mean);
  // What is not agreed on is noise, alike on all patches of skin: a wide mean knows it best.
  constexpr int kNoiseRadius = 12;
  for (std::size_t k = 0; k < noise.values.size(); ++k)
    noise.values[k] = work.system.data.values[k] - work.agreed.values[k];
  box_sum(noise, kNoiseRadius, pool, across, noise);
  for (std::size_t k = 0; k < area.values.size(); ++k)
    area.values[k] = work.system.data.values[k] > 0 ? 1 : 0;
  box_sum(area, kNoiseRadius, pool, across, area);
  for (int y = 1; y < nodes.height - 1; ++y)
    for (int x = 1; x < nodes.width - 1; ++x) {
      if (work.domain.row(y)[x] == 0) continue;
      const double seeming = std::max(double(mean.row(y)[x]) / kCells, 1e-6);
      const double real = seeming - double(noise.row(y)[x] / std::max(area.row(y)[x], 1.0F));
      const float bend = bend_of(work.system.bend_xx.row(y)[x], work.system.bend_yy.row(y)[x]);
      const float fit = posterior_sigma(seeming, real, bend > 0 ? double(bend) : lambda * 0.1) *
                        std::sqrt(excess.row(y)[x]);
      field.sigma_px.row(nodes.y0 + y)[nodes.x0 + x] = std::hypot(fit, misread.row(y)[x]);
      field.cost.row(nodes.y0 + y)[nodes.x0 + x] = terms.cost.values[pixel(x, y)];
    }
}

}  // namespace

Result<void> refine_surface(const RefinerScene& scene, const SurfaceRefinerOptions& options,
                            StageContext& context, SurfaceField& field) {
  const Extent extent = extent_of(field, scene);
  if (extent.nodes.width < 5 || extent.nodes.height < 5) return {};
  const Window& nodes = extent.nodes;
  const int step = field.step_px >> scene.level;
  const double spacing = field.step_px;
  // Squared second differences over nodes `spacing` apart, one node a spacing^2 of full-size pixels.
  const double lambda = scene.lambda_px / (spacing * spacing);
  const double expected_bend = 1 / std::sqrt(lambda);
  // Only the finest size can tell relief from what a smaller one blurs together.
  const BendingExpectation expected{lambda, options.crease * expected_bend,
                                    scene.level == 0 ? options.wrinkle * expected_bend : 0};
  // Steps are cheap at the smallest size, and what starts far off needs them; in between it is done soonest.
  const int fewer = std::max(1, options.steps - 1);
  const int steps = scene.level == 0 ? options.steps : scene.level >= kFarLevel ? 2 * fewer : fewer;
  Arena::Mark whole(context.scratch);
  Folds folds(&context.scratch, nodes.width, nodes.height);
  if (scene.level == 0) find_dark_lines(scene, nodes, step, context, folds);
  float hanging = 1;
  for (int k = 0; k < steps; ++k) {
    if (context.stop()) return stopped();
    Arena::Mark mark(context.scratch);
    Work work{{&context.scratch, nodes.width, nodes.height}};
    for (int y = 0; y < nodes.height; ++y)
      for (int x = 0; x < nodes.width; ++x) {
        const bool border = x == 0 || y == 0 || x == nodes.width - 1 || y == nodes.height - 1;
        work.d.row(y)[x] = field.disparity_px.row(nodes.y0 + y)[nodes.x0 + x];
        work.domain.row(y)[x] = border ? std::uint8_t{0} : field.domain.row(nodes.y0 + y)[nodes.x0 + x];
      }
    WarpTerms terms(&context.scratch, extent.pixels.width, extent.pixels.height);
    const bool last = k == steps - 1;
    SigmaTerms for_sigma({&context.scratch, last ? extent.pixels.width : 0, last ? extent.pixels.height : 0});
    form_terms(scene, options, field, extent.pixels, context, terms, last ? &for_sigma : nullptr);
    gather_data(terms, last ? &for_sigma : nullptr, step, work, context.pool);
    weigh_bending(work.d, work.domain, expected, folds, context.pool, work.delta, work.wrinkled, work.system);
    if (scene.level == 0 && k == kNoiseStep) hanging = hanging_noise(terms, context.pool);
    for (std::size_t n = 0; n < work.domain.values.size(); ++n) {
      const float share = work.domain.values[n] != 0 ? 1 / hanging : 0;
      for (Plane<float>* said : {&work.system.data, &work.pull, &work.agreed}) said->values[n] *= share;
    }
    Plane<float> rolling(&context.scratch, rolling_floats(nodes.width), 1);
    apply_system(work.system, work.d, false, work.system.rhs, 0, nodes.height, rolling.row(0));
    for (std::size_t n = 0; n < work.pull.values.size(); ++n)
      work.system.rhs.values[n] =
          work.domain.values[n] != 0 ? -work.pull.values[n] - work.system.rhs.values[n] : 0.0F;
    {
      Arena::Mark solving(context.scratch);
      solve(work.system, options.solver_steps, kSolved, context.pool, context.scratch, work.delta);
    }
    const float limit = 1.0F * float(1 << scene.level);  // the linear model holds for about a pixel
    for (int y = 1; y < nodes.height - 1; ++y)
      for (int x = 1; x < nodes.width - 1; ++x)
        if (work.domain.row(y)[x] != 0)
          field.disparity_px.row(nodes.y0 + y)[nodes.x0 + x] +=
              std::clamp(work.delta.row(y)[x], -limit, limit);
    if (last) judge(terms, for_sigma, step, lambda, nodes, work, context.scratch, context.pool, field);
  }
  return {};
}

}  // namespace relievo::pipeline
