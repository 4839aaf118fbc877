// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <fstream>
#include <string_view>

#include <sodium.h>

#include "pipeline/match/region/face_region.h"

namespace relievo::pipeline {
namespace {

struct CascadeFile {
  std::string_view name, sha256;
};

constexpr std::array<CascadeFile, kFaceCascades> kFiles = {{
    {"haarcascade_frontalface_alt2.xml", "7b0c967d9abbdfbde025eb9c786947d151b6426040d07a8f9562ed8fd90724b4"},
    {"haarcascade_frontalface_default.xml",
     "0f7d4527844eb514d4a4948e822da90fbb16a34a0bbbbc6adc6498747a5aafb0"},
    {"haarcascade_frontalface_alt.xml", "6281df13459cc218ff047d02b2ae3859b12ff14a93ffe8952f7b33fad7b9697b"},
    {"haarcascade_profileface.xml", "b39a4a3be45539db146a7fc1d3e761a292c196eb88421185e6a615b3055e612d"},
}};
constexpr std::uintmax_t kLargestFile = 4 << 20;

}  // namespace

Result<std::string> read_cascade(const std::filesystem::path& folder, FaceCascade which) {
  const auto& [name, sha256] = kFiles[std::size_t(which)];
  const std::filesystem::path path = folder / name;
  std::error_code problem;
  const std::uintmax_t size = std::filesystem::file_size(path, problem);
  if (problem)
    return Error{Errc::NotFound, "no such face cascade: install the package opencv-data"}.at(path.string());
  const Error strange{Errc::StoreCorrupt, "not the face cascade of opencv-data 4.6.0: reinstall the package"};
  if (size > kLargestFile) return strange.at(path.string());
  std::string text(std::size_t(size), '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in.read(text.data(), static_cast<std::streamsize>(size))) return strange.at(path.string());
  std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(text.data()), text.size());
  std::array<char, 2 * digest.size() + 1> hex{};
  if (sodium_bin2hex(hex.data(), hex.size(), digest.data(), digest.size()) != sha256)
    return strange.at(path.string());
  return text;
}

}  // namespace relievo::pipeline
