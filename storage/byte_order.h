// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers to little-endian bytes and back, the same on every machine. Floating point goes by its
// bits: NaN payloads and negative zero survive.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace relievo::storage {

template <typename T>
concept Number = std::is_arithmetic_v<T>;

// Arrays of these are runs of floats or integers of one size, without padding.
template <typename Item, typename Element>
concept RunOf = std::is_trivially_copyable_v<Item> && sizeof(Item) % sizeof(Element) == 0 &&
                alignof(Item) == alignof(Element);

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>& out) : out_(out) {}

  template <Number T>
  void put(T value) {
    std::byte raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    put_element(raw, sizeof(T));
  }
  void put(std::span<const std::byte> bytes) {
    if (bytes.empty()) return;
    const std::size_t at = out_.size();
    out_.resize(at + bytes.size());
    std::memcpy(out_.data() + at, bytes.data(), bytes.size());
  }

  template <typename Element, RunOf<Element> Item>
  void put_run(std::span<const Item> items) {
    const auto bytes = std::as_bytes(items);
    if constexpr (std::endian::native == std::endian::little) {
      put(bytes);
    } else {
      for (std::size_t at = 0; at < bytes.size(); at += sizeof(Element)) {
        put_element(bytes.data() + at, sizeof(Element));
      }
    }
  }

 private:
  void put_element(const std::byte* raw, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      out_.push_back(raw[std::endian::native == std::endian::little ? i : size - 1 - i]);
    }
  }
  std::vector<std::byte>& out_;
};

// Reading past the end yields zeros and ok() == false: check the length first, or ok() last.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  bool ok() const { return ok_; }
  std::size_t left() const { return rest_.size(); }

  template <Number T>
  T get() {
    T value{};
    if (take(sizeof(T))) copy_element(reinterpret_cast<std::byte*>(&value), sizeof(T));
    return value;
  }

  template <typename Element, RunOf<Element> Item>
  void get_run(std::span<Item> items) {
    const auto target = std::as_writable_bytes(items);
    if (target.empty() || !take(target.size())) return;
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(target.data(), taken_.data(), target.size());
    } else {
      const auto all = taken_;
      for (std::size_t at = 0; at < target.size(); at += sizeof(Element)) {
        taken_ = all.subspan(at, sizeof(Element));
        copy_element(target.data() + at, sizeof(Element));
      }
    }
  }

 private:
  bool take(std::size_t size) {
    if (size > rest_.size()) {
      ok_ = false;
      rest_ = {};
      return false;
    }
    taken_ = rest_.first(size);
    rest_ = rest_.subspan(size);
    return true;
  }
  void copy_element(std::byte* target, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      target[std::endian::native == std::endian::little ? i : size - 1 - i] = taken_[i];
    }
  }
  std::span<const std::byte> rest_;
  std::span<const std::byte> taken_;
  bool ok_ = true;
};

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

// A text behind its length.
inline void put_text(ByteWriter& to, std::string_view text) {
  to.put(std::uint32_t(text.size()));
  to.put(bytes_of(text));
}

inline std::string get_text(ByteReader& from) {
  const auto size = from.get<std::uint32_t>();
  std::string text;
  text.resize(std::min<std::size_t>(size, from.left()));
  from.get_run<char>(std::span(text));
  return text;
}

}  // namespace relievo::storage
