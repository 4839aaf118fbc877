// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/measurement.h"

#include <algorithm>
#include <charconv>
#include <span>

#include "hal/base/whole_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/byte_order.h"

namespace relievo::firmware::measure {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
constexpr std::size_t kVertexBytes = 12;
constexpr std::size_t kTriangleBytes = 13;  // a count of 3, three numbers
constexpr float kFarthestMm = 1e5F;         // no head stands there: the file is damaged

Error bad() { return invalid("is no head of the simulated rig: 'relievo simulate face --truth' writes one"); }

// Takes `text` off the front.
bool skip(std::string_view& rest, std::string_view text) {
  if (rest.substr(0, text.size()) != text) return false;
  rest.remove_prefix(text.size());
  return true;
}

template <typename Number>
bool number(std::string_view& rest, Number& value) {
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc()) return false;
  rest.remove_prefix(std::size_t(end - rest.data()));
  return true;
}

constexpr double kNoseRadiusMm = 95;  // the crop of 3D face recognition
constexpr int kInteriorHalfWindowPx = 11;

Error bad(const std::filesystem::path& file) {
  return invalid("is no truth of the simulated rig: 'relievo simulate face --truth' writes one")
      .at(file.string());
}

// Two whole numbers and the letter z; the number of bytes up to the line feed, or 0.
std::size_t header(std::string_view text, int& width_px, int& height_px) {
  std::string_view rest = text.substr(0, 64);
  const bool known =
      number(rest, width_px) && skip(rest, " ") && number(rest, height_px) && skip(rest, " z\n");
  const bool sane = width_px > 0 && height_px > 0 && width_px <= 16384 && height_px <= 16384;
  return known && sane ? std::size_t(rest.data() - text.data()) : 0;
}

}  // namespace

Result<Surface> parse_true_surface(std::string_view rest) {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  const bool known =
      skip(rest, "ply\nformat binary_little_endian 1.0\nelement vertex ") && number(rest, vertices) &&
      skip(rest, "\nproperty float x\nproperty float y\nproperty float z\nelement face ") &&
      number(rest, triangles) && skip(rest, "\nproperty list uchar int vertex_indices\nend_header\n");
  if (!known || vertices > kMaxFileBytes || triangles > kMaxFileBytes) return bad();
  if (rest.size() != vertices * kVertexBytes + triangles * kTriangleBytes) return bad();
  Surface surface;
  surface.vertices_mm.resize(vertices);
  surface.triangles.resize(triangles);
  storage::ByteReader from(storage::bytes_of(rest));
  for (Vec3f& v : surface.vertices_mm) {
    from.numbers(v.x, v.y, v.z);
    for (const float mm : {v.x, v.y, v.z})
      if (!(std::abs(mm) <= kFarthestMm)) return bad();
  }
  for (auto& t : surface.triangles) {
    if (from.get<std::uint8_t>() != 3) return bad();
    for (std::uint32_t& v : t) {
      v = from.get<std::uint32_t>();
      if (v >= vertices) return bad();
    }
  }
  return surface;
}

Result<Surface> read_true_surface(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMaxFileBytes));
  return parse_true_surface({reinterpret_cast<const char*>(bytes.data()), bytes.size()}).at(file.string());
}

Result<TruthView> TruthView::read(const std::filesystem::path& folder) {
  TruthView truth;
  RELIEVO_TRY_ASSIGN(const auto rig, pipeline::read_calibration(folder / "rig.yml"));
  truth.left_ = rig.left;
  const auto file = folder / "truth.bin";
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMaxFileBytes));
  const std::size_t start =
      header({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, truth.width_px_, truth.height_px_);
  const std::size_t count = std::size_t(truth.width_px_) * std::size_t(truth.height_px_);
  if (start == 0 || bytes.size() != start + count * 5 || rig.left.width_px != truth.width_px_ ||
      rig.left.height_px != truth.height_px_)
    return bad(file);
  truth.points_mm_.resize(count);
  storage::ByteReader from{std::span(bytes).subspan(start)};
  std::vector<float> depths;
  from.run<float>(depths, count);
  from.run<std::uint8_t>(truth.flags_, count);
  for (int y = 0; y < truth.height_px_; ++y) {
    for (int x = 0; x < truth.width_px_; ++x) {
      const std::size_t i = truth.at(x, y);
      const float z = depths[i];
      const pipeline::Vec2d ray = pipeline::ray_of_pixel(truth.left_, {double(x), double(y)});
      truth.points_mm_[i] = std::isnan(z) ? Vec3f{0, 0, z} : narrow(times(Vec3d{ray.x, ray.y, 1}, z));
      truth.flags_[i] = std::isnan(z) ? std::uint8_t{0} : std::uint8_t(truth.flags_[i] & kJudged);
    }
  }
  truth.keep_near_nose();
  truth.mark_interior();
  return truth;
}

