// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/recognition/mesh_file.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <system_error>

namespace relievo::bench {
namespace {

constexpr std::array<char, 8> kMagic{'r', 'l', 'v', 'm', 'e', 's', 'h', '1'};
constexpr std::uint64_t kMost = 4'000'000;

struct Head {
  std::array<char, 8> magic = kMagic;
  std::uint64_t vertices = 0, triangles = 0;
  pipeline::Vec3d across;
};

template <typename T>
void put(std::ofstream& out, const std::pmr::vector<T>& values) {
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
}

template <typename T>
void take(std::ifstream& in, std::pmr::vector<T>& values, std::uint64_t count) {
  values.resize(count);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

}  // namespace

Result<void> write_surface(const std::filesystem::path& file, const SeenSurface& surface) {
  const std::filesystem::path unfinished = file.string() + ".unfinished";
  {
    std::ofstream out(unfinished, std::ios::binary);
    const Head head{kMagic, surface.mesh.vertices_mm.size(), surface.mesh.triangles.size(), surface.across};
    out.write(reinterpret_cast<const char*>(&head), sizeof head);
    put(out, surface.mesh.vertices_mm);
    put(out, surface.mesh.normals);
    put(out, surface.mesh.sigma_mm);
    put(out, surface.mesh.measured);
    put(out, surface.mesh.triangles);
    if (!out.flush()) return Error{Errc::IoFailed, "cannot write this file"}.at(unfinished.string());
  }
  std::error_code failed;
  std::filesystem::rename(unfinished, file, failed);
  if (failed)
    return Error{Errc::IoFailed, "cannot give this file its name", failed.value()}.at(file.string());
  return {};
}

Result<SeenSurface> read_surface(const std::filesystem::path& file, std::pmr::memory_resource* memory) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{Errc::NotFound, "is not there"}.at(file.string());
  Head head;
  in.read(reinterpret_cast<char*>(&head), sizeof head);
  if (!in || head.magic != kMagic || head.vertices > kMost || head.triangles > kMost)
    return Error{Errc::InvalidInput, "is no surface of this proof: remove it"}.at(file.string());
  SeenSurface surface(memory);
  surface.across = head.across;
  take(in, surface.mesh.vertices_mm, head.vertices);
  take(in, surface.mesh.normals, head.vertices);
  take(in, surface.mesh.sigma_mm, head.vertices);
  take(in, surface.mesh.measured, head.vertices);
  take(in, surface.mesh.triangles, head.triangles);
  if (!in) return Error{Errc::InvalidInput, "is cut short: remove it"}.at(file.string());
  for (const auto& t : surface.mesh.triangles)
    for (const std::uint32_t v : t)
      if (v >= head.vertices)
        return Error{Errc::InvalidInput, "is no surface of this proof: remove it"}.at(file.string());
  return surface;
}

}  // namespace relievo::bench
