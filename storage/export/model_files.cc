// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/model_files.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <functional>
#include <new>
#include <span>
#include <system_error>

#include "hal/base/whole_file.h"
#include "hal/picture_file.h"
#include "storage/byte_order.h"
#include "storage/export/format/export_mesh.h"

namespace relievo::storage {
namespace {

using pipeline::Portrait;
using pipeline::RangeImage;

constexpr double kHeightsPerMm = 100;
constexpr long kZeroHeight = 32768;
constexpr double kSigmasPerMm = 1000;

std::uint8_t level(bool photographed, bool completed) { return photographed ? 255 : completed ? 128 : 0; }

std::vector<std::uint8_t> visible(const std::pmr::vector<std::uint8_t>& shows) {
  std::vector<std::uint8_t> grey(shows.size());
  std::ranges::transform(shows, grey.begin(), [](std::uint8_t s) {
    return level(s == pipeline::kMeasuredShown, s == pipeline::kCompletedShown);
  });
  return grey;
}

// 0 where nothing is shown.
std::vector<std::uint16_t> greys(const RangeImage& range, const std::pmr::vector<float>& values,
                                 const auto& grey_of) {
  std::vector<std::uint16_t> grey(values.size(), 0);
  for (std::size_t k = 0; k < grey.size(); ++k)
    if (range.shows[k] != pipeline::kNothingShown)
      grey[k] = std::uint16_t(std::clamp(std::lround(grey_of(double(values[k]))), 1L, 65535L));
  return grey;
}

std::vector<std::uint16_t> heights(const RangeImage& range) {
  return greys(range, range.z_mm, [](double mm) { return mm * kHeightsPerMm + kZeroHeight; });
}

std::vector<std::uint16_t> sigmas(const RangeImage& range) {
  return greys(range, range.sigma_mm, [](double mm) { return std::min(mm, 65.0) * kSigmasPerMm; });
}

std::string list(std::initializer_list<double> numbers) {
  std::string text = "[";
  for (const double n : numbers) {
    if (text.size() > 1) text += ", ";
    append_rounded(text, n, 3);
  }
  return text + "]";
}

std::string field(const char* name, double number) {
  std::string text = std::string("\"") + name + "\": ";
  append_rounded(text, number, 4);
  return text;
}

std::string eyes_text(const Portrait& p) {
  if (!(p.between_eyes_mm > 0)) return "    \"eyes_found\": false\n";
  return "    \"eyes_found\": true, \"right_eye_px\": " + list({p.right_eye_px.x, p.right_eye_px.y}) +
         ", \"left_eye_px\": " + list({p.left_eye_px.x, p.left_eye_px.y}) + ",\n    " +
         field("between_eyes_mm", p.between_eyes_mm) + ", " +
         field("between_eyes_px",
               std::hypot(p.left_eye_px.x - p.right_eye_px.x, p.left_eye_px.y - p.right_eye_px.y)) +
         "\n";
}

std::string portrait_text(const Portrait& p) {
  return "  \"portrait\": {\n    \"file\": \"portrait.png\", \"shows\": \"portrait_shows.png\", " +
         field("width_px", p.width_px) + ", " + field("height_px", p.height_px) + ",\n    " +
         field("mm_per_px_at_the_eyes", p.mm_per_px) + ", " + field("camera_mm_from_the_eyes", p.camera_mm) +
         ",\n    \"eyes_middle_px\": " + list({p.eyes_px.x, p.eyes_px.y}) +
         ", \"eyes_middle_mm\": " + list({p.eyes_mm.x, p.eyes_mm.y, p.eyes_mm.z}) + ",\n" + eyes_text(p) +
         "  },\n";
}

std::string range_text(const RangeImage& r) {
  return "  \"range\": {\n    \"file\": \"range.png\", \"sigma\": \"range_sigma.png\", \"shows\": \"range_shows.png\", " +
         field("width_px", r.width_px) + ", " + field("height_px", r.height_px) + ",\n    " +
         field("pitch_mm", r.pitch_mm) + ", \"first_pixel_xy_mm\": " + list({r.first_mm.x, r.first_mm.y}) +
         ",\n    \"x_mm\": \"first x + pitch * column\", \"y_mm\": \"first y - pitch * row\",\n"
         "    \"z_mm\": \"(value - 32768) / 100; value 0: nothing there\", \"sigma_mm\": \"value / 1000: one standard deviation along z\"\n  }\n";
}

// Those that were found, in the head frame.
std::string landmarks_text(const Portrait& p, const pipeline::Landmarks& landmarks,
                           const pipeline::RigidTransform& head_from_camera) {
  std::string text;
  for (std::size_t k = 0; k < pipeline::kLandmarkCount; ++k) {
    const pipeline::Landmark& l = landmarks[k];
    const pipeline::Vec3d at =
        apply(head_from_camera, {double(l.at_mm.x), double(l.at_mm.y), double(l.at_mm.z)});
    if (!l.found || !(std::hypot(at.x, at.y, at.z) < 1e4) || !(l.sigma_mm >= 0 && l.sigma_mm < 1e4F))
      continue;
    const pipeline::Vec2d px = p.place_of(at);
    text += text.empty() ? "" : ",\n";
    text += "    \"" + std::string(word(static_cast<pipeline::LandmarkName>(k))) +
            "\": {\"mm\": " + list({at.x, at.y, at.z}) + ", " + field("sigma_mm", double(l.sigma_mm)) +
            ", \"portrait_px\": " + list({px.x, px.y}) + "}";
  }
  return "  \"landmarks\": {" + (text.empty() ? std::string() : "\n" + text + "\n  ") + "},\n";
}

template <class Pixels>
Result<std::vector<std::byte>> png_of(int width_px, int height_px, const Pixels& pixels, PixelFormat format) {
  const auto bytes = std::as_bytes(std::span(pixels));
  const int row_bytes = width_px * bytes_per_pixel(format);
  if (bytes.size() != std::size_t(row_bytes) * std::size_t(height_px))
    return invalid("the picture's size does not fit its pixels");
  return hal::encode_png({bytes.data(), width_px, height_px, row_bytes, format}, {.is_srgb = true});
}

std::string page(const pipeline::RecognitionImages& images, const pipeline::Landmarks& landmarks,
                 const pipeline::RigidTransform& head_from_camera, std::string_view version) {
  return "{\n  \"generator\": \"Relievo" + (version.empty() ? std::string() : " " + std::string(version)) +
         "\",\n  \"units\": \"millimetres, pixels\",\n"
         "  \"frame\": \"head: origin at the tip of the nose, x to the person's left, y up, z out of the face\",\n"
         "  \"pixels\": \"(0, 0) is the centre of the upper left one; seen from the front, x grows to the right\",\n"
         "  \"shows\": \"0 nothing, 128 surface that was completed, 255 surface that was measured\",\n" +
         portrait_text(images.portrait) + landmarks_text(images.portrait, landmarks, head_from_camera) +
         range_text(images.range) + "}\n";
}

namespace fs = std::filesystem;

Result<void> make_directory(const fs::path& dir) {
  std::error_code failed, not_there;
  fs::create_directories(dir, failed);
  if (fs::is_directory(dir, not_there)) return {};
  const bool full = failed.value() == ENOSPC || failed.value() == EDQUOT;
  return Error{full ? Errc::MediaFull : Errc::IoFailed,
               "this directory cannot be made: check the path, its permissions and the room on the disk",
               failed.value()}
      .at(dir.string());
}

class Batch {
 public:
  explicit Batch(const fs::path& dir) : dir_(dir) {}

