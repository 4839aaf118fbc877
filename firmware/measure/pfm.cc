// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/pfm.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "hal/whole_file.h"

namespace relievo::firmware::compare {
namespace {

constexpr int kMostSidePx = 16384;
constexpr std::size_t kMostBytes = std::size_t{1} << 30;

// The next word of the header and the one white space after it.
std::string word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && std::isspace(static_cast<unsigned char>(text[begin])) != 0) ++begin;
  std::size_t end = begin;
  while (end < text.size() && end - begin < 32 && std::isspace(static_cast<unsigned char>(text[end])) == 0)
    ++end;
  std::string found(text.substr(begin, end - begin));
  text.remove_prefix(std::min(text.size(), end + 1));
  return found;
}

float float_of(const char* bytes, bool little) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), bytes, 4);
  if (!little) std::reverse(b.begin(), b.end());
  const std::uint32_t bits = static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8U |
                             static_cast<std::uint32_t>(b[2]) << 16U |
                             static_cast<std::uint32_t>(b[3]) << 24U;
  return std::bit_cast<float>(bits);
}

}  // namespace

Result<DisparityMap> read_pfm(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const auto bytes, hal::read_whole_file(file, kMostBytes));
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string magic = word(rest);
  // What is no number reads as 0, which is no width.
  const long width = std::strtol(word(rest).c_str(), nullptr, 10);
  const long height = std::strtol(word(rest).c_str(), nullptr, 10);
  const double scale = std::strtod(word(rest).c_str(), nullptr);
  const bool sane =
      magic == "Pf" && width > 0 && height > 0 && width <= kMostSidePx && height <= kMostSidePx && scale != 0;
  if (!sane || rest.size() != 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    return Error{Errc::InvalidInput, "is no whole PFM of one channel"}.at(file.string());
  DisparityMap map(static_cast<int>(width), static_cast<int>(height));
  for (int y = 0; y < map.height_px; ++y)
    for (int x = 0; x < map.width_px; ++x) {
      const float d = float_of(rest.data() + 4 * map.index(x, map.height_px - 1 - y), scale < 0);
      if (std::isfinite(d)) map.values[map.index(x, y)] = d;
    }
  return map;
}

std::vector<std::byte> pfm_of(const DisparityMap& map) {
  const std::string head =
      "Pf\n" + std::to_string(map.width_px) + " " + std::to_string(map.height_px) + "\n-1\n";
  std::vector<std::byte> out(head.size() + 4 * map.values.size());
  std::memcpy(out.data(), head.data(), head.size());
  std::byte* to = out.data() + head.size();
  for (int y = map.height_px - 1; y >= 0; --y)
    for (int x = 0; x < map.width_px; ++x) {
      const float d = map.known(x, y) ? map.at(x, y) : std::numeric_limits<float>::infinity();
      const auto bits = std::bit_cast<std::uint32_t>(d);
      for (unsigned shift = 0; shift < 32; shift += 8) *to++ = static_cast<std::byte>((bits >> shift) & 255U);
    }
  return out;
}

}  // namespace relievo::firmware::compare
