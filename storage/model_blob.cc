// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/model_blob.h"

#include <algorithm>
#include <string_view>

#include "storage/byte_order.h"
#include "storage/sodium_sha256.h"

namespace relievo::storage {
namespace {

using pipeline::FaceModel;
using pipeline::ModelQuality;
using pipeline::ReliefFigures;
using pipeline::Vec2f;
using pipeline::Vec3f;

constexpr std::string_view kMagic{"RFACE\0", 6};
constexpr std::uint16_t kVersion = 5;
constexpr std::size_t kHeaderBytes = 6 + 2 + 5 * 4;
constexpr double ModelQuality::*kQuality[] = {&ModelQuality::median_sigma_mm,
                                              &ModelQuality::measured_area_mm2,
                                              &ModelQuality::coverage,
                                              &ModelQuality::width_mm,
                                              &ModelQuality::height_mm,
                                              &ModelQuality::nose_relief_mm,
                                              &ModelQuality::epipolar_residual_px,
                                              &ModelQuality::texture_sharpness,
                                              &ModelQuality::symmetry_residual_mm};

constexpr double ReliefFigures::*kRelief[] = {&ReliefFigures::covered,        &ReliefFigures::sigma_mm,
                                              &ReliefFigures::off_plane_mm,   &ReliefFigures::off_sheet_mm,
                                              &ReliefFigures::sheet_range_mm, &ReliefFigures::curvature_sr};

// Each version added figures at the end.
std::size_t quality_figures(std::uint16_t version) {
  return version < 2 ? 7 : version < 3 ? 8 : std::size(kQuality);
}

constexpr std::size_t kLandmarkBytes = pipeline::kLandmarkCount * (4 * 4 + 1);
std::size_t landmark_bytes(std::uint16_t version) { return version < 3 ? 0 : kLandmarkBytes; }

std::size_t relief_figures(std::uint16_t version) { return version < 4 ? 0 : std::size(kRelief); }

// What the header says; everything else follows from it.
struct Shape {
  std::uint32_t vertices = 0, triangles = 0, width_px = 0, height_px = 0, flags = 0;
  std::uint16_t version = kVersion;

  enum Flag : std::uint32_t {
    Normals = 1,
    Sigma = 2,
    Measured = 4,
    Uv = 8,
    VertexRgb = 16,
    Origin = 32,
    Pose = 64
  };
  std::uint32_t known_flags() const { return version < 2 ? 31 : version < 5 ? 63 : 127; }

  bool has(Flag flag) const { return (flags & flag) != 0; }
  std::size_t count(Flag flag, std::size_t of) const { return has(flag) ? of : 0; }

