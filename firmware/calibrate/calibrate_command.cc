// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibrate_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <set>
#include <string_view>
#include <system_error>

#include "firmware/base/output_folder.h"
#include "firmware/base/version.h"
#include "firmware/base/wall_time.h"
#include "firmware/capture/face_light.h"
#include "hal/base/words.h"
#include "hal/picture_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/calibrate/report/calibration_report.h"
#include "pipeline/match/rectify/rectifier.h"
#include "storage/store_folder.h"

namespace relievo::firmware {
namespace {

constexpr int kThumbnailPx = 320;  // twice as wide as it is shown: printers and phones see the difference
constexpr int kThumbnailQuality = 82;

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour kFirst{255, 60, 60};  // the order starts here
constexpr Colour kCorner{60, 255, 60};
constexpr Colour kLine{255, 200, 0};

Colour pixel(const ImageView& image, int x, int y) { return colour_of(image.row(y), x, image.format); }

void put(hal::Picture& picture, int x, int y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= picture.width_px || y >= picture.height_px) return;
  for (std::size_t c = 0; c < 3; ++c)
    picture.bytes[3 * (std::size_t(y) * std::size_t(picture.width_px) + std::size_t(x)) + c] =
        static_cast<std::byte>(colour[c]);
}

hal::Picture blank(const ImageView& one) {
  hal::Picture picture{{}, 2 * one.width_px, one.height_px, PixelFormat::Rgb8};
  picture.bytes.resize(3 * std::size_t(picture.width_px) * std::size_t(picture.height_px));
  return picture;
}

void draw_corners(hal::Picture& picture, const pipeline::BoardCorners& corners, int offset) {
  const int arm = std::max(4, picture.width_px / 500);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!pipeline::seen(corners[i])) continue;
    const int x = int(std::lround(corners[i].x));
    const int y = int(std::lround(corners[i].y));
    for (int d = -arm; d <= arm; ++d) {
      put(picture, offset + x + d, y, i == 0 ? kFirst : kCorner);
      put(picture, offset + x, y + d, i == 0 ? kFirst : kCorner);
    }
  }
}

// Left and right side by side, both of the calibration's size, with the corners found (there may be none).
hal::Picture corner_picture(const ImageView& left, const pipeline::BoardCorners& left_corners,
                            const ImageView& right, const pipeline::BoardCorners& right_corners) {
  hal::Picture picture = blank(left);
  for (int y = 0; y < left.height_px; ++y)
    for (int x = 0; x < left.width_px; ++x) {
      put(picture, x, y, pixel(left, x, y));
      put(picture, left.width_px + x, y, pixel(right, x, y));
    }
  draw_corners(picture, left_corners, 0);
  draw_corners(picture, right_corners, left.width_px);
  return picture;
}

// The rectified pair with lines across both views, on which the same point must lie. Errors: InvalidInput
// (the cameras do not look at a common volume).
Result<hal::Picture> rectified_picture(const ImageView& left, const ImageView& right,
                                       const pipeline::StereoCalibration& calibration) {
  pipeline::RectifiedPair pair(std::pmr::null_memory_resource());  // geometry only
  pipeline::RectifierOptions any_size;
  any_size.longest_side_px = 1 << 20;  // no more is drawn than a view is large
  RELIEVO_TRY(pipeline::lay_windows(calibration, any_size, pair));
  hal::Picture picture = blank(left);
  const auto draw = [&](const ImageView& from, const pipeline::CameraIntrinsics& camera,
                        const pipeline::Rotation& turn, const pipeline::Vec2d& centre, int offset) {
    // The middle of the window.
    const double across = 0.5 * (pair.width_px - from.width_px),
                 down = 0.5 * (pair.height_px - from.height_px);
    for (int y = 0; y < from.height_px; ++y)
      for (int x = 0; x < from.width_px; ++x) {
        const pipeline::Vec2d at =
            pipeline::source_pixel(camera, turn, pair.focal_px, centre, {x + across, y + down});
        if (!(at.x >= 0 && at.y >= 0 && at.x <= from.width_px - 1 && at.y <= from.height_px - 1)) continue;
        put(picture, offset + x, y, pixel(from, int(std::lround(at.x)), int(std::lround(at.y))));
      }
  };
  draw(left, calibration.left, pair.rectified_from_left, pair.left_centre_px, 0);
  draw(right, calibration.right, pair.rectified_from_right, pair.right_centre_px, left.width_px);
  const int step = std::max(8, picture.height_px / 24);
  for (int y = step / 2; y < picture.height_px; y += step)
    for (int x = 0; x < picture.width_px; ++x) put(picture, x, y, kLine);
  return picture;
}

