// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages' products as bytes and back, bit for bit: little-endian, arrays behind their length. What comes
// back hangs together (lengths fit, indices and places lie within), whoever wrote it. A model is model_blob's
// work. Errors: InvalidInput. May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace relievo::storage {

std::vector<std::byte> picture_bytes(const ImageView& picture);
Result<ImageView> picture_from(std::span<const std::byte> bytes);  // a view of the bytes

// RectifiedPair; MatchSet and PointCloud, each `beside` the pair that it is of; FaceMesh; Backdrop.
template <typename Product>
std::vector<std::byte> product_bytes(const Product& product);
template <typename Product, typename... Beside>
Result<Product> product_from(std::span<const std::byte> bytes, std::pmr::memory_resource* memory,
                             const Beside&... beside);

}  // namespace relievo::storage
