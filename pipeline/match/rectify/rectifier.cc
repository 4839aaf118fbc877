// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/rectify/rectifier.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/base/simd.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

struct Box {
  double left = 1e30, top = 1e30, right = -1e30, bottom = -1e30;
  void include(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
};

// The picture's border, seen in the rectified view with the centre at zero.
Box border_box(const CameraIntrinsics& camera, const Rotation& rectified_from_camera, double focal_px) {
  Box box;
  constexpr int kSteps = 32;
  for (int i = 0; i <= kSteps; ++i)
    for (int side = 0; side < 4; ++side) {
      const double t = double(i) / kSteps;
      const double w = camera.width_px - 1.0;
      const double h = camera.height_px - 1.0;
      const Vec2d pixel = side == 0   ? Vec2d{t * w, 0}
                          : side == 1 ? Vec2d{t * w, h}
                          : side == 2 ? Vec2d{0, t * h}
                                      : Vec2d{w, t * h};
      const Vec2d ideal = ray_of_pixel(camera, pixel);
      const Vec3d ray = apply(rectified_from_camera, {ideal.x, ideal.y, 1});
      if (ray.z < 0.2) continue;  // beyond 78 degrees: lay_windows refuses by size
      box.include(focal_px * ray.x / ray.z, focal_px * ray.y / ray.z);
    }
  return box;
}

// The map is exact at every 16th column and row and linear between: with the mild distortion of real
// lenses that is within a thousandth of a pixel, and five times cheaper.
constexpr int kKnotPx = 16;

// Where the pixels between two knots come from, kKnotPx of them at once so that the weights need no branches.
struct Span {
  std::array<int, kKnotPx> x, y;      // the pixel to the upper left
  std::array<float, kKnotPx> tx, ty;  // how far beyond it
  std::array<float, kKnotPx> grey;
};

// Cubic convolution (Keys 1981, a = -1/2).
inline float cubic(const float* p, const float* w) {
  return w[0] * p[0] + w[1] * p[1] + w[2] * p[2] + w[3] * p[3];
}
inline void cubic_weights(float t, float* w) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  w[0] = -0.5F * t3 + t2 - 0.5F * t;
  w[1] = 1.5F * t3 - 2.5F * t2 + 1;
  w[2] = -1.5F * t3 + 2 * t2 + 0.5F * t;
  w[3] = 0.5F * t3 - 0.5F * t2;
}

RELIEVO_SIMD void sample_grey(const float* grey, int stride, int count, Span& span) {
  for (int i = 0; i < count; ++i) {
    const auto at = std::size_t(i);
    float wx[4];
    float wy[4];
    cubic_weights(span.tx[at], wx);
    cubic_weights(span.ty[at], wy);
    const float* p = grey + std::ptrdiff_t(span.y[at] - 1) * stride + span.x[at] - 1;
    span.grey[at] = wy[0] * cubic(p, wx) + wy[1] * cubic(p + stride, wx) + wy[2] * cubic(p + 2 * stride, wx) +
                    wy[3] * cubic(p + 3 * stride, wx);
  }
}

void sample_rgb(const ImageView& image, int ix, int iy, float tx, float ty, std::uint8_t* to) {
  const std::uint8_t* upper = image.row(iy);
  const std::uint8_t* lower = image.row(iy + 1);
  if (image.format != PixelFormat::Rgb8) {
    const int step = bytes_per_pixel(image.format);
    const int high = step - 1;  // the upper byte of a little-endian 16 bit value
    to[0] = to[1] = to[2] = upper[(ix + (tx >= 0.5F ? 1 : 0)) * step + high];
    return;
  }
  for (int c = 0; c < 3; ++c) {
    const auto a = float(upper[3 * ix + c]);
    const auto b = float(upper[3 * ix + 3 + c]);
    const auto d = float(lower[3 * ix + c]);
    const auto e = float(lower[3 * ix + 3 + c]);
    const float top = a + tx * (b - a);
    to[c] = std::uint8_t(top + ty * (d + tx * (e - d) - top) +
                         0.5F);  // NOLINT(bugprone-incorrect-roundings): never negative
  }
}

struct ViewGeometry {
  const CameraIntrinsics& camera;
  const Rotation& rectified_from_camera;
  Vec2d centre_px;
};

