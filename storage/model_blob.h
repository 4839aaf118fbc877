// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stored form of a face model: mesh, texture, head frame and quality in one piece of bytes.
//
// Little-endian:
//   "RFACE\0" u16 version | 5 x u32 vertices triangles width_px height_px flags | 12 f64 head_from_camera
//   | 9 f64 quality | 10 landmarks: x y z sigma f32, found u8 | 6 f64 relief | vertices 3 f32 | normals 3 f32
//   | sigma f32 | measured u8 | triangles 3 u32 | texture rgb | uv 2 f32 a corner | vertex rgb | texture
//   origin u8 | pose u8 (of a head from several pairs) | SHA-256 of all before it
// Still read: version 1 with 7 figures of quality, no origin and no landmarks; version 2 with 8 and no
// landmarks; version 3 without relief; version 4 without pose. Every number comes back bit for bit. The
// length follows from the header alone, so a cut piece, a longer piece and hostile sizes are refused before
// anything is allocated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"

namespace relievo::storage {

inline constexpr std::uint32_t kMaxModelVertices = 4'000'000;
inline constexpr std::uint32_t kMaxModelTriangles = 8'000'000;
inline constexpr std::uint32_t kMaxTextureSidePx = 8192;

// The figures of quality in their order, and what files for others call them.
struct QualityFigure {
  const char* name;
  double pipeline::ModelQuality::*of;
};
inline constexpr QualityFigure kQualityFigures[] = {
    {"median_sigma_mm", &pipeline::ModelQuality::median_sigma_mm},
    {"measured_area_mm2", &pipeline::ModelQuality::measured_area_mm2},
    {"coverage", &pipeline::ModelQuality::coverage},
    {"width_mm", &pipeline::ModelQuality::width_mm},
    {"height_mm", &pipeline::ModelQuality::height_mm},
    {"nose_relief_mm", &pipeline::ModelQuality::nose_relief_mm},
    {"epipolar_residual_px", &pipeline::ModelQuality::epipolar_residual_px},
    {"texture_sharpness", &pipeline::ModelQuality::texture_sharpness},
    {"symmetry_residual_mm", &pipeline::ModelQuality::symmetry_residual_mm}};

// InvalidInput: arrays whose lengths do not fit together, an index out of range. Normals, sigma, measured,
// vertex colours, texture and pose may be absent as a whole.
Result<void> check_arrays(const pipeline::FaceModel& model);

// InvalidInput: as check_arrays(), or more than the limits above. May throw std::bad_alloc, as may
// decode_model().
Result<std::vector<std::byte>> encode_model(const pipeline::FaceModel& model);

// StoreCorrupt: not such a piece, cut, changed; StoreNewer: a version of the form not known here.
Result<pipeline::FaceModel> decode_model(std::span<const std::byte> bytes, std::pmr::memory_resource* memory);

}  // namespace relievo::storage