  // The first makes the directory; one that is gone after that is not made anew.
  Result<void> add(std::string_view name, std::span<const std::byte> bytes) {
    if (files_.empty()) RELIEVO_TRY(make_directory(dir_));
    RELIEVO_TRY_ASSIGN(auto file, PendingFile::create(dir_ / name));
    RELIEVO_TRY(file.write(bytes));
    RELIEVO_TRY(file.finish());
    files_.push_back(std::move(file));
    return {};
  }

  // A file is renamed only after those it names.
  Result<std::vector<fs::path>> publish() {
    std::vector<fs::path> written;
    for (auto& file : files_) written.push_back(file.target());
    for (auto& file : files_) RELIEVO_TRY(file.publish());
    RELIEVO_TRY(sync_directory(dir_));
    return written;
  }

 private:
  const fs::path& dir_;
  std::vector<PendingFile> files_;
};

Result<std::vector<std::byte>> origin_png(const pipeline::TextureAtlas& texture) {
  std::vector<std::uint8_t> grey(texture.origin.size());
  std::ranges::transform(texture.origin, grey.begin(), [](std::uint8_t o) {
    return level(o >= pipeline::kLeftPhotographTexel, o == pipeline::kFilledTexel);
  });
  return png_of(texture.width_px, texture.height_px, grey, PixelFormat::Grey8);
}

// Each file once it is made, so that one at a time lies in memory.
using Take = std::function<Result<void>(const std::string& name, std::span<const std::byte> bytes)>;

Result<void> make_all(const pipeline::FaceModel& model, const ExportOptions& options, const Take& take) {
  RELIEVO_TRY_ASSIGN(ExportMesh mesh, make_export_mesh(model, options.frame));
  mesh.version = options.version;
  const auto name = [&options](const char* ending) { return std::string(options.stem) + ending; };
  RELIEVO_TRY(take(name(".ply"), ply_bytes(mesh)));
  RELIEVO_TRY(take(name(".stl"), stl_bytes(mesh)));
  std::vector<std::byte> png;
  if (mesh.textured()) {
    RELIEVO_TRY_ASSIGN(
        png, png_of(model.texture.width_px, model.texture.height_px, model.texture.rgb, PixelFormat::Rgb8));
    RELIEVO_TRY(take(name(".png"), png));
    if (!model.texture.origin.empty()) {
      RELIEVO_TRY_ASSIGN(const auto origin, origin_png(model.texture));
      RELIEVO_TRY(take(name("_origin.png"), origin));
    }
  }
  RELIEVO_TRY(take(name(".mtl"), bytes_of(mtl_text(mesh, name(".png")))));
  RELIEVO_TRY(take(name(".obj"), bytes_of(obj_text(mesh, name(".mtl")))));
  RELIEVO_TRY(take(name(".glb"), glb_bytes(mesh, png)));
  if (options.images == nullptr) return {};
  RELIEVO_TRY_ASSIGN(const auto files, recognition_files(*options.images, model.landmarks,
                                                         model.head_from_camera, options.version));
  for (const BundleFile& file : files) RELIEVO_TRY(take(file.name, file.bytes));
  return {};
}

}  // namespace

Result<std::vector<BundleFile>> recognition_files(const pipeline::RecognitionImages& images,
                                                  const pipeline::Landmarks& landmarks,
                                                  const pipeline::RigidTransform& head_from_camera,
                                                  std::string_view version) {
  const Portrait& p = images.portrait;
  const RangeImage& r = images.range;
  std::vector<BundleFile> files;
  const auto add = [&](const char* name, Result<std::vector<std::byte>> bytes) -> Result<void> {
    if (!bytes) return bytes.error();
    files.push_back({name, *std::move(bytes)});
    return {};
  };
  RELIEVO_TRY(add("portrait.png", png_of(p.width_px, p.height_px, p.rgb, PixelFormat::Rgb8)));
  RELIEVO_TRY(
      add("portrait_shows.png", png_of(p.width_px, p.height_px, visible(p.shows), PixelFormat::Grey8)));
  RELIEVO_TRY(add("range.png", png_of(r.width_px, r.height_px, heights(r), PixelFormat::Grey16)));
  RELIEVO_TRY(add("range_sigma.png", png_of(r.width_px, r.height_px, sigmas(r), PixelFormat::Grey16)));
  RELIEVO_TRY(add("range_shows.png", png_of(r.width_px, r.height_px, visible(r.shows), PixelFormat::Grey8)));
  const std::string text = page(images, landmarks, head_from_camera, version);
  const auto bytes = bytes_of(text);
  files.push_back({"recognition.json", {bytes.begin(), bytes.end()}});
  return files;
}

Result<std::vector<fs::path>> write_model_files(const pipeline::FaceModel& model, const fs::path& dir,
                                                const ExportOptions& options) {
  try {
    Batch batch(dir);
    RELIEVO_TRY(make_all(model, options, [&batch](const std::string& name, std::span<const std::byte> bytes) {
      return batch.add(name, bytes);
    }));
    return batch.publish();
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "not enough memory to write the model; nothing was written"};
  }
}

Result<std::vector<BundleFile>> make_model_files(const pipeline::FaceModel& model,
                                                 const ExportOptions& options) {
  std::vector<BundleFile> files;
  const Take keep = [&](const std::string& name, std::span<const std::byte> bytes) {
    files.push_back({name, {bytes.begin(), bytes.end()}});
    return Result<void>();
  };
  RELIEVO_TRY(make_all(model, options, keep));
  return files;
}

}  // namespace relievo::storage