  bool within_limits() const {
    return vertices <= kMaxModelVertices && triangles <= kMaxModelTriangles &&
           width_px <= kMaxTextureSidePx && height_px <= kMaxTextureSidePx && (flags & ~known_flags()) == 0 &&
           (width_px == 0) == (height_px == 0);
  }
  // Cannot overflow within the limits: at most 0.9 GB.
  std::size_t total_bytes() const {
    const std::size_t v = vertices;
    const std::size_t texels = std::size_t{width_px} * height_px;
    return kHeaderBytes + (12 + quality_figures(version) + relief_figures(version)) * 8 +
           landmark_bytes(version) + v * 12 + count(Normals, v) * 12 + count(Sigma, v) * 4 +
           count(Measured, v) + std::size_t{triangles} * 12 + texels * 3 + count(Origin, texels) +
           count(Uv, std::size_t{triangles} * 3) * 8 + count(VertexRgb, v) * 3 + count(Pose, v) +
           sizeof(Sha256);
  }
};

template <typename Vector>
bool absent_or(const Vector& items, std::size_t size, Shape::Flag flag, Shape& shape) {
  if (items.empty()) return true;
  shape.flags |= flag;
  return items.size() == size;
}

bool indices_fit(const pipeline::FaceMesh& mesh) {
  return std::ranges::all_of(mesh.triangles, [&](const auto& triangle) {
    return std::ranges::all_of(triangle, [&](std::uint32_t i) { return i < mesh.vertices_mm.size(); });
  });
}

Result<Shape> shape_of(const FaceModel& model) {
  const auto& mesh = model.mesh;
  const auto& texture = model.texture;
  const std::size_t v = mesh.vertices_mm.size();
  if (v > kMaxModelVertices || mesh.triangles.size() > kMaxModelTriangles || texture.width_px < 0 ||
      texture.height_px < 0) {
    return Error{Errc::InvalidInput, "the model is larger than the store takes"};
  }
  Shape shape{std::uint32_t(v), std::uint32_t(mesh.triangles.size()), std::uint32_t(texture.width_px),
              std::uint32_t(texture.height_px)};
  const bool lengths_fit =
      absent_or(mesh.normals, v, Shape::Normals, shape) && absent_or(mesh.sigma_mm, v, Shape::Sigma, shape) &&
      absent_or(mesh.measured, v, Shape::Measured, shape) && absent_or(mesh.pose, v, Shape::Pose, shape) &&
      absent_or(texture.uv, mesh.triangles.size() * 3, Shape::Uv, shape) &&
      absent_or(texture.vertex_rgb, v * 3, Shape::VertexRgb, shape) &&
      absent_or(texture.origin, std::size_t{shape.width_px} * shape.height_px, Shape::Origin, shape);
  if (!shape.within_limits()) return Error{Errc::InvalidInput, "the texture is larger than the store takes"};
  if (!lengths_fit || texture.rgb.size() != std::size_t{shape.width_px} * shape.height_px * 3) {
    return Error{Errc::InvalidInput, "the model's arrays do not fit together"};
  }
  if (!indices_fit(mesh))
    return Error{Errc::InvalidInput, "a triangle of the model names a vertex that is not there"};
  return shape;
}

void put_numbers(ByteWriter& to, const FaceModel& model) {
  for (const double value : model.head_from_camera.rotation.m) to.put(value);
  to.put(model.head_from_camera.translation_mm.x);
  to.put(model.head_from_camera.translation_mm.y);
  to.put(model.head_from_camera.translation_mm.z);
  for (const auto member : kQuality) to.put(model.quality.*member);
  for (const pipeline::Landmark& l : model.landmarks) {
    for (const float value : {l.at_mm.x, l.at_mm.y, l.at_mm.z, l.sigma_mm}) to.put(value);
    to.put(std::uint8_t(l.found ? 1 : 0));
  }
  for (const auto member : kRelief) to.put(model.quality.relief.*member);
}

void get_numbers(ByteReader& from, FaceModel& model, std::uint16_t version) {
  for (double& value : model.head_from_camera.rotation.m) value = from.get<double>();
  model.head_from_camera.translation_mm.x = from.get<double>();
  model.head_from_camera.translation_mm.y = from.get<double>();
  model.head_from_camera.translation_mm.z = from.get<double>();
  for (const auto member : std::span(kQuality).first(quality_figures(version)))
    model.quality.*member = from.get<double>();
  if (landmark_bytes(version) == 0) return;
  for (pipeline::Landmark& l : model.landmarks) {
    for (float* value : {&l.at_mm.x, &l.at_mm.y, &l.at_mm.z, &l.sigma_mm}) *value = from.get<float>();
    l.found = from.get<std::uint8_t>() != 0;
  }
  for (const auto member : std::span(kRelief).first(relief_figures(version)))
    model.quality.relief.*member = from.get<double>();
}

template <typename Element, typename Item>
void put_all(ByteWriter& to, const std::pmr::vector<Item>& items) {
  to.put_run<Element, Item>(std::span<const Item>(items));
}

template <typename Element, typename Item>
void get_all(ByteReader& from, std::pmr::vector<Item>& items, std::size_t count) {
  items.resize(count);
  from.get_run<Element, Item>(std::span<Item>(items));
}

Result<Shape> read_header(std::span<const std::byte> bytes) {
  constexpr Literal kNoModel = "these bytes are no stored face model, or are damaged";
  if (bytes.size() < kHeaderBytes || !std::ranges::equal(bytes.first(kMagic.size()), bytes_of(kMagic))) {
    return Error{Errc::StoreCorrupt, kNoModel};
  }
  ByteReader from(bytes.subspan(kMagic.size()));
  Shape shape;
  shape.version = from.get<std::uint16_t>();
  if (shape.version < 1 || shape.version > kVersion) {
    return Error{Errc::StoreNewer, "this face model was stored by a newer version: update Relievo"};
  }
  for (auto* field : {&shape.vertices, &shape.triangles, &shape.width_px, &shape.height_px, &shape.flags}) {
    *field = from.get<std::uint32_t>();
  }
  if (!shape.within_limits() || shape.total_bytes() != bytes.size())
    return Error{Errc::StoreCorrupt, kNoModel};
  return shape;
}

}  // namespace

Result<std::vector<std::byte>> encode_model(const FaceModel& model) {
  RELIEVO_TRY_ASSIGN(const Shape shape, shape_of(model));
  std::vector<std::byte> out;
  out.reserve(shape.total_bytes());
  ByteWriter to(out);
  to.put(bytes_of(kMagic));
  to.put(kVersion);
  for (const auto field : {shape.vertices, shape.triangles, shape.width_px, shape.height_px, shape.flags})
    to.put(field);
  put_numbers(to, model);
  put_all<float>(to, model.mesh.vertices_mm);
  put_all<float>(to, model.mesh.normals);
  put_all<float>(to, model.mesh.sigma_mm);
  put_all<std::uint8_t>(to, model.mesh.measured);
  put_all<std::uint32_t>(to, model.mesh.triangles);
  put_all<std::uint8_t>(to, model.texture.rgb);
  put_all<float>(to, model.texture.uv);
  put_all<std::uint8_t>(to, model.texture.vertex_rgb);
  put_all<std::uint8_t>(to, model.texture.origin);
  put_all<std::uint8_t>(to, model.mesh.pose);
  const Sha256 digest = sha256(out);
  to.put(digest);
  return out;
}

Result<FaceModel> decode_model(std::span<const std::byte> bytes, std::pmr::memory_resource* memory) {
  RELIEVO_TRY_ASSIGN(const Shape shape, read_header(bytes));
  const auto body = bytes.first(bytes.size() - sizeof(Sha256));
  if (!std::ranges::equal(sha256(body), bytes.last(sizeof(Sha256)))) {
    return Error{Errc::StoreCorrupt, "a stored face model is damaged: its checksum does not fit"};
  }
  ByteReader from(body.subspan(kHeaderBytes));
  FaceModel model(memory);
  get_numbers(from, model, shape.version);
  const std::size_t v = shape.vertices;
  const std::size_t corners = std::size_t{shape.triangles} * 3;
  get_all<float>(from, model.mesh.vertices_mm, v);
  get_all<float>(from, model.mesh.normals, shape.count(Shape::Normals, v));
  get_all<float>(from, model.mesh.sigma_mm, shape.count(Shape::Sigma, v));
  get_all<std::uint8_t>(from, model.mesh.measured, shape.count(Shape::Measured, v));
  get_all<std::uint32_t>(from, model.mesh.triangles, shape.triangles);
  get_all<std::uint8_t>(from, model.texture.rgb, std::size_t{shape.width_px} * shape.height_px * 3);
  get_all<float>(from, model.texture.uv, shape.count(Shape::Uv, corners));
  get_all<std::uint8_t>(from, model.texture.vertex_rgb, shape.count(Shape::VertexRgb, v * 3));
  get_all<std::uint8_t>(from, model.texture.origin,
                        shape.count(Shape::Origin, std::size_t{shape.width_px} * shape.height_px));
  get_all<std::uint8_t>(from, model.mesh.pose, shape.count(Shape::Pose, v));
  model.texture.width_px = int(shape.width_px);
  model.texture.height_px = int(shape.height_px);
  if (!from.ok() || from.left() != 0 || !indices_fit(model.mesh)) {
    return Error{Errc::StoreCorrupt, "a stored face model does not hang together"};
  }
  return model;
}

}  // namespace relievo::storage
