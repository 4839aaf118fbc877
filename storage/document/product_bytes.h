// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages' products as bytes and back, bit for bit: little-endian, arrays behind their length. What comes
// back hangs together (lengths fit, indices and places lie within), whoever wrote it. A model is model_blob's
// work. Errors: StoreCorrupt. May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::storage {

std::vector<std::byte> picture_bytes(const ImageView& picture);
std::vector<std::byte> pair_bytes(const pipeline::RectifiedPair& pair);
std::vector<std::byte> matches_bytes(const pipeline::MatchSet& matches);
std::vector<std::byte> cloud_bytes(const pipeline::PointCloud& cloud);
std::vector<std::byte> mesh_bytes(const pipeline::FaceMesh& mesh);
std::vector<std::byte> backdrop_bytes(const pipeline::Backdrop& backdrop);

// A view of the bytes.
Result<ImageView> picture_from(std::span<const std::byte> bytes);
Result<pipeline::RectifiedPair> pair_from(std::span<const std::byte> bytes,
                                          std::pmr::memory_resource* memory);
// Of this pair.
Result<pipeline::MatchSet> matches_from(std::span<const std::byte> bytes, const pipeline::RectifiedPair& pair,
                                        std::pmr::memory_resource* memory);
Result<pipeline::PointCloud> cloud_from(std::span<const std::byte> bytes, const pipeline::RectifiedPair& pair,
                                        std::pmr::memory_resource* memory);
Result<pipeline::FaceMesh> mesh_from(std::span<const std::byte> bytes, std::pmr::memory_resource* memory);
Result<pipeline::Backdrop> backdrop_from(std::span<const std::byte> bytes, std::pmr::memory_resource* memory);

}  // namespace relievo::storage
