// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/chain/chain_record.h"

#include <fstream>
#include <type_traits>

#include "hal/picture_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/pipeline.h"
#include "tests/support/stage_fixture.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: a bench of the pipeline

constexpr std::uint64_t kMagic = 0x3149'4148'4356'4c52;  // "RLVCHAI1"
constexpr std::uint64_t kMost = 100'000'000;

template <typename T>
std::vector<T> kept(const std::pmr::vector<T>& values) {
  return {values.begin(), values.end()};
}

template <typename T>
void put(std::ofstream& out, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::uint64_t count = values.size();
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

template <typename T>
void take(std::ifstream& in, std::vector<T>& values) {
  std::uint64_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  if (!in || count > kMost) return in.setstate(std::ios::failbit);
  values.resize(count);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

// The record's parts in the order of the file.
template <typename Record, typename Visit>
void for_each_part(Record& record, Visit visit) {
  visit(record.left_grey);
  visit(record.right_grey);
  visit(record.matches);
  visit(record.points);
  visit(record.vertices_mm);
  visit(record.triangles);
  visit(record.rgb);
}

}  // namespace

Result<ChainRecord> record_chain(const ChainPictures& pictures, int threads) {
  RELIEVO_TRY_ASSIGN(const hal::Picture left, hal::read_picture(pictures.left));
  RELIEVO_TRY_ASSIGN(const hal::Picture right, hal::read_picture(pictures.right));
  RELIEVO_TRY_ASSIGN(const StereoCalibration calibration, read_calibration(pictures.calibration));
  RELIEVO_TRY_ASSIGN(const Pipeline stages, Pipeline::make({}, calibration));
  test::StageFixture room(std::size_t{256} << 20, std::size_t{512} << 20, threads);
  ChainRecord record;
  const auto stage = [&room](auto call) {
    auto product = call(room.context);
    room.scratch.reset();
    return product;
  };
  const StereoFrame frame{left.view(), right.view(), 0, 0};
  RELIEVO_TRY_ASSIGN(RectifiedPair pair, stage([&](StageContext& c) { return stages.rectify(frame, c); }));
  record.left_grey = kept(pair.left.grey), record.right_grey = kept(pair.right.grey);
  RELIEVO_TRY_ASSIGN(const MatchSet matches, stage([&](StageContext& c) { return stages.match(pair, c); }));
  for (const Match& m : matches.matches)
    record.matches.push_back({m.left_px.x, m.left_px.y, m.disparity_px, m.sigma_px, m.rejected_by});
  RELIEVO_TRY_ASSIGN(const PointCloud cloud,
                     stage([&](StageContext& c) { return stages.reconstruct(pair, matches, c); }));
  record.points = kept(cloud.points);
  RELIEVO_TRY_ASSIGN(FaceMesh mesh, stage([&](StageContext& c) { return stages.mesh(cloud, pair, c); }));
  RELIEVO_TRY_ASSIGN(TextureAtlas texture,
                     stage([&](StageContext& c) { return stages.texture(mesh, pair, c); }));
  RELIEVO_TRY_ASSIGN(const FaceModel model, stage([&](StageContext& c) {
                       return stages.assemble(std::move(mesh), std::move(texture), pair, c);
                     }));
  record.vertices_mm = kept(model.mesh.vertices_mm), record.triangles = kept(model.mesh.triangles);
  record.rgb = kept(model.texture.rgb);
  return record;
}

Result<void> write_record(const std::filesystem::path& file, const ChainRecord& record) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&kMagic), sizeof kMagic);
  for_each_part(record, [&out](const auto& part) { put(out, part); });
  if (!out.flush()) return Error{Errc::IoFailed, "cannot write this file"}.at(file.string());
  return {};
}

Result<ChainRecord> read_record(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{Errc::NotFound, "is not there"}.at(file.string());
  std::uint64_t magic = 0;
  in.read(reinterpret_cast<char*>(&magic), sizeof magic);
  ChainRecord record;
  if (magic == kMagic) for_each_part(record, [&in](auto& part) { take(in, part); });
  if (magic != kMagic || !in)
    return Error{Errc::InvalidInput, "is no whole record of this bench: make it anew"}.at(file.string());
  for (const auto& triangle : record.triangles)
    for (const std::uint32_t v : triangle)
      if (v >= record.vertices_mm.size())
        return Error{Errc::InvalidInput, "is no record of this bench: make it anew"}.at(file.string());
  return record;
}

}  // namespace relievo::bench
