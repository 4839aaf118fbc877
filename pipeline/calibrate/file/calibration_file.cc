// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/file/calibration_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pipeline/calibrate/file/yaml_fields.h"

namespace relievo::pipeline {
namespace {

class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() { close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int get() const { return descriptor_; }
  bool close() {
    const int descriptor = std::exchange(descriptor_, -1);
    return descriptor < 0 || ::close(descriptor) == 0;
  }

 private:
  int descriptor_;
};

Error failed(Literal what, const std::filesystem::path& file) {
  const Errc code = errno == ENOENT                      ? Errc::NotFound
                    : errno == ENOSPC || errno == EDQUOT ? Errc::MediaFull
                                                         : Errc::IoFailed;
  Error error{code, what};
  error.sys_errno = errno;
  return error.at(file.native());
}

Error missing(Literal what, std::string_view field) { return Error{Errc::InvalidInput, what}.at(field); }

Result<int> whole_number(const YamlFields& fields, std::string_view name) {
  const auto found = fields.numbers.find(name);
  if (found == fields.numbers.end())
    return missing("this field is missing or no number; the file is damaged or no calibration", name);
  const double number = found->second;
  if (!(number >= 1 && number <= 1e6) || number != std::floor(number))
    return missing("must be a whole number of pixels", name);
  return static_cast<int>(number);
}

Result<const YamlMatrix*> matrix(const YamlFields& fields, std::string_view name, int rows, int cols) {
  const auto found = fields.matrices.find(name);
  if (found == fields.matrices.end())
    return missing("this matrix is missing; the file is damaged or no stereo calibration", name);
  if (found->second.rows != rows || found->second.cols != cols)
    return missing("this matrix has the wrong size for a stereo calibration", name);
  return &found->second;
}

Result<void> read_camera(const YamlFields& fields, std::string_view k_name, std::string_view d_name,
                         CameraIntrinsics& camera) {
  RELIEVO_TRY_ASSIGN(camera.width_px, whole_number(fields, "image_width"));
  RELIEVO_TRY_ASSIGN(camera.height_px, whole_number(fields, "image_height"));
  RELIEVO_TRY_ASSIGN(const YamlMatrix* k, matrix(fields, k_name, 3, 3));
  const auto& v = k->values;
  if (v[1] != 0 || v[3] != 0 || v[6] != 0 || v[7] != 0 || v[8] != 1)
    return missing("must be [fx 0 cx; 0 fy cy; 0 0 1]", k_name);
  camera.focal_px = {v[0], v[4]};
  camera.centre_px = {v[2], v[5]};
  const auto found = fields.matrices.find(d_name);
  if (found == fields.matrices.end())
    return missing("this matrix is missing; the file is damaged or no stereo calibration", d_name);
  const YamlMatrix& d = found->second;
  if ((d.rows != 1 && d.cols != 1) || (d.values.size() != 4 && d.values.size() != 5 && d.values.size() != 8 &&
                                       d.values.size() != 12 && d.values.size() != 14))
    return missing("distortion must be k1 k2 p1 p2 and perhaps k3", d_name);
  for (std::size_t i = 5; i < d.values.size(); ++i)
    if (d.values[i] != 0)
      return Error{Errc::Unsupported, "more than five distortion coefficients; calibrate with k1 k2 p1 p2 k3"}
          .at(d_name);
  for (std::size_t i = 0; i < 5 && i < d.values.size(); ++i) camera.distortion[i] = d.values[i];
  return {};
}

void append_matrix(std::string& text, const char* name, int rows, int cols, std::span<const double> values) {
  char line[96];
  std::snprintf(line, sizeof line, "%s: !!opencv-matrix\n   rows: %d\n   cols: %d\n   dt: d\n   data: [",
                name, rows, cols);
  text += line;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::snprintf(line, sizeof line, "%s%s%.16e", i == 0 ? " " : ",",
                  i % 3 == 0 && i > 0 ? "\n       "
                  : i == 0            ? ""
                                      : " ",
                  values[i]);
    text += line;
  }
  text += " ]\n";
}

void append_camera(std::string& text, const CameraIntrinsics& c, const char* k_name, const char* d_name) {
  const double k[9] = {c.focal_px.x, 0, c.centre_px.x, 0, c.focal_px.y, c.centre_px.y, 0, 0, 1};
  append_matrix(text, k_name, 3, 3, k);
  append_matrix(text, d_name, 1, 5, c.distortion);
}

Result<void> write_all(int descriptor, std::string_view text, const std::filesystem::path& file) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return failed("could not be written; is there room?", file);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

}  // namespace