// The tip of the nose is the skin nearest to the camera.
void TruthView::keep_near_nose() {
  std::size_t tip = flags_.size();
  for (std::size_t i = 0; i < flags_.size(); ++i) {
    if ((flags_[i] & (kSkin | kBothSee)) != (kSkin | kBothSee)) continue;
    if (tip == flags_.size() || points_mm_[i].z < points_mm_[tip].z) tip = i;
  }
  for (std::size_t i = 0; i < flags_.size() && tip < flags_.size(); ++i) {
    if ((flags_[i] & kJudged) == kJudged &&
        distance(wide(points_mm_[i]), wide(points_mm_[tip])) <= kNoseRadiusMm)
      continue;
    flags_[i] = std::uint8_t(flags_[i] & ~kSteep);
  }
}

void TruthView::mark_interior() {
  constexpr int kSide = 2 * kInteriorHalfWindowPx + 1;
  std::vector<int> across(flags_.size());  // length of the judged run that ends here
  for (int y = 0; y < height_px_; ++y) {
    int run = 0;
    for (int x = 0; x < width_px_; ++x)
      across[at(x, y)] = run = (flags_[at(x, y)] & kJudged) == kJudged ? run + 1 : 0;
  }
  for (int x = kInteriorHalfWindowPx; x + kInteriorHalfWindowPx < width_px_; ++x) {
    int run = 0;  // rows whose whole width of window is judged
    for (int y = 0; y < height_px_; ++y) {
      run = across[at(x + kInteriorHalfWindowPx, y)] >= kSide ? run + 1 : 0;
      if (run >= kSide) flags_[at(x, y - kInteriorHalfWindowPx)] |= kInterior;
    }
  }
}

std::uint8_t TruthView::flags_at(const Vec3d& p) const {
  if (!(p.z > 0)) return 0;
  const pipeline::Vec2d at_px = pipeline::pixel_of_ray(left_, {p.x / p.z, p.y / p.z});
  const double u = std::round(at_px.x), v = std::round(at_px.y);
  if (!(u >= 0 && v >= 0 && u < width_px_ && v < height_px_)) return 0;
  return flags_[at(int(u), int(v))];
}

std::optional<Vec3d> TruthView::judged_point_along(const Vec3d& ray) const {
  if (!(ray.z > 0)) return std::nullopt;
  const auto [u, v] = pipeline::pixel_of_ray(left_, {ray.x / ray.z, ray.y / ray.z});
  if (!(u >= 0 && v >= 0 && u < width_px_ - 1 && v < height_px_ - 1)) return std::nullopt;
  const int x = int(u);
  const int y = int(v);
  double z = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const std::size_t k = at(x + i, y + j);
      if ((flags_[k] & kJudged) != kJudged) return std::nullopt;
      const double weight = (i == 0 ? 1 - (u - x) : u - x) * (j == 0 ? 1 - (v - y) : v - y);
      z += weight * double(points_mm_[k].z);
    }
  return times(ray, z / ray.z);
}

std::vector<Vec3d> TruthView::judged_points(std::size_t count) const {
  std::vector<Vec3d> points;
  const auto judged =
      std::size_t(std::ranges::count_if(flags_, [](std::uint8_t f) { return (f & kJudged) == kJudged; }));
  const int step = std::max(1, int(std::sqrt(double(judged) / double(count))));
  for (int y = 0; y < height_px_; y += step) {
    for (int x = 0; x < width_px_; x += step) {
      if ((flags_[at(x, y)] & kJudged) == kJudged) points.push_back(wide(points_mm_[at(x, y)]));
    }
  }
  return points;
}

}  // namespace relievo::firmware::measure