// A view's name as part of a file's; two views may have one name ("left1" and "left_1"), never two files.
std::string file_name(std::string name, std::set<std::string>& taken) {
  std::ranges::replace(name, '/', '-');
  std::string free = name;
  for (int i = 2; !taken.insert(free).second; ++i) free = name + "_" + std::to_string(i);
  return free;
}

Result<std::vector<std::byte>> thumbnail(const hal::Picture& picture) {
  const int width = std::min(kThumbnailPx, picture.width_px);
  const int height = std::max(1, int(std::lround(double(width) * picture.height_px / picture.width_px)));
  RELIEVO_TRY_ASSIGN(const hal::Picture small, hal::reduced(picture.view(), width, height));
  return hal::encode_jpeg(small.view(), kThumbnailQuality);
}

// Files are made in the report's working folder; an error names the one they are meant for.
struct Report {
  const OutputFolder& work;
  const Path& folder;

  Result<void> picture(const std::string& name, const hal::Picture& picture) const {
    return hal::write_picture(work.path() / name, picture.view()).at((folder / name).native());
  }
  Result<void> text(const std::string& name, std::string_view text) const {
    return write_text(work.path() / name, text, folder / name);
  }
};

Result<void> write_pictures(const Report& report, const std::string& name, const hal::Picture& left,
                            const hal::Picture& right, const pipeline::BoardView& view,
                            const pipeline::StereoCalibration& calibration, pipeline::ViewPictures& files) {
  files.corners_file = "corners_" + name + ".png";
  RELIEVO_TRY(
      report.picture(files.corners_file, corner_picture(left.view(), view.left, right.view(), view.right)));
  const auto rectified = rectified_picture(left.view(), right.view(), calibration);
  if (!rectified) return {};  // of cameras that do not look at a face's place there is none
  files.rectified_file = "rectified_" + name + ".png";
  return report.picture(files.rectified_file, *rectified);
}

// "boards" of "/data/boards/" and of "boards/.".
std::string last_name(const Path& folder) {
  Path whole = std::filesystem::absolute(folder).lexically_normal();
  if (whole.filename().empty()) whole = whole.parent_path();
  return whole.filename().string();
}

// The size of the cameras' pictures is that of the first board seen. A picture without a board may have any:
// it plays no part.
Result<pipeline::BoardCorners> look_in(const hal::Picture& picture, const Path& file,
                                       pipeline::CalibratorInput& input) {
  RELIEVO_TRY_ASSIGN(auto corners, pipeline::look_for_board(picture.view(), input.pattern).at(file.native()));
  if (corners.empty()) return corners;
  if (input.width_px == 0) {
    input.width_px = picture.width_px;
    input.height_px = picture.height_px;
  }
  if (picture.width_px != input.width_px || picture.height_px != input.height_px)
    return invalid("is not as large as the boards before; all must come from the same two cameras")
        .at(file.native());
  return corners;
}

const char* finding(const pipeline::BoardView& view) {
  if (view.left.empty()) return view.right.empty() ? "no board in left and right" : "no board in left";
  return view.right.empty() ? "no board in right" : "board found";
}

