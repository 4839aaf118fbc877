// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers to little-endian bytes and back: as they lie in the memory of the machines this runs on. Floating
// point goes by its bits: NaN payloads and negative zero survive. And bytes as libsodium takes them.
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

static_assert(std::endian::native == std::endian::little);

template <typename T>
concept Number = std::is_arithmetic_v<T>;

// Their items are floats or integers of one size, without padding.
template <typename Items, typename Element, typename Item = typename Items::value_type>
concept RunsOf = std::is_trivially_copyable_v<Item> && sizeof(Item) % sizeof(Element) == 0 &&
                 alignof(Item) == alignof(Element);

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>& out) : out_(out) {}

  template <Number T>
  void put(T value) {
    put(std::as_bytes(std::span(&value, 1)));
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
  template <typename Element, RunsOf<Element> Items>
  void run(const Items& items, std::size_t /*count*/) {
    put(std::as_bytes(std::span(items)));
  }
  template <typename Element, RunsOf<Element> Items>
  void run(const Items& items) {
    put(std::uint64_t(items.size()));
    put(std::as_bytes(std::span(items)));
  }
  template <typename Items, typename Field>
  void each(const Items& items, const Field& field) {
    put(std::uint64_t(items.size()));
    for (const auto& item : items) field(*this, item);
  }

 private:
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
    get(std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }
  void get(std::span<std::byte> bytes) {
    if (bytes.size() > rest_.size()) return fail();
    if (bytes.empty()) return;
    std::memcpy(bytes.data(), rest_.data(), bytes.size());
    rest_ = rest_.subspan(bytes.size());
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
    get(std::as_writable_bytes(std::span(text)));
  }
  template <typename Element, RunsOf<Element> Items>
  void run(Items& items, std::size_t count) {
    items.resize(count);
    get(std::as_writable_bytes(std::span(items)));
  }
  // A number of items that the bytes cannot hold allocates nothing.
  template <typename Element, RunsOf<Element> Items>
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
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}
inline std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Bytes as libsodium takes them: of spans, vectors, arrays; what may not be written stays so.
template <typename Bytes>
auto* raw(Bytes&& bytes) {
  using Byte = std::remove_pointer_t<decltype(bytes.data())>;
  using Char = std::conditional_t<std::is_const_v<Byte>, const unsigned char, unsigned char>;
  return reinterpret_cast<Char*>(bytes.data());
}

}  // namespace relievo::storage
