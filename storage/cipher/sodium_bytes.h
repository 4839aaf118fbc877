// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bytes as libsodium takes them: of spans, vectors, arrays; what may not be written stays so.
#pragma once

#include <type_traits>

namespace relievo::storage {

template <typename Bytes>
auto* raw(Bytes&& bytes) {
  using Byte = std::remove_pointer_t<decltype(bytes.data())>;
  using Char = std::conditional_t<std::is_const_v<Byte>, const unsigned char, unsigned char>;
  return reinterpret_cast<Char*>(bytes.data());
}

}  // namespace relievo::storage
