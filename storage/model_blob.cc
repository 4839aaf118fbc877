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
using pipeline::ReliefFigures;

constexpr std::string_view kMagic{"RFACE\0", 6};
constexpr std::uint16_t kVersion = 5;
constexpr std::size_t kHeaderBytes = 6 + 2 + 5 * 4;
constexpr double ReliefFigures::*kRelief[] = {&ReliefFigures::covered,        &ReliefFigures::sigma_mm,
                                              &ReliefFigures::off_plane_mm,   &ReliefFigures::off_sheet_mm,
                                              &ReliefFigures::sheet_range_mm, &ReliefFigures::curvature_sr};

// Each version added figures at the end.
std::size_t quality_figures(std::uint16_t version) {
  return version < 2 ? 7 : version < 3 ? 8 : std::size(kQualityFigures);
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
  std::size_t texels() const { return std::size_t{width_px} * height_px; }
  // Cannot overflow within the limits: at most 0.9 GB.
  std::size_t total_bytes() const {
    const std::size_t v = vertices;
    return kHeaderBytes + (12 + quality_figures(version) + relief_figures(version)) * 8 +
           landmark_bytes(version) + v * 12 + count(Normals, v) * 12 + count(Sigma, v) * 4 +
           count(Measured, v) + std::size_t{triangles} * 12 + texels() * 3 + count(Origin, texels()) +
           count(Uv, std::size_t{triangles} * 3) * 8 + count(VertexRgb, v) * 3 + count(Pose, v) +
           sizeof(Sha256);
  }
};

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
    return invalid("the model is larger than the store takes");
  }
  Shape shape{std::uint32_t(v), std::uint32_t(mesh.triangles.size()), std::uint32_t(texture.width_px),
              std::uint32_t(texture.height_px)};
  const auto note = [&shape](const auto& items, Shape::Flag flag) {
    if (!items.empty()) shape.flags |= flag;
  };
  note(mesh.normals, Shape::Normals);
  note(mesh.sigma_mm, Shape::Sigma);
  note(mesh.measured, Shape::Measured);
  note(mesh.pose, Shape::Pose);
  note(texture.uv, Shape::Uv);
  note(texture.vertex_rgb, Shape::VertexRgb);
  note(texture.origin, Shape::Origin);
  if (!shape.within_limits()) return invalid("the texture is larger than the store takes");
  RELIEVO_TRY(check_arrays(model));
  return shape;
}

template <typename Io, typename Model>
void walk_numbers(Io& io, Model& model, std::uint16_t version) {
  for (auto& value : model.head_from_camera.rotation.m) io.numbers(value);
  auto& moved = model.head_from_camera.translation_mm;
  io.numbers(moved.x, moved.y, moved.z);
  for (const QualityFigure& figure : std::span(kQualityFigures).first(quality_figures(version)))
    io.numbers(model.quality.*figure.of);
  if (landmark_bytes(version) == 0) return;
  for (auto& l : model.landmarks) {
    io.numbers(l.at_mm.x, l.at_mm.y, l.at_mm.z, l.sigma_mm);
    io.flag(l.found);
  }
  for (const auto member : std::span(kRelief).first(relief_figures(version)))
    io.numbers(model.quality.relief.*member);
}

template <typename Io, typename Model>
void walk_arrays(Io& io, Model& model, const Shape& shape) {
  auto& mesh = model.mesh;
  auto& texture = model.texture;
  const std::size_t v = shape.vertices, t = shape.triangles, texels = shape.texels();
  io.template run<float>(mesh.vertices_mm, v);
  io.template run<float>(mesh.normals, shape.count(Shape::Normals, v));
  io.template run<float>(mesh.sigma_mm, shape.count(Shape::Sigma, v));
  io.template run<std::uint8_t>(mesh.measured, shape.count(Shape::Measured, v));
  io.template run<std::uint32_t>(mesh.triangles, t);
  io.template run<std::uint8_t>(texture.rgb, texels * 3);
  io.template run<float>(texture.uv, shape.count(Shape::Uv, t * 3));
  io.template run<std::uint8_t>(texture.vertex_rgb, shape.count(Shape::VertexRgb, v * 3));
  io.template run<std::uint8_t>(texture.origin, shape.count(Shape::Origin, texels));
  io.template run<std::uint8_t>(mesh.pose, shape.count(Shape::Pose, v));
}

