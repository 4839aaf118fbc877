// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/comparison.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <string>
#include <string_view>

#include "hal/base/statistics.h"
#include "hal/base/whole_file.h"
#include "hal/picture_file.h"
#include "storage/byte_order.h"

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

// Whatever the locale; 0 where it is none.
template <typename Number>
Number header_number(std::string_view text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// A pixel between four nodes of the lattice; `tx`, `ty` of 0 to 1.
float between(const std::array<float, 4>& node, float tx, float ty, float step_px) {
  const auto [least, most] =
      std::minmax_element(node.begin(), node.end(), [](float a, float b) { return a < b; });
  const bool all = std::ranges::none_of(node, [](float d) { return std::isnan(d); });
  if (!all || *most - *least > step_px) return node[(tx < 0.5F ? 0U : 1U) + (ty < 0.5F ? 0U : 2U)];
  const float top = node[0] + tx * (node[1] - node[0]);
  return top + ty * (node[2] + tx * (node[3] - node[2]) - top);
}

// Nodes stand every `step` pixels from (first_x, first_y) on, which lies within the first step.
void fill_lattice(DisparityMap& map, int step, int first_x, int first_y) {
  const DisparityMap nodes = map;
  const auto node = [&nodes](int x, int y) { return nodes.holds(x, y) ? nodes.at(x, y) : kNoDisparity; };
  for (int y = 0; y < map.height_px; ++y)
    for (int x = 0; x < map.width_px; ++x) {
      const int left = x - (x - first_x + step) % step;
      const int top = y - (y - first_y + step) % step;
      const bool last_column = left + step >= map.width_px;
      const bool last_row = top + step >= map.height_px;
      const std::array around{node(left, top), last_column ? node(left, top) : node(left + step, top),
                              last_row ? node(left, top) : node(left, top + step),
                              last_column || last_row ? node(left, top) : node(left + step, top + step)};
      const float by_step = 1.0F / float(step);
      map.values[map.index(x, y)] =
          between(around, float(x - left) * by_step, float(y - top) * by_step, float(step));
    }
}

constexpr float kHidesPx = 1;  // a surface nearer by more than this, on the same pixel of the right view

Result<DisparityMap> read_map(const std::filesystem::path& file, double scale) {
  if (hal::lower_extension(file) == ".pfm") return read_pfm(file);
  RELIEVO_TRY_ASSIGN(const hal::Picture picture, hal::read_picture(file));
  if (picture.format == PixelFormat::Rgb8)
    return invalid("is a colour picture: a disparity map is grey, or a PFM").at(file.string());
  DisparityMap map(picture.width_px, picture.height_px);
  const ImageView view = picture.view();
  for (int y = 0; y < map.height_px; ++y) {
    const std::uint8_t* row = view.row(y);
    const auto* wide = reinterpret_cast<const std::uint16_t*>(row);
    for (int x = 0; x < map.width_px; ++x) {
      const int grey = picture.format == PixelFormat::Grey16 ? wide[x] : row[x];
      if (grey != 0) map.values[map.index(x, y)] = float(grey / scale);
    }
  }
  return map;
}

double share(std::size_t part, std::size_t whole) { return whole == 0 ? 0 : double(part) / double(whole); }

void count_error(ErrorHistogram& histogram, double error) {
  constexpr double kWidth = 2 * ErrorHistogram::kReachPx / ErrorHistogram::kBins;
  const double bin = std::floor((error + ErrorHistogram::kReachPx) / kWidth);
  ++histogram.counts[std::size_t(std::clamp(bin, 0.0, ErrorHistogram::kBins - 1.0))];
}

// The figures of the errors themselves.
void describe_errors(std::vector<double>& errors, double within_sum, std::size_t within, DisparityScore& s) {
  double sum = 0;
  double squares = 0;
  for (const double e : errors) {
    sum += e;
    squares += e * e;
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  s.mean_px = errors.empty() ? nothing : sum / double(errors.size());
  s.rms_px = errors.empty() ? nothing : std::sqrt(squares / double(errors.size()));
  s.median_px = median(errors);
  s.p95_px = percentile(errors, 0.95);
  s.bias_px = within == 0 ? nothing : within_sum / double(within);
}

}  // namespace

Result<DisparityMap> read_pfm(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMostBytes));
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string magic = word(rest);
  // What is no number reads as 0, which is no width.
  const long width = header_number<long>(word(rest));
  const long height = header_number<long>(word(rest));
  const double scale = header_number<double>(word(rest));
  const bool sane =
      magic == "Pf" && width > 0 && height > 0 && width <= kMostSidePx && height <= kMostSidePx && scale != 0;
  if (!sane || rest.size() != 4 * std::size_t(width) * std::size_t(height))
    return invalid("is no whole PFM of one channel").at(file.string());
  auto map = DisparityMap(int(width), int(height));
  storage::ByteReader from(storage::bytes_of(rest));
  for (int y = map.height_px - 1; y >= 0; --y)
    for (int x = 0; x < map.width_px; ++x) {
      const auto bits = from.get<std::uint32_t>();
      const auto d = std::bit_cast<float>(scale < 0 ? bits : __builtin_bswap32(bits));
      if (std::isfinite(d)) map.values[map.index(x, y)] = d;
    }
  return map;
}

