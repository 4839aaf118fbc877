// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/true_surface.h"

#include <charconv>
#include <cstring>

#include "hal/whole_file.h"

namespace relievo::firmware::measure {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
constexpr std::size_t kVertexBytes = 12;
constexpr std::size_t kTriangleBytes = 13;  // a count of 3, three numbers

Error bad() {
  return Error{Errc::InvalidInput,
               "is no head of the simulated rig: 'relievo simulate face --truth' writes one"};
}

// Takes `text` off the front.
bool skip(std::string_view& rest, std::string_view text) {
  if (rest.substr(0, text.size()) != text) return false;
  rest.remove_prefix(text.size());
  return true;
}

bool number(std::string_view& rest, std::size_t& value) {
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc()) return false;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return true;
}

template <typename T>
T take(const char*& from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  from += sizeof value;
  return value;
}

}  // namespace

Result<Surface> parse_true_surface(std::string_view rest) {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  const bool known =
      skip(rest, "ply\nformat binary_little_endian 1.0\nelement vertex ") && number(rest, vertices) &&
      skip(rest, "\nproperty float x\nproperty float y\nproperty float z\nelement face ") &&
      number(rest, triangles) && skip(rest, "\nproperty list uchar int vertex_indices\nend_header\n");
  if (!known || vertices > kMaxFileBytes || triangles > kMaxFileBytes) return bad();
  if (rest.size() != vertices * kVertexBytes + triangles * kTriangleBytes) return bad();
  Surface surface;
  surface.vertices_mm.resize(vertices);
  surface.triangles.resize(triangles);
  const char* at = rest.data();
  for (Vec3f& v : surface.vertices_mm) {
    v.x = take<float>(at);
    v.y = take<float>(at);
    v.z = take<float>(at);
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return bad();
  }
  for (auto& t : surface.triangles) {
    if (take<std::uint8_t>(at) != 3) return bad();
    for (std::uint32_t& v : t) {
      v = take<std::uint32_t>(at);
      if (v >= vertices) return bad();
    }
  }
  return surface;
}

Result<Surface> read_true_surface(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const auto bytes, hal::read_whole_file(file, kMaxFileBytes));
  auto surface = parse_true_surface({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (!surface) return surface.error().at(file.string());
  return surface;
}

}  // namespace relievo::firmware::measure