Result<Shape> read_header(std::span<const std::byte> bytes) {
  constexpr Literal kNoModel = "these bytes are no stored face model, or are damaged";
  if (bytes.size() < kHeaderBytes || !text_of(bytes).starts_with(kMagic)) {
    return Error{Errc::StoreCorrupt, kNoModel};
  }
  ByteReader from(bytes.subspan(kMagic.size()));
  Shape shape;
  shape.version = from.get<std::uint16_t>();
  if (shape.version < 1 || shape.version > kVersion) {
    return Error{Errc::StoreNewer, "this face model was stored by a newer version: update Relievo"};
  }
  from.numbers(shape.vertices, shape.triangles, shape.width_px, shape.height_px, shape.flags);
  if (!shape.within_limits() || shape.total_bytes() != bytes.size())
    return Error{Errc::StoreCorrupt, kNoModel};
  return shape;
}

}  // namespace

Result<void> check_arrays(const FaceModel& model) {
  const auto& mesh = model.mesh;
  const auto& texture = model.texture;
  const std::size_t v = mesh.vertices_mm.size();
  const auto fits = [](const auto& items, std::size_t size) { return items.empty() || items.size() == size; };
  const bool lengths_fit =
      texture.width_px >= 0 && texture.height_px >= 0 &&
      texture.rgb.size() == std::size_t(texture.width_px) * std::size_t(texture.height_px) * 3 &&
      fits(mesh.normals, v) && fits(mesh.sigma_mm, v) && fits(mesh.measured, v) && fits(mesh.pose, v) &&
      fits(texture.uv, mesh.triangles.size() * 3) && fits(texture.vertex_rgb, v * 3) &&
      fits(texture.origin, texture.rgb.size() / 3);
  if (!lengths_fit) return invalid("the model's arrays do not fit together");
  if (!indices_fit(mesh)) return invalid("a triangle of the model names a vertex that is not there");
  return {};
}

Result<std::vector<std::byte>> encode_model(const FaceModel& model) {
  RELIEVO_TRY_ASSIGN(const Shape shape, shape_of(model));
  std::vector<std::byte> out;
  out.reserve(shape.total_bytes());
  ByteWriter to(out);
  to.put(bytes_of(kMagic));
  to.put(kVersion);
  to.numbers(shape.vertices, shape.triangles, shape.width_px, shape.height_px, shape.flags);
  walk_numbers(to, model, kVersion);
  walk_arrays(to, model, shape);
  to.put(sha256(out));
  return out;
}

Result<FaceModel> decode_model(std::span<const std::byte> bytes, std::pmr::memory_resource* memory) {
  RELIEVO_TRY_ASSIGN(const Shape shape, read_header(bytes));
  if (!ends_in_sha256(bytes)) {
    return Error{Errc::StoreCorrupt, "a stored face model is damaged: its checksum does not fit"};
  }
  ByteReader from(bytes.first(bytes.size() - sizeof(Sha256)).subspan(kHeaderBytes));
  FaceModel model(memory);
  walk_numbers(from, model, shape.version);
  walk_arrays(from, model, shape);
  model.texture.width_px = int(shape.width_px);
  model.texture.height_px = int(shape.height_px);
  if (!from.whole() || !indices_fit(model.mesh)) {
    return Error{Errc::StoreCorrupt, "a stored face model does not hang together"};
  }
  return model;
}

}  // namespace relievo::storage
