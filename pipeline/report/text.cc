// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/page.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "hal/base/utf8.h"

namespace relievo::pipeline::report {
namespace {

constexpr std::string_view kUnknown = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::string_view kMinus = "\xE2\x88\x92";
constexpr std::string_view kDash = "\xE2\x80\x93";

std::string fixed(double value, int decimals) {
  std::array<char, 400> text{};
  const auto done =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
  std::string out(text.data(), done.ptr);
  // "-0.00" is nought.
  if (out.front() == '-' && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
  return out;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Utf8Letter letter = first_letter_of(text);
    const std::string_view one = text.substr(0, std::max<std::size_t>(letter.bytes, 1));
    text.remove_prefix(one.size());
    if (letter.bytes == 0 || is_control(letter.code)) out += kUnknown;
    else if (one == "&") out += "&amp;";
    else if (one == "<") out += "&lt;";
    else if (one == ">") out += "&gt;";
    else if (one == "\"") out += "&quot;";
    else if (one == "'") out += "&#39;";
    else out += one;
  }
  return out;
}

std::string linked(std::string_view file_name) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._~-";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out;
  for (const char c : file_name) {
    const auto byte = static_cast<unsigned char>(c);
    if (kPlain.find(c) != std::string_view::npos) out += c;
    else (((out += '%') += kHex[byte >> 4U]) += kHex[byte & 15U]);
  }
  return out;
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = (three << 8U) | (i + k < bytes.size() ? std::uint32_t(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += k > bytes.size() - i ? '=' : kDigits[(three >> (18 - 6 * k)) & 63U];
  }
  return out;
}

std::string figure(double value, int decimals) {
  if (!std::isfinite(value)) return std::string(kDash);
  std::string out = fixed(value, decimals);
  if (out.front() == '-') out.replace(0, 1, kMinus);
  return out;
}

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "0";
  std::string out = fixed(value, decimals);
  if (out.find('.') == std::string::npos) return out;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

int decimals_for(double sigma) {
  if (!(sigma > 0) || !std::isfinite(sigma)) return 3;
  return std::clamp(1 - int(std::floor(std::log10(sigma))), 0, 7);
}

int decimals_of(double value) {
  if (value > 0 && value < 0.00095) return 4;
  return value < 0.0995 ? 3 : value < 99.95 ? 2 : 0;
}

std::string counted(int count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

std::string sentence(std::string_view reason) {
  std::string out(reason);
  if (out.empty()) return out;
  if (out.front() >= 'a' && out.front() <= 'z') out.front() = char(out.front() - 'a' + 'A');
  if (out.back() != '.') out += '.';
  if (const auto at = out.find("+-"); at != std::string::npos) out.replace(at, 2, "±");
  return out;
}

}  // namespace relievo::pipeline::report
