// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibrate_report.h"

#include <algorithm>
#include <set>

#include "firmware/base/output_folder.h"
#include "firmware/base/version.h"
#include "hal/picture_file.h"
#include "pipeline/calibrate/quality/check_picture.h"
#include "pipeline/calibrate/report/calibration_report.h"

namespace relievo::firmware {
namespace {

constexpr int kThumbnailPx = 320;  // twice as wide as it is shown: printers and phones see the difference
constexpr int kThumbnailQuality = 82;

// A view's name as part of a file's; two views may have one name ("left1" and "left_1"), never two files.
std::string file_name(std::string name, std::set<std::string>& taken) {
  std::replace(name.begin(), name.end(), '/', '-');
  std::string free = name;
  for (int i = 2; !taken.insert(free).second; ++i) free = name + "_" + std::to_string(i);
  return free;
}

Result<std::vector<std::byte>> thumbnail(const hal::Picture& picture) {
  return hal::encode_jpeg(pipeline::thumbnail_picture(picture.view(), kThumbnailPx).view(),
                          kThumbnailQuality);
}

// Files are made in the report's working folder; an error names the one they are meant for.
class Report {
 public:
  Report(OutputFolder& work, const Path& folder) : work_(work), folder_(folder) {}

  Result<void> picture(const std::string& name, const pipeline::CheckPicture& picture) const {
    const auto written = hal::write_picture(work_.path() / name, picture.view());
    if (!written) return written.error().at((folder_ / name).native());
    return {};
  }
  Result<void> text(const std::string& name, std::string_view text) const {
    return write_text(work_.path() / name, text, folder_ / name);
  }

 private:
  OutputFolder& work_;
  const Path& folder_;
};

Result<void> write_pictures(const Report& report, const std::string& name, const hal::Picture& left,
                            const hal::Picture& right, const pipeline::BoardView& view,
                            const pipeline::StereoCalibration& calibration, pipeline::ViewPictures& files) {
  files.corners_file = "corners_" + name + ".png";
  files.rectified_file = "rectified_" + name + ".png";
  RELIEVO_TRY(report.picture(files.corners_file,
                             pipeline::corner_picture(left.view(), view.left, right.view(), view.right)));
  return report.picture(files.rectified_file,
                        pipeline::rectified_picture(left.view(), right.view(), calibration));
}

// "boards" of "/data/boards/" and of "boards/.".
std::string last_name(const Path& folder) {
  Path whole = std::filesystem::absolute(folder).lexically_normal();
  if (whole.filename().empty()) whole = whole.parent_path();
  return whole.filename().string();
}

}  // namespace

Result<void> write_calibration_report(const Path& folder, const std::vector<PicturePairFiles>& pairs,
                                      const pipeline::CalibratorInput& input,
                                      const pipeline::CalibratorOutput& result, const std::string& made_at,
                                      std::ostream& out) {
  RELIEVO_TRY_ASSIGN(OutputFolder work, OutputFolder::begin(folder));
  const Report report(work, folder);
  pipeline::CalibrationReport page{input, result, "Relievo " + std::string(kVersion), made_at, {}, {}};
  if (!pairs.empty()) page.source = last_name(pairs.front().left.parent_path());
  std::set<std::string> taken;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    RELIEVO_TRY_ASSIGN(const hal::Picture left, hal::read_picture(pairs[i].left));
    RELIEVO_TRY_ASSIGN(const hal::Picture right, hal::read_picture(pairs[i].right));
    const auto fits = [&input](const hal::Picture& one) {
      return one.width_px == input.width_px && one.height_px == input.height_px;
    };
    pipeline::ViewPictures& pictures = page.pictures.emplace_back();
    RELIEVO_TRY_ASSIGN(pictures.left_jpeg, thumbnail(left));
    RELIEVO_TRY_ASSIGN(pictures.right_jpeg, thumbnail(right));
    if (!fits(left) || !fits(right)) {
      out << "report: view " << pairs[i].name << " has another size, no picture" << std::endl;
      continue;
    }
    RELIEVO_TRY(write_pictures(report, file_name(pairs[i].name, taken), left, right, input.views[i],
                               result.calibration, pictures));
    out << "report: view " << pairs[i].name << std::endl;
  }
  RELIEVO_TRY(report.text("report.json", pipeline::calibration_report_json(page)));
  RELIEVO_TRY(report.text("index.html", pipeline::calibration_report_html(page)));
  return work.commit();
}

}  // namespace relievo::firmware
