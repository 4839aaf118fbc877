// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/region/checked_file.h"

#include <cstdint>
#include <fstream>
#include <span>

#include "pipeline/match/region/checksum.h"

namespace relievo::pipeline {
namespace {

constexpr std::uintmax_t kLargestFile = 4 << 20;

}  // namespace

Result<std::string> read_checked(const std::filesystem::path& path, std::string_view sha256_hex) {
  std::error_code problem;
  const std::uintmax_t size = std::filesystem::file_size(path, problem);
  if (problem)
    return Error{Errc::NotFound, "no such face cascade: install the package opencv-data"}.at(path.string());
  const Error strange{Errc::StoreCorrupt, "not the face cascade of opencv-data 4.6.0: reinstall the package"};
  if (size > kLargestFile) return strange.at(path.string());
  std::string text(static_cast<std::size_t>(size), '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in.read(text.data(), static_cast<std::streamsize>(size))) return strange.at(path.string());
  if (!reads_as(sha256(std::as_bytes(std::span(text.data(), text.size()))), sha256_hex))
    return strange.at(path.string());
  return text;
}

}  // namespace relievo::pipeline
