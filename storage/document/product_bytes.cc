// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each product has one walk over its fields (byte_order.h).
#include "storage/document/product_bytes.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"
#include "storage/byte_order.h"

namespace relievo::storage {
namespace {

using namespace pipeline;  // NOLINT(google-build-using-namespace): this file is about nothing else

constexpr int kMaxSidePx = 16'384;

// To be written, it is const.
template <typename T, typename Product>
concept Of = std::same_as<std::remove_const_t<T>, Product>;

template <typename Io, typename Transform>
void walk_transform(Io& io, Transform& t) {
  for (auto& v : t.rotation.m) io.numbers(v);
  io.numbers(t.translation_mm.x, t.translation_mm.y, t.translation_mm.z);
}

template <typename Io, typename View>
void walk_view(Io& io, View& view) {
  io.template run<float>(view.grey);
  io.template run<std::uint8_t>(view.rgb);
  io.template run<std::uint8_t>(view.valid);
}

template <typename Io, Of<RectifiedPair> Pair>
void walk(Io& io, Pair& pair) {
  io.numbers(pair.width_px, pair.height_px, pair.focal_px, pair.baseline_mm, pair.left_centre_px.x,
             pair.left_centre_px.y, pair.right_centre_px.x, pair.right_centre_px.y, pair.near_mm, pair.far_mm,
             pair.face_centre_px.x, pair.face_centre_px.y, pair.face_width_px, pair.face_reach_mm);
  for (auto* rotation : {&pair.rectified_from_left, &pair.rectified_from_right})
    for (auto& v : rotation->m) io.numbers(v);
  walk_transform(io, pair.right_from_left);
  walk_view(io, pair.left);
  walk_view(io, pair.right);
  io.template run<std::uint8_t>(pair.region);
}

template <typename Io, Of<MatchSet> Set>
void walk(Io& io, Set& set) {
  auto& shift = set.epipolar_shift;
  io.numbers(shift.offset_px, shift.slope_x, shift.slope_y, shift.middle_x_px, shift.middle_y_px,
             shift.spread_x_px, shift.spread_y_px, shift.correlation, shift.residual_px, shift.sigma_px,
             set.motion_px);
  for (auto& v : shift.covariance_px2) io.numbers(v);
  io.numbers(set.lattice_step_px);
  io.each(set.matches, [](Io& one, auto& match) {
    one.numbers(match.left_px.x, match.left_px.y, match.disparity_px, match.cost, match.sigma_px,
                match.rejected_by);
  });
}

template <typename Io, Of<PointCloud> Cloud>
void walk(Io& io, Cloud& cloud) {
  io.numbers(cloud.lattice_step_px, cloud.right_camera_mm.x, cloud.right_camera_mm.y,
             cloud.right_camera_mm.z);
  io.template run<float>(cloud.points);
}

template <typename Io, Of<FaceMesh> Mesh>
void walk(Io& io, Mesh& mesh) {
  io.template run<float>(mesh.vertices_mm);
  io.template run<float>(mesh.normals);
  io.template run<float>(mesh.sigma_mm);
  io.template run<std::uint8_t>(mesh.measured);
  io.template run<std::uint32_t>(mesh.triangles);
}

template <typename Io, Of<Backdrop> Drop>
void walk(Io& io, Drop& backdrop) {
  io.numbers(backdrop.columns, backdrop.rows);
  io.template run<float>(backdrop.at_mm);
  io.template run<std::uint8_t>(backdrop.rgba);
}

bool finite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
bool within(const Vec2f& p, const RectifiedPair& pair) {
  return p.x >= 0 && p.y >= 0 && p.x <= float(pair.width_px - 1) && p.y <= float(pair.height_px - 1);
}
bool is_side(int px) { return px > 0 && px <= kMaxSidePx; }

bool fits(const RectifiedPair& pair) {
  if (!is_side(pair.width_px) || !is_side(pair.height_px)) return false;
  const std::size_t pixels = std::size_t(pair.width_px) * std::size_t(pair.height_px);
  const auto whole = [pixels](const RectifiedView& view) {
    return view.grey.size() == pixels && view.rgb.size() == 3 * pixels && view.valid.size() == pixels;
  };
  return whole(pair.left) && whole(pair.right) && (pair.region.empty() || pair.region.size() == pixels);
}

bool fits(const MatchSet& set, const RectifiedPair& pair) {
  return set.lattice_step_px >= 0 && set.lattice_step_px <= kMaxSidePx &&
         std::ranges::all_of(set.matches, [&](const Match& m) { return within(m.left_px, pair); });
}

bool fits(const PointCloud& cloud, const RectifiedPair& pair) {
  return cloud.lattice_step_px >= 0 && cloud.lattice_step_px <= kMaxSidePx &&
         std::ranges::all_of(cloud.points,
                             [&](const CloudPoint& p) { return finite(p.at_mm) && within(p.left_px, pair); });
}

bool fits(const FaceMesh& mesh) {
  const std::size_t v = mesh.vertices_mm.size();
  const auto there = [v](std::size_t size) { return size == v; };
  return there(mesh.normals.size()) && there(mesh.sigma_mm.size()) && there(mesh.measured.size()) &&
         std::ranges::all_of(mesh.vertices_mm, finite) &&
         std::ranges::all_of(mesh.triangles, [v](const auto& t) { return t[0] < v && t[1] < v && t[2] < v; });
}

bool fits(const Backdrop& backdrop) {
  if (backdrop.columns < 0 || backdrop.rows < 0 || backdrop.columns > kMaxSidePx ||
      backdrop.rows > kMaxSidePx)
    return false;
  const std::size_t size = std::size_t(backdrop.columns) * std::size_t(backdrop.rows);
  return backdrop.at_mm.size() == size && backdrop.rgba.size() == size;
}

Error broken() { return invalid("what was saved does not hang together"); }

constexpr std::size_t kPictureHeadBytes = 4 + 4 + 1;

// Of those that are more than one array, so much at least.
std::size_t room_of(const RectifiedPair& pair) { return pair.left.grey.size() * 17 + 1024; }
std::size_t room_of(const MatchSet& matches) { return matches.matches.size() * 22 + 256; }
std::size_t room_of(const FaceMesh& mesh) {
  return mesh.vertices_mm.size() * 29 + mesh.triangles.size() * 12 + 64;
}
std::size_t room_of(const auto&) { return 0; }

}  // namespace

std::vector<std::byte> picture_bytes(const ImageView& picture) {
  const auto row_bytes = std::size_t(picture.width_px) * std::size_t(bytes_per_pixel(picture.format));
  std::vector<std::byte> bytes;
  bytes.reserve(kPictureHeadBytes + row_bytes * std::size_t(picture.height_px));
  ByteWriter to(bytes);
  to.put(picture.width_px);
  to.put(picture.height_px);
  to.put(std::uint8_t(picture.format));
  for (int y = 0; y < picture.height_px; ++y) to.put(std::as_bytes(std::span(picture.row(y), row_bytes)));
  return bytes;
}

Result<ImageView> picture_from(std::span<const std::byte> bytes) {
  ByteReader from(bytes);
  ImageView view;
  view.width_px = from.get<int>();
  view.height_px = from.get<int>();
  const auto format = from.get<std::uint8_t>();
  if (!from.ok() || !is_side(view.width_px) || !is_side(view.height_px) ||
      format > std::uint8_t(PixelFormat::Grey16))
    return broken();
  view.format = static_cast<PixelFormat>(format);
  view.stride_bytes = view.width_px * bytes_per_pixel(view.format);
  view.bytes = bytes.data() + kPictureHeadBytes;
  if (from.left() != std::size_t(view.stride_bytes) * std::size_t(view.height_px)) return broken();
  return view;
}

template <typename Product>
std::vector<std::byte> product_bytes(const Product& product) {
  std::vector<std::byte> bytes;
  bytes.reserve(room_of(product));
  ByteWriter io(bytes);
  walk(io, product);
  return bytes;
}

template <typename Product, typename... Beside>
Result<Product> product_from(std::span<const std::byte> bytes, std::pmr::memory_resource* memory,
                             const Beside&... beside) {
  ByteReader io(bytes);
  Product product(memory);
  walk(io, product);
  if (!io.whole() || !fits(product, beside...)) return broken();
  return product;
}

template std::vector<std::byte> product_bytes(const RectifiedPair&);
template std::vector<std::byte> product_bytes(const MatchSet&);
template std::vector<std::byte> product_bytes(const PointCloud&);
template std::vector<std::byte> product_bytes(const FaceMesh&);
template std::vector<std::byte> product_bytes(const Backdrop&);

using Bytes = std::span<const std::byte>;
using Memory = std::pmr::memory_resource;
template Result<RectifiedPair> product_from(Bytes, Memory*);
template Result<MatchSet> product_from(Bytes, Memory*, const RectifiedPair&);
template Result<PointCloud> product_from(Bytes, Memory*, const RectifiedPair&);
template Result<FaceMesh> product_from(Bytes, Memory*);
template Result<Backdrop> product_from(Bytes, Memory*);

}  // namespace relievo::storage
