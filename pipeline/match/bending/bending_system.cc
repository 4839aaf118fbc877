// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/bending/bending_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hal/base/simd.h"
#include "pipeline/match/image/plane_filters.h"

namespace relievo::pipeline {
namespace {

constexpr int kWeightBands = 16;
constexpr int kPatch = 8;  // radius, nodes
constexpr float kPatchNodes = (2 * kPatch + 1) * (2 * kPatch + 1);

struct Bends {
  float squared = 0;                               // of all second differences
  bool row = false, column = false, cell = false;  // which of them have their neighbours
};

Bends bends_at(const Plane<float>& d, const Plane<std::uint8_t>& domain, int x, int y) {
  const int w = d.width;
  const int h = d.height;
  Bends bends;
  if (domain.row(y)[x] == 0 || x == 0 || y == 0 || x == w - 1 || y == h - 1) return bends;
  const float here = d.row(y)[x];
  const auto in = [&](int i, int j) { return domain.row(y + j)[x + i] != 0; };
  const auto at = [&](int i, int j) { return d.row(y + j)[x + i]; };
  bends.row = in(-1, 0) && in(1, 0);
  bends.column = in(0, -1) && in(0, 1);
  bends.cell = in(1, 0) && in(0, 1) && in(1, 1) && x + 1 < w - 1 && y + 1 < h - 1;
  const float xx = bends.row ? at(-1, 0) - 2 * here + at(1, 0) : 0;
  const float yy = bends.column ? at(0, -1) - 2 * here + at(0, 1) : 0;
  const float xy = bends.cell ? here - at(1, 0) - at(0, 1) + at(1, 1) : 0;
  bends.squared = xx * xx + yy * yy + 2 * xy * xy;
  return bends;
}

void measure_wrinkles(const Plane<float>& d, const Plane<std::uint8_t>& domain, double wrinkle,
                      ThreadPool& pool, Plane<float>& across, Plane<float>& wrinkled) {
  if (!(wrinkle > 0)) return std::fill(wrinkled.values.begin(), wrinkled.values.end(), 0.0F);
  const auto wrinkle2 = float(1 / (wrinkle * wrinkle));
  pool.for_each(d.height, kWeightBands, [&](int y) {
    for (int x = 0; x < d.width; ++x)
      wrinkled.row(y)[x] = std::min(kSharpest, wrinkle2 * bends_at(d, domain, x, y).squared) / kPatchNodes;
  });
  box_sum(wrinkled, kPatch, pool, across, wrinkled);
  for (float& value : wrinkled.values) value = std::clamp(value - kPlain, 0.0F, kMostWrinkled);
}

constexpr int kSumBands = 8;  // fixed, so that sums do not depend on the number of threads

ColumnSpan join(const ColumnSpan& a, const ColumnSpan& b) {
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

// What of every row may differ from 0: a face is no rectangle, and this work is bound by memory.
// `out`: where a row's result may; `bent`: where its second differences are asked for by the rows around it.
struct Spans {
  Spans(const BendingSystem& s, std::pmr::memory_resource* memory)
      : out(std::size_t(s.height()), memory), bent(std::size_t(s.height()), memory) {
    const int w = s.width();
    const int h = s.height();
    std::pmr::vector<ColumnSpan> weights(std::size_t(h), ColumnSpan{w, 0}, memory);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        if (s.data.row(y)[x] == 0 && s.bend_xx.row(y)[x] == 0 && s.bend_yy.row(y)[x] == 0 &&
            s.bend_xy.row(y)[x] == 0)
          continue;
        weights[std::size_t(y)] = join(weights[std::size_t(y)], {x, x + 1});
      }
    widen(weights, 2, w, out);
    widen(out, 1, w, bent);
  }
  std::pmr::vector<ColumnSpan> out, bent;

 private:
  static void widen(const std::pmr::vector<ColumnSpan>& from, int by, int w,
                    std::pmr::vector<ColumnSpan>& to) {
    const int h = int(from.size());
    for (int y = 0; y < h; ++y) {
      ColumnSpan all{w, 0};
      for (int k = std::max(0, y - by); k <= std::min(h - 1, y + by); ++k)
        all = join(all, from[std::size_t(k)]);
      to[std::size_t(y)] = all.begin < all.end
                               ? ColumnSpan{std::max(0, all.begin - by), std::min(w, all.end + by)}
                               : ColumnSpan{0, 0};
    }
  }
};

RELIEVO_SIMD void bend_rows(const float* above, const float* here, const float* below, const float* wxx,
                            const float* wyy, const float* wxy, int w, ColumnSpan span, float* qxx,
                            float* qyy, float* qxy) {
  const int end = std::min(span.end, w - 1);
  for (int x = std::max(span.begin, 1); x < end; ++x) {
    qxx[x] = wxx[x] * (here[x - 1] - 2 * here[x] + here[x + 1]);
    qyy[x] = wyy[x] * (above[x] - 2 * here[x] + below[x]);
    qxy[x] = wxy[x] * (here[x] - here[x + 1] - below[x] + below[x + 1]);
  }
  qxx[0] = qxx[w - 1] = qyy[0] = qyy[w - 1] = qxy[w - 1] = 0;
  qxy[0] = wxy[0] * (here[0] - here[1] - below[0] + below[1]);
}

RELIEVO_SIMD void gather_rows(const float* a, const float* x_row, const float* qxx, const float* qyy_above,
                              const float* qyy, const float* qyy_below, const float* qxy_above,
                              const float* qxy, int w, ColumnSpan span, float* out) {
  const int end = std::min(span.end, w - 1);
  for (int x = std::max(span.begin, 1); x < end; ++x)
    out[x] = a[x] * x_row[x] + qxx[x - 1] - 2 * qxx[x] + qxx[x + 1] + qyy_above[x] - 2 * qyy[x] +
             qyy_below[x] + qxy[x] - qxy[x - 1] - qxy_above[x] + qxy_above[x - 1];
  out[0] = out[w - 1] = 0;
}

RELIEVO_SIMD double dot_row(const float* a, const float* b, ColumnSpan span) {
  // Eight running sums: the order is fixed, and the compiler may still use wide registers.
  float sums[8] = {};
  int x = span.begin;
  for (; x + 8 <= span.end; x += 8)
    for (int k = 0; k < 8; ++k) sums[k] += a[x + k] * b[x + k];
  double sum = 0;
  for (; x < span.end; ++x) sum += double(a[x]) * b[x];
  for (const float s : sums) sum += s;
  return sum;
}

RELIEVO_SIMD void follow_row(const float* z, float beta, float* p, ColumnSpan span) {
  for (int x = span.begin; x < span.end; ++x) p[x] = z[x] + beta * p[x];
}

RELIEVO_SIMD void step_row(const float* p, const float* ap, float alpha, ColumnSpan span, float* x,
                           float* r) {
  for (int i = span.begin; i < span.end; ++i) {
    x[i] += alpha * p[i];
    r[i] -= alpha * ap[i];
  }
}

// `rows` works rows [begin, end) and says their part of the sum.
template <typename Rows>
double sum_over_bands(ThreadPool& pool, int height, Rows&& rows) {
  std::array<double, kSumBands> parts{};
  pool.for_each_band(height, kSumBands,
                     [&](int begin, int end, int band) { parts[std::size_t(band)] = rows(begin, end); });
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

void apply_rows(const BendingSystem& s, const Plane<float>& x, bool with_data, Plane<float>& out, int begin,
                int end, float* rolling, const Spans* spans) {
  const int w = s.width();
  const int h = s.height();
  const auto count = std::size_t(w);
  // Three rows of weighted second differences roll along with the row being written.
  float* zero = rolling + 9 * count;
  std::fill(zero, zero + count, 0.0F);
  const auto slot = [&](int y, int kind) {
    return rolling + (std::size_t((y + 3) % 3) * 3 + std::size_t(kind)) * count;
  };
  const auto bend = [&](int y) {
    float* q[3] = {slot(y, 0), slot(y, 1), slot(y, 2)};
    if (y < 1 || y >= h - 1) {
      for (float* row : q) std::fill(row, row + count, 0.0F);
      if (y != 0) return;  // the cells of the first row still count
      for (int i = 0; i + 1 < w; ++i)
        q[2][i] = s.bend_xy.row(0)[i] * (x.row(0)[i] - x.row(0)[i + 1] - x.row(1)[i] + x.row(1)[i + 1]);
      return;
    }
    bend_rows(x.row(y - 1), x.row(y), x.row(y + 1), s.bend_xx.row(y), s.bend_yy.row(y), s.bend_xy.row(y), w,
              spans != nullptr ? spans->bent[std::size_t(y)] : ColumnSpan{0, w}, q[0], q[1], q[2]);
  };
  const int first = begin < 1 ? 1 : begin;
  const int last = end > h - 1 ? h - 1 : end;
  bend(first - 1);
  bend(first);
  for (int y = first; y < last; ++y) {
    bend(y + 1);
    gather_rows(with_data ? s.data.row(y) : zero, x.row(y), slot(y, 0), slot(y - 1, 1), slot(y, 1),
                slot(y + 1, 1), slot(y - 1, 2), slot(y, 2), w,
                spans != nullptr ? spans->out[std::size_t(y)] : ColumnSpan{0, w}, out.row(y));
  }
}

}  // namespace

void weigh_bending(const Plane<float>& d, const Plane<std::uint8_t>& domain,
                   const BendingExpectation& expected, const Folds& folds, ThreadPool& pool,
                   Plane<float>& across, Plane<float>& wrinkled, BendingSystem& system) {
  measure_wrinkles(d, domain, expected.wrinkle, pool, across, wrinkled);
  const auto lambda = float(expected.lambda);
  const auto crease2 = float(1 / (expected.crease * expected.crease));
  pool.for_each(d.height, kWeightBands, [&](int y) {
    for (int x = 0; x < d.width; ++x) {
      const Bends bends = bends_at(d, domain, x, y);
      const float bent = 1 + bends.squared * crease2 + wrinkled.row(y)[x];
      const float xx = lambda / (bent + kFolded / 255 * float(folds.xx.row(y)[x]));
      const float yy = lambda / (bent + kFolded / 255 * float(folds.yy.row(y)[x]));
      system.bend_xx.row(y)[x] = bends.row ? xx : 0;
      system.bend_yy.row(y)[x] = bends.column ? yy : 0;
      system.bend_xy.row(y)[x] = bends.cell ? 2 * std::sqrt(xx * yy) : 0;
    }
  });
}

void apply_system(const BendingSystem& s, const Plane<float>& x, bool with_data, Plane<float>& out, int begin,
                  int end, float* rolling) {
  apply_rows(s, x, with_data, out, begin, end, rolling, nullptr);
}

void solve(const BendingSystem& s, int steps, double tolerance, ThreadPool& pool,
           std::pmr::memory_resource& scratch, Plane<float>& x) {
  const int w = s.width();
  const int h = s.height();
  Plane<float> r(&scratch, w, h);
  Plane<float> z(&scratch, w, h);
  Plane<float> p(&scratch, w, h);
  Plane<float> ap(&scratch, w, h);
  Plane<float> rolling(&scratch, rolling_floats(w), kSumBands);
  const Spans spans(s, &scratch);
  const auto span = [&spans](int y) { return spans.out[std::size_t(y)]; };
  MultilevelPreconditioner preconditioner(s, pool, &scratch);
  std::ranges::fill(x.values, 0.0F);
  r.values = s.rhs.values;
  const auto band_of = [h](int begin) { return int((static_cast<long>(begin) * kSumBands + h - 1) / h); };
  const auto each = [&](auto&& rows) { return sum_over_bands(pool, h, rows); };
  const auto precondition = [&] {
    preconditioner.apply(r, spans.out, z);
    return each([&](int begin, int end) {
      double sum = 0;
      for (int y = begin; y < end; ++y) sum += dot_row(r.row(y), z.row(y), span(y));
      return sum;
    });
  };
  double rz = precondition();
  const double start = rz;
  double beta = 0;
  for (int k = 0; k < steps && rz > tolerance * start; ++k) {
    each([&](int begin, int end) {
      for (int y = begin; y < end; ++y) follow_row(z.row(y), float(beta), p.row(y), span(y));
      return 0.0;
    });
    const double pap = each([&](int begin, int end) {
      apply_rows(s, p, true, ap, begin, end, rolling.row(band_of(begin)), &spans);
      double sum = 0;
      for (int y = begin; y < end; ++y) sum += dot_row(p.row(y), ap.row(y), span(y));
      return sum;
    });
    if (!(pap > 0)) break;
    const auto alpha = float(rz / pap);
    each([&](int begin, int end) {
      for (int y = begin; y < end; ++y) step_row(p.row(y), ap.row(y), alpha, span(y), x.row(y), r.row(y));
      return 0.0;
    });
    const double next = precondition();
    beta = next / rz;
    rz = next;
  }
}

}  // namespace relievo::pipeline