std::vector<std::byte> pfm_of(const DisparityMap& map) {
  const std::string head =
      "Pf\n" + std::to_string(map.width_px) + " " + std::to_string(map.height_px) + "\n-1\n";
  std::vector<std::byte> out;
  out.reserve(head.size() + 4 * map.values.size());
  storage::ByteWriter to(out);
  to.put(storage::bytes_of(head));
  for (int y = map.height_px - 1; y >= 0; --y)
    for (int x = 0; x < map.width_px; ++x)
      to.put(map.known(x, y) ? map.at(x, y) : std::numeric_limits<float>::infinity());
  return out;
}

DisparityMap disparity_map(const pipeline::MatchSet& set, int width_px, int height_px) {
  DisparityMap map(width_px, height_px);
  for (const pipeline::Match& match : set.matches) {
    const int x = int(std::lround(match.left_px.x));
    const int y = int(std::lround(match.left_px.y));
    if (match.rejected_by == 0 && map.holds(x, y)) map.values[map.index(x, y)] = match.disparity_px;
  }
  if (const int step = set.lattice_step_px; step > 1 && !set.matches.empty()) {
    const pipeline::Vec2f node = set.matches.front().left_px;
    fill_lattice(map, step, int(std::lround(node.x)) % step, int(std::lround(node.y)) % step);
  }
  return map;
}

DisparityMap thickened(const DisparityMap& map, int side_px) {
  DisparityMap thick = map;
  for (int y = 0; y < map.height_px; ++y)
    for (int x = 0; x < map.width_px; ++x) {
      if (!map.known(x, y)) continue;
      for (int j = y - side_px / 2; j <= y + side_px / 2; ++j)
        for (int i = x - side_px / 2; i <= x + side_px / 2; ++i)
          if (thick.holds(i, j) && !map.known(i, j)) thick.values[thick.index(i, j)] = map.at(x, y);
    }
  return thick;
}

std::vector<std::uint8_t> seen_by_both(const DisparityMap& map) {
  std::vector<std::uint8_t> seen(map.values.size(), 0);
  std::vector<float> nearest(std::size_t(map.width_px));
  for (int y = 0; y < map.height_px; ++y) {
    std::ranges::fill(nearest, -std::numeric_limits<float>::infinity());
    const auto partner = [&](int x) { return std::lround(float(x) - map.at(x, y)); };
    for (int x = 0; x < map.width_px; ++x) {
      if (!map.known(x, y)) continue;
      const long at = partner(x);
      if (at >= 0 && at < map.width_px)
        nearest[std::size_t(at)] = std::max(nearest[std::size_t(at)], map.at(x, y));
    }
    for (int x = 0; x < map.width_px; ++x) {
      if (!map.known(x, y)) continue;
      const long at = partner(x);
      if (at < 0 || at >= map.width_px) continue;
      seen[map.index(x, y)] = nearest[std::size_t(at)] <= map.at(x, y) + kHidesPx ? 1 : 0;
    }
  }
  return seen;
}