// One row of one view.
void resample(const RectifiedPair& pair, const ViewGeometry& geometry, const ImageView& image,
              const Plane<float>& grey, RectifiedView& view, int y) {
  const int width = pair.width_px;
  const auto knot = [&](int x, int row) {
    return source_pixel(geometry.camera, geometry.rectified_from_camera, pair.focal_px, geometry.centre_px,
                        {double(x), double(row)});
  };
  Span span{};
  const int y0 = y / kKnotPx * kKnotPx;
  const double ty = double(y - y0) / kKnotPx;
  const auto edge = [&](int x) {
    const Vec2d a = knot(x, y0);
    const Vec2d b = knot(x, y0 + kKnotPx);
    return Vec2d{a.x + ty * (b.x - a.x), a.y + ty * (b.y - a.y)};
  };
  Vec2d from = edge(0);
  for (int x0 = 0; x0 < width; x0 += kKnotPx) {
    const Vec2d to = edge(x0 + kKnotPx);
    const double dx = (to.x - from.x) / kKnotPx;
    const double dy = (to.y - from.y) / kKnotPx;
    // The source runs along a line, so the pixels of it that the picture holds are a run.
    int first = 0;
    int count = 0;
    for (int i = 0; i < std::min(width - x0, kKnotPx); ++i) {
      const double sx = from.x + dx * i;
      const double sy = from.y + dy * i;
      if (!(sx >= 1 && sy >= 1 && sx < image.width_px - 2 && sy < image.height_px - 2)) continue;
      if (count == 0) first = i;
      const auto at = std::size_t(count++);
      span.x[at] = int(sx);
      span.y[at] = int(sy);
      span.tx[at] = float(sx - span.x[at]);
      span.ty[at] = float(sy - span.y[at]);
    }
    sample_grey(grey.row(0), grey.width, count, span);
    const std::size_t k = pair.index(x0 + first, y);
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
      view.grey[k + i] = span.grey[i];
      sample_rgb(image, span.x[i], span.y[i], span.tx[i], span.ty[i], &view.rgb[3 * (k + i)]);
      view.valid[k + i] = 1;
    }
    from = to;
  }
}

Result<void> check_bytes(const ImageView& image, const char* side) {
  if (image.empty()) return invalid("the picture is empty: capture again").at(side);
  if (image.rows_overlap()) return invalid("the picture's stride is shorter than its rows").at(side);
  return {};
}

Result<void> check_picture(const ImageView& image, const CameraIntrinsics& camera, const char* side) {
  RELIEVO_TRY(check_bytes(image, side));
  if (image.width_px != camera.width_px || image.height_px != camera.height_px)
    return invalid(
               "the picture's size is not the calibration's: use pictures of the calibrated size, or calibrate at this one")
        .at(side);
  return {};
}

constexpr double kBaselineMm = 110;  // of the recommended rig; the focal length is the picture's width

void take_view(const ImageView& image, RectifiedView& view, StageContext& context) {
  const std::size_t pixels = std::size_t(image.width_px) * std::size_t(image.height_px);
  view.grey.resize(pixels);
  view.rgb.resize(3 * pixels);
  view.valid.assign(pixels, 1);
  context.pool.for_each(image.height_px, 16, [&](int y) {
    std::uint8_t* to = view.rgb.data() + 3 * std::ptrdiff_t(y) * image.width_px;
    float* grey = view.grey.data() + std::ptrdiff_t(y) * image.width_px;
    grey_row(image, y, grey);
    if (image.format == PixelFormat::Rgb8) std::copy_n(image.row(y), 3 * image.width_px, to);
    else
      for (int x = 0; x < image.width_px; ++x) std::fill_n(to + 3 * x, 3, std::uint8_t(grey[x]));
  });
}

}  // namespace

void grey_row(const ImageView& image, int y, float* to) {
  const std::uint8_t* from = image.row(y);
  if (image.format == PixelFormat::Rgb8) {
    for (int x = 0; x < image.width_px; ++x)
      to[x] = float(from[3 * x] + from[3 * x + 1] + from[3 * x + 2]) * (1.0F / 3);
  } else if (image.format == PixelFormat::Grey16) {
    const auto* wide = reinterpret_cast<const std::uint16_t*>(from);
    for (int x = 0; x < image.width_px; ++x) to[x] = float(wide[x]) * (1.0F / 257);
  } else {
    for (int x = 0; x < image.width_px; ++x) to[x] = float(from[x]);
  }
}

Vec2d source_pixel(const CameraIntrinsics& camera, const Rotation& rectified_from_camera, double focal_px,
                   Vec2d centre_px, Vec2d at) {
  const Vec3d ray = apply(transposed(rectified_from_camera),
                          {(at.x - centre_px.x) / focal_px, (at.y - centre_px.y) / focal_px, 1});
  return pixel_of_ray(camera, {ray.x / ray.z, ray.y / ray.z});
}