Result<StereoCalibration> parse_calibration(std::string_view text) {
  if (text.empty()) return Error{Errc::InvalidInput, "the calibration is empty; calibrate again"};
  if (text.size() > kMaxCalibrationFileBytes)
    return Error{Errc::InvalidInput, "too large for a calibration; give a file such as rig.yml"};
  RELIEVO_TRY_ASSIGN(const YamlFields fields, parse_yaml_fields(text));
  StereoCalibration calibration;
  RELIEVO_TRY(read_camera(fields, "K1", "D1", calibration.left));
  RELIEVO_TRY(read_camera(fields, "K2", "D2", calibration.right));
  RELIEVO_TRY_ASSIGN(const YamlMatrix* r, matrix(fields, "R", 3, 3));
  std::copy(r->values.begin(), r->values.end(), calibration.right_from_left.rotation.m);
  RELIEVO_TRY_ASSIGN(const YamlMatrix* t, matrix(fields, "T", 3, 1));
  calibration.right_from_left.translation_mm = {t->values[0], t->values[1], t->values[2]};
  if (const auto rms = fields.numbers.find("pair_rms_px"); rms != fields.numbers.end())
    calibration.rms_px = rms->second;
  RELIEVO_TRY(check_calibration(calibration));
  return calibration;
}

std::string calibration_text(const StereoCalibration& c) {
  // Everything that may be absent comes first: wherever the file is cut, a needed field is lost.
  char head[160];
  std::snprintf(head, sizeof head, "%%YAML:1.0\n---\npair_rms_px: %.16e\nimage_width: %d\nimage_height: %d\n",
                c.rms_px, c.left.width_px, c.left.height_px);
  std::string text = head;
  append_camera(text, c.left, "K1", "D1");
  append_camera(text, c.right, "K2", "D2");
  append_matrix(text, "R", 3, 3, c.right_from_left.rotation.m);
  const Vec3d& t = c.right_from_left.translation_mm;
  const double translation[3] = {t.x, t.y, t.z};
  append_matrix(text, "T", 3, 1, translation);
  return text;
}

Result<StereoCalibration> read_calibration(const std::filesystem::path& file) {
  File in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (in.get() < 0)
    return failed("the calibration cannot be opened; check the name, or calibrate first", file);
  struct stat status {};
  if (::fstat(in.get(), &status) != 0) return failed("the calibration cannot be read", file);
  if (!S_ISREG(status.st_mode))
    return missing("is no file; give a calibration such as rig.yml", file.native());
  if (static_cast<std::size_t>(status.st_size) > kMaxCalibrationFileBytes)
    return missing("too large for a calibration; give a file such as rig.yml", file.native());
  std::string text(kMaxCalibrationFileBytes + 1, '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t got = ::read(in.get(), text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return failed("the calibration cannot be read", file);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  text.resize(size);
  auto calibration = parse_calibration(text);
  if (calibration) return calibration;
  const Error& error = calibration.error();
  const std::string inside(error.where());
  return error.at(inside.empty() ? file.native() : file.native() + ": " + inside);
}

Result<void> write_calibration(const std::filesystem::path& file, const StereoCalibration& calibration) {
  RELIEVO_TRY(check_calibration(calibration));
  std::string temporary = file.native() + ".XXXXXX";
  File out(::mkostemp(temporary.data(), O_CLOEXEC));
  if (out.get() < 0)
    return failed("cannot be written here; does the folder exist, may you write to it?", file);
  const auto finish = [&]() -> Result<void> {
    RELIEVO_TRY(write_all(out.get(), calibration_text(calibration), file));
    if (::fchmod(out.get(), 0644) != 0 || ::fsync(out.get()) != 0 || !out.close())
      return failed("could not be written; is there room?", file);
    if (::rename(temporary.c_str(), file.c_str()) != 0) return failed("could not be put in place", file);
    return {};
  };
  auto finished = finish();
  if (!finished) {
    ::unlink(temporary.c_str());
    return finished;
  }
  // The name, too, must survive a power cut.
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const File directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0) ::fsync(directory.get());
  return {};
}

}  // namespace relievo::pipeline
