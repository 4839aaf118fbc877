// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers to little-endian bytes and back, the same on every machine. Floating point goes by its
// bits: NaN payloads and negative zero survive.
//
// A form of bytes has one walk over its fields, walk(io, fields): a ByteWriter writes them, a ByteReader
// reads them, and the two cannot differ.
#pragma once

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

  template <Number... T>
  void numbers(const T&... values) {
    (put(values), ...);
  }
  void flag(bool set) { put(std::uint8_t(set)); }
  void text(std::string_view text) {  // behind its length
    put(std::uint32_t(text.size()));
    put(std::as_bytes(std::span(text)));
  }
  // `items` by their elements: as many as the reader is told, or behind their number.
  template <typename Element, typename Items>
  void run(const Items& items, std::size_t /*count*/) {
    put_run<Element>(std::span(items));
  }
  template <typename Element, typename Items>
  void run(const Items& items) {
    put(std::uint64_t(items.size()));
    put_run<Element>(std::span(items));
  }
  template <typename Items, typename Field>
  void each(const Items& items, const Field& field) {
    put(std::uint64_t(items.size()));
    for (const auto& item : items) field(*this, item);
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
  bool whole() const { return ok_ && rest_.empty(); }  // all was there, and no more

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

  template <Number... T>
  void numbers(T&... values) {
    ((values = get<T>()), ...);
  }
  void flag(bool& set) { set = get<std::uint8_t>() != 0; }
  void text(std::string& text) {
    const auto size = get<std::uint32_t>();
    if (size > left()) return fail();
    text.resize(size);
    get_run<char>(std::span(text));
  }
  template <typename Element, typename Items>
  void run(Items& items, std::size_t count) {
    items.resize(count);
    get_run<Element>(std::span(items));
  }
  // A number of items that the bytes cannot hold allocates nothing.
  template <typename Element, typename Items>
  void run(Items& items) {
    const auto count = get<std::uint64_t>();
    if (count <= left() / sizeof(typename Items::value_type)) run<Element>(items, std::size_t(count));
    else fail();
  }
  template <typename Items, typename Field>
  void each(Items& items, const Field& field) {
    const auto count = get<std::uint64_t>();
    if (count > left()) return fail();
    items.resize(std::size_t(count));
    for (auto& item : items) field(*this, item);
  }

 private:
  void fail() {
    ok_ = false;
    rest_ = {};
  }
  bool take(std::size_t size) {
    if (size > rest_.size()) {
      fail();
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
inline std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace relievo::storage