Result<void> lay_windows(const StereoCalibration& calibration, const RectifierOptions& options,
                         RectifiedPair& pair) {
  const RigidTransform left_from_right = inverse(calibration.right_from_left);
  const Vec3d baseline = left_from_right.translation_mm;  // right camera's centre, left frame
  const double baseline_mm = length(baseline);
  // Sensors that lie on their side have the baseline along y, either way: the rows of the window are the
  // baseline's, so the window stands upright as the people do.
  const double sideways = std::hypot(baseline.x, baseline.y);
  if (!(baseline_mm > 1) || sideways < 0.5 * baseline_mm)
    return invalid("the cameras must stand beside each other, not behind");
  if (baseline.x <= 0 && -baseline.x >= std::abs(baseline.y))
    return invalid("the right camera must stand to the right of the left one: are the cameras swapped?");
  const Vec3d x = times(baseline, 1 / baseline_mm);
  const Vec3d right_axis = apply(left_from_right.rotation, {0, 0, 1});
  Vec3d z = {right_axis.x, right_axis.y, right_axis.z + 1};
  z = unit(along(z, -dot(z, x), x));
  const Vec3d y = cross(z, x);
  pair.rectified_from_left = {{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}};
  pair.rectified_from_right = product(pair.rectified_from_left, left_from_right.rotation);
  pair.right_from_left = calibration.right_from_left;
  pair.baseline_mm = baseline_mm;
  pair.near_mm = options.near_mm;
  pair.far_mm = options.far_mm;
  pair.focal_px = (calibration.left.focal_px.x + calibration.left.focal_px.y + calibration.right.focal_px.x +
                   calibration.right.focal_px.y) /
                  4;

  const Box left = border_box(calibration.left, pair.rectified_from_left, pair.focal_px);
  const Box right = border_box(calibration.right, pair.rectified_from_right, pair.focal_px);
  const double top = std::max(left.top, right.top);
  const double bottom = std::min(left.bottom, right.bottom);
  const double width = std::max(left.right - left.left, right.right - right.left);
  const double columns = std::ceil(width) + 1, rows = std::floor(bottom - top) + 1;
  // Before they become numbers of pixels: a box that holds no ray is no size at all.
  if (!(columns <= options.longest_side_px && rows >= 64 && rows <= options.longest_side_px))
    return invalid("the two cameras do not look at a common volume: calibrate again");
  pair.width_px = int(columns);
  pair.height_px = int(rows);
  const auto centred = [width](const Box& box) { return width / 2 - (box.left + box.right) / 2; };
  pair.left_centre_px = {centred(left), -top};
  pair.right_centre_px = {centred(right), -top};
  return {};
}

Result<void> RectifierOptions::check() const {
  if (!(near_mm > 0 && far_mm > near_mm))
    return invalid("rectifier: near_mm must be positive and smaller than far_mm");
  return {};
}

Result<RectifiedPair> RectifierOptions::rectify(const StereoFrame& frame,
                                                const StereoCalibration& calibration,
                                                StageContext& context) const {
  RELIEVO_TRY(check_picture(frame.left, calibration.left, "left picture"));
  RELIEVO_TRY(check_picture(frame.right, calibration.right, "right picture"));
  RectifiedPair pair(&context.output);
  RELIEVO_TRY(lay_windows(calibration, *this, pair));
  Plane<float> grey(&context.scratch, std::max(frame.left.width_px, frame.right.width_px),
                    std::max(frame.left.height_px, frame.right.height_px));
  const std::array views{&pair.left, &pair.right};
  for (std::size_t side = 0; side < 2; ++side) {
    if (context.stop()) return stopped();
    RectifiedView& view = *views[side];
    view.grey.resize(pair.pixels());
    view.rgb.resize(3 * pair.pixels());
    view.valid.resize(pair.pixels());
    const ImageView& image = side == 0 ? frame.left : frame.right;
    const ViewGeometry geometry{side == 0 ? calibration.left : calibration.right,
                                side == 0 ? pair.rectified_from_left : pair.rectified_from_right,
                                side == 0 ? pair.left_centre_px : pair.right_centre_px};
    context.pool.for_each(image.height_px, 16, [&](int y) { grey_row(image, y, grey.row(y)); });
    context.pool.for_each(pair.height_px, 16, [&](int y) { resample(pair, geometry, image, grey, view, y); });
    context.progress.done.store(side == 0 ? 0.5F : 1.0F, std::memory_order_relaxed);
  }
  return pair;
}

Result<void> DisparityRange::check() const {
  if (least_px >= -4096 && most_px <= 4096 && least_px < most_px) return {};
  return invalid("disparities: two whole numbers of pixels are wanted, the smaller first, within 4096");
}

Result<RectifiedPair> take_rectified(const StereoFrame& frame, const DisparityRange& range,
                                     StageContext& context) {
  RELIEVO_TRY(range.check());
  RELIEVO_TRY(check_bytes(frame.left, "left"));
  RELIEVO_TRY(check_bytes(frame.right, "right"));
  if (frame.left.width_px != frame.right.width_px || frame.left.height_px != frame.right.height_px)
    return invalid("the two pictures of a rectified pair differ in size");
  RectifiedPair pair(&context.output);
  pair.width_px = frame.left.width_px;
  pair.height_px = frame.left.height_px;
  pair.focal_px = pair.width_px;
  pair.baseline_mm = kBaselineMm;
  // Infinity lies below the least disparity, so that every depth is a number.
  const double infinity = std::min(0, range.least_px - 1);
  pair.left_centre_px = {0.5 * (pair.width_px - 1), 0.5 * (pair.height_px - 1)};
  pair.right_centre_px = {pair.left_centre_px.x - infinity, pair.left_centre_px.y};
  pair.near_mm = pair.depth_mm(range.most_px);
  pair.far_mm = pair.depth_mm(range.least_px);
  pair.right_from_left.translation_mm = {-kBaselineMm, 0, 0};
  take_view(frame.left, pair.left, context);
  if (context.stop()) return stopped();
  take_view(frame.right, pair.right, context);
  return pair;
}

}  // namespace relievo::pipeline
