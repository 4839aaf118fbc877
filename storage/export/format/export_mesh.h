// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ExportMesh: a face model as the writers want it: checked, in the frame asked for, millimetres.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/geometry.h"

namespace relievo::storage {

// Numbers as text, in every locale: exact, or rounded to a number of decimals.
template <typename Number>
void append_number(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

// Rounded to `decimals`, without zeros at the end: -12.5, 0, 3. Finite, and below 1e9.
inline void append_rounded(std::string& text, double value, int decimals) {
  std::int64_t one = 1;
  for (int i = 0; i < decimals; ++i) one *= 10;
  std::int64_t scaled = std::llround(value * double(one));
  if (scaled < 0) {
    text += '-';
    scaled = -scaled;
  }
  append_number(text, scaled / one);
  std::int64_t rest = scaled % one;
  if (rest == 0) return;
  text += '.';
  for (one /= 10; rest != 0; one /= 10) {
    text += char('0' + rest / one);
    rest %= one;
  }
}

template <typename Number>
std::string number_text(Number value) {
  std::string text;
  append_number(text, value);
  return text;
}

// Head: origin at the tip of the nose, x to the person's left, y up, z out of the face.
// Camera: the left camera before rectification, x right, y down, z forward.
enum class ExportFrame : std::uint8_t { Head, Camera };

struct ExportMesh {
  const pipeline::FaceModel& model;  // for what no frame changes: triangles, uv, texture, sigma
  ExportFrame frame;
  std::vector<pipeline::Vec3f> vertices_mm;
  std::vector<pipeline::Vec3f> normals;              // unit length, always
  std::vector<std::array<std::uint8_t, 3>> colours;  // one a vertex; white where the model has none
  std::string_view version{};                        // of the program, for files that can say it

  bool textured() const { return !model.texture.uv.empty(); }
};

// InvalidInput: lengths that do not fit together, indices out of range, numbers that are not finite.
// May throw std::bad_alloc. `model` must outlive the result.
Result<ExportMesh> make_export_mesh(const pipeline::FaceModel& model, ExportFrame frame);

// A model's landmarks as its files carry them: those that were found, in the frame of the export,
// millimetres.
struct PlacedLandmark {
  std::string_view name;
  pipeline::Vec3d at_mm;
  double sigma_mm = 0;
};

inline std::vector<PlacedLandmark> placed_landmarks(const ExportMesh& mesh) {
  std::vector<PlacedLandmark> placed;
  for (std::size_t k = 0; k < pipeline::kLandmarkCount; ++k) {
    const pipeline::Landmark& l = mesh.model.landmarks[k];
    const pipeline::Vec3d at{l.at_mm.x, l.at_mm.y, l.at_mm.z};
    if (!l.found || !std::isfinite(at.x + at.y + at.z) ||
        std::abs(at.x) + std::abs(at.y) + std::abs(at.z) > 1e6 || !(l.sigma_mm >= 0 && l.sigma_mm < 1e6F))
      continue;
    placed.push_back({word(static_cast<pipeline::LandmarkName>(k)),
                      mesh.frame == ExportFrame::Head ? apply(mesh.model.head_from_camera, at) : at,
                      double(l.sigma_mm)});
  }
  return placed;
}

// The bytes of a model's files; any of these may throw std::bad_alloc. Thread: any.

// model.stl: binary STL, for printing and for programs that read nothing else. Millimetres, in the
// mesh's frame; a triangle's normal is its own.
std::vector<std::byte> stl_bytes(const ExportMesh& mesh);

// model.ply: binary little-endian; a vertex is float32 x y z nx ny nz sigma_mm, uchar red green blue
// measured; a face is a list of three. Millimetres, in the mesh's frame.
std::vector<std::byte> ply_bytes(const ExportMesh& mesh);

// model.obj: Wavefront OBJ with its material. Millimetres, in the mesh's frame; texture coordinates from the
// lower left, as the format wants. Rounded to a thousandth of a millimetre. One smoothing group instead of
// normals: a reader works them out of so fine a mesh, and the file is a third smaller (GLB and PLY carry
// ours).
std::string obj_text(const ExportMesh& mesh, std::string_view mtl_name);
std::string mtl_text(const ExportMesh& mesh, std::string_view png_name);

// model.glb: glTF 2.0 in one file, textured, with normals. Metres, y up, the face looks along +z:
// glTF fixes these, so a mesh in the camera frame is turned half way round x (its origin stays the
// left camera). _SIGMA_MM and _MEASURED travel along as attributes of a vertex.
// `png` is the mesh's texture; empty if it has none, then the vertices are coloured.
std::vector<std::byte> glb_bytes(const ExportMesh& mesh, std::span<const std::byte> png);

}  // namespace relievo::storage