Result<DisparityTruth> read_disparity_truth(const std::filesystem::path& file, double scale) {
  DisparityTruth truth;
  RELIEVO_TRY_ASSIGN(truth.map, read_map(file, scale));
  if (std::ranges::all_of(truth.map.values, [](float d) { return std::isnan(d); }))
    return invalid("holds no disparity at all: is it the truth's file?").at(file.string());
  truth.seen = seen_by_both(truth.map);
  return truth;
}

DisparityTruth truth_of_view(const measure::TruthView& view, const pipeline::RectifiedPair& pair) {
  DisparityTruth truth;
  truth.map = DisparityMap(pair.width_px, pair.height_px);
  const pipeline::Rotation left_from_rectified = pipeline::transposed(pair.rectified_from_left);
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      const pipeline::Vec3d ray{(x - pair.left_centre_px.x) / pair.focal_px,
                                (y - pair.left_centre_px.y) / pair.focal_px, 1};
      const auto point = view.judged_point_along(pipeline::apply(left_from_rectified, ray));
      if (!point) continue;
      const double z = pipeline::apply(pair.rectified_from_left, *point).z;
      truth.map.values[truth.map.index(x, y)] = float(pair.disparity_px(z));
    }
  for (const float d : truth.map.values) truth.seen.push_back(std::isnan(d) ? 0 : 1);
  return truth;
}

DisparityScore score(const DisparityMap& map, const DisparityTruth& truth, double limit_px) {
  DisparityScore s;
  constexpr std::array kLimits{0.5, 1.0, 2.0, 4.0};
  std::array<std::size_t, 5> good{};
  std::size_t good_seen = 0;
  double within_sum = 0;
  std::vector<double> errors;
  for (std::size_t k = 0; k < truth.map.values.size(); ++k) {
    if (std::isnan(truth.map.values[k])) continue;
    ++s.judged;
    s.seen += truth.seen[k];
    if (std::isnan(map.values[k])) continue;
    const double error = double(map.values[k]) - double(truth.map.values[k]);
    errors.push_back(std::abs(error));
    count_error(s.histogram, error);
    for (std::size_t i = 0; i < kLimits.size(); ++i) good[i] += errors.back() <= kLimits[i] ? 1 : 0;
    if (errors.back() > limit_px) continue;
    ++good[4];
    good_seen += truth.seen[k];
    within_sum += error;
  }
  s.given = errors.size();
  s.density = share(s.given, s.judged);
  s.bad_half = share(s.judged - good[0], s.judged);
  s.bad_1 = share(s.judged - good[1], s.judged);
  s.bad_2 = share(s.judged - good[2], s.judged);
  s.bad_4 = share(s.judged - good[3], s.judged);
  s.bad_limit = share(s.judged - good[4], s.judged);
  s.bad_given = share(s.given - good[4], s.given);
  s.bad_seen = share(s.seen - good_seen, s.seen);
  describe_errors(errors, within_sum, good[4], s);
  return s;
}

SharedScore score_shared(const DisparityMap& one, const DisparityMap& other, const DisparityTruth& truth,
                         double limit_px) {
  SharedScore s;
  std::vector<double> errors;
  std::vector<double> other_errors;
  for (std::size_t k = 0; k < truth.map.values.size(); ++k) {
    if (std::isnan(truth.map.values[k]) || std::isnan(one.values[k]) || std::isnan(other.values[k])) continue;
    const auto truly = double(truth.map.values[k]);
    errors.push_back(std::abs(double(one.values[k]) - truly));
    other_errors.push_back(std::abs(double(other.values[k]) - truly));
  }
  const auto bad = [limit_px](const std::vector<double>& all) {
    return share(std::size_t(std::ranges::count_if(all, [limit_px](double e) { return e > limit_px; })),
                 all.size());
  };
  s.shared = errors.size();
  s.bad_one = bad(errors);
  s.bad_other = bad(other_errors);
  s.median_one_px = median(errors);
  s.median_other_px = median(other_errors);
  return s;
}

}  // namespace relievo::firmware::compare