Result<pipeline::CalibratorInput> read_views(const std::vector<hal::PicturePairFiles>& pairs,
                                             const pipeline::BoardPattern& pattern, const Tell& tell) {
  pipeline::CalibratorInput input;
  input.pattern = pattern;
  bool any = false;
  for (const hal::PicturePairFiles& files : pairs) {
    RELIEVO_TRY_ASSIGN(const hal::Picture left, hal::read_picture(files.left));
    RELIEVO_TRY_ASSIGN(const hal::Picture right, hal::read_picture(files.right));
    pipeline::BoardView& view = input.views.emplace_back();
    view.name = files.name;
    RELIEVO_TRY_ASSIGN(view.left, look_in(left, files.left, input));
    RELIEVO_TRY_ASSIGN(view.right, look_in(right, files.right, input));
    any = any || (!view.left.empty() && !view.right.empty());
    RELIEVO_TRY(tell("view " + view.name + ": " + finding(view)));
  }
  if (!any)
    return invalid("no pair shows a whole board with these inner corners; check --corners and the light")
        .at(pairs.front().left.parent_path().native());
  return input;
}

// In the order of storage::CalibrationGrade: what nobody knows, then the verdicts in their order.
constexpr std::array kGrades{"-", "pass", "usable", "refuse"};
static_assert(int(storage::CalibrationGrade::Refuse) == 1 + int(pipeline::CalibrationVerdict::Refuse) &&
              kGrades.size() == 1 + std::size_t(storage::CalibrationGrade::Refuse));

std::string number(double value, int decimals) { return value <= 0 ? "-" : decimal(value, decimals); }

}  // namespace

Result<void> write_calibration_report(const Path& folder, const std::vector<hal::PicturePairFiles>& pairs,
                                      const pipeline::CalibratorInput& input,
                                      const pipeline::CalibratorOutput& result, const std::string& made_at,
                                      const Tell& tell) {
  RELIEVO_TRY_ASSIGN(OutputFolder work, OutputFolder::begin(folder));
  const Report report{work, folder};
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
      RELIEVO_TRY(tell("report: view " + pairs[i].name + " has another size, no picture"));
      continue;
    }
    RELIEVO_TRY(write_pictures(report, file_name(pairs[i].name, taken), left, right, input.views[i],
                               result.calibration, pictures));
    RELIEVO_TRY(tell("report: view " + pairs[i].name));
  }
  RELIEVO_TRY(report.text("report.json", pipeline::calibration_report_json(page)));
  RELIEVO_TRY(report.text("index.html", pipeline::calibration_report_html(page)));
  return work.commit();
}

Result<void> tell_quality(const pipeline::CalibrationQuality& q, const Tell& tell) {
  for (const pipeline::ViewQuality& view : q.views) {
    std::string line = "view " + view.name;
    line += view.used ? filled(": used, left {} px, right {} px, epipolar {} px",
                               {decimal(view.left_rms_px, 3), decimal(view.right_rms_px, 3),
                                decimal(view.epipolar_rms_px, 3)})
                      : ": left out, " + view.reason;
    if (view.corners_dropped > 0)
      line += ", " + std::to_string(view.corners_dropped) + " stray corners dropped";
    RELIEVO_TRY(tell(line));
  }
  RELIEVO_TRY(tell(filled(
      "{} of {} pairs used, pair rms {} px, each camera alone {} and {} px, held out {} px, baseline {} mm",
      {std::to_string(q.used), std::to_string(q.views.size()), decimal(q.pair_rms_px, 3),
       decimal(q.left_rms_px, 3), decimal(q.right_rms_px, 3), decimal(q.held_out_epipolar_px, 3),
       decimal(q.baseline_mm, 2)})));
  RELIEVO_TRY(tell(filled(
      "at {} mm: depth within {} mm (95 %); boards held out found {} mm from where their squares put them; lengths within {} % (95 %)",
      {decimal(pipeline::kFaceMm, 0), decimal(pipeline::kTwoSided95 * q.face_depth_sigma_mm, 3),
       decimal(q.measured_depth_mm, 3), decimal(pipeline::kTwoSided95 * q.uncertainty.scale_percent, 3)})));
  if (q.expected_as_in_use)
    RELIEVO_TRY(tell(
        "the lenses are those of the calibration in use: its baseline is expected (--baseline-mm N: another, 0: none)"));
  RELIEVO_TRY(tell(std::string("verdict: ") + pipeline::name_of(q.verdict)));
  for (const std::string& reason : q.reasons) RELIEVO_TRY(tell("  " + reason));
  return {};
}

Result<void> check_calibration_output(const Path& output) {
  std::error_code error;
  const Path folder = output.has_parent_path() ? output.parent_path() : Path(".");
  if (!std::filesystem::is_directory(folder, error))
    return Error{Errc::NotFound, "the folder for the calibration does not exist; make it first"}.at(
        folder.native());
  if (std::filesystem::is_directory(output, error))
    return invalid("is a folder; name a file such as rig.yml").at(output.native());
  return storage::must_lie_outside_stores(output);
}

pipeline::BoardPattern pattern_of(const BoardArgs& board) {
  return {
      board.corners_across, board.corners_down,
      board.square_mm,      board.charuco ? pipeline::BoardKind::Charuco : pipeline::BoardKind::Chessboard,
      board.marker_mm,      board.marker_bits};
}

Result<pipeline::CalibratorOutput> run_calibrate(const CalibrateArgs& args, const Tell& tell,
                                                 const RigToday& today) {
  const pipeline::BoardPattern pattern = pattern_of(args.board);
  RELIEVO_TRY(pattern.check());
  RELIEVO_TRY(check_calibration_output(args.output));
  RELIEVO_TRY_ASSIGN(const auto pairs, hal::find_picture_pairs(args.pictures));
  if (pairs.size() > pipeline::kMaxBoardPairs)
    return invalid("holds more than 500 pairs; a few dozen are enough").at(args.pictures.native());
  RELIEVO_TRY_ASSIGN(pipeline::CalibratorInput input, read_views(pairs, pattern, tell));
  input.expected_baseline_mm = args.baseline_mm.value_or(0);
  if (!args.baseline_mm) input.in_use = today.in_use;
  auto result = pipeline::calibrate(input);
  if (!result) return result.error().at(args.pictures.native() + ": " + std::string(result.error().where()));
  RELIEVO_TRY(tell_quality(result->quality, tell));
  if (!args.report.empty())
    RELIEVO_TRY(write_calibration_report(args.report, pairs, input, *result, today.made_at, tell));
  if (result->quality.verdict == pipeline::CalibrationVerdict::Refuse)
    return Error{Errc::PoorGeometry, "the calibration is refused for the reasons above and was not written"}
        .at(args.pictures.native());
  RELIEVO_TRY(pipeline::write_calibration(args.output, result->calibration));
  return result;
}

storage::CalibrationFigures figures_of(const pipeline::CalibrationQuality& q) {
  return {static_cast<storage::CalibrationGrade>(1 + int(q.verdict)), q.held_out_epipolar_px,
          q.depth_sigma_mm, q.shape_sigma_mm};
}

std::string history_heading() {
  return "   no  made                  pictures   verdict  pair px  held out  shift px  depth mm  shape mm  baseline mm  used  from";
}

std::string line_of(const storage::CalibrationInfo& c) {
  const std::string size = std::to_string(c.width_px) + "x" + std::to_string(c.height_px);
  return printed("%c %4u  %s  %-9s  %-7s  %7s  %8s  %8s  %8s  %8s  %11s  %4d  ", c.active ? '*' : ' ',
                 c.revision, text_of(c.created_at).c_str(), size.c_str(),
                 kGrades[std::size_t(c.figures.grade)], number(c.rms_px, 3).c_str(),
                 number(c.figures.held_out_epipolar_px, 3).c_str(), number(c.epipolar_shift_px, 4).c_str(),
                 number(c.figures.depth_sigma_mm, 2).c_str(), number(c.figures.shape_sigma_mm, 2).c_str(),
                 number(c.baseline_mm, 2).c_str(), c.enrolments) +
         c.note;
}

}  // namespace relievo::firmware
