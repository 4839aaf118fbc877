// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/stage_drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace relievo::firmware {
namespace {

constexpr double kFacesAcross = 1.5;   // widths of the face in the picture
constexpr double kHeadsAcross = 1.25;  // of the box by which the light is metered

struct Range {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  double share(double v) const { return high > low ? (v - low) / (high - low) : 0; }
};

struct Corner {
  double x = 0, y = 0, z = 0;
  Rgb colour;
};

double edge(const Corner& a, const Corner& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

void triangle(const Corner& a, const Corner& b, const Corner& c, std::vector<float>& depth,
              StageCanvas& canvas) {
  const double area = edge(a, b, c.x, c.y);
  if (std::abs(area) < 1e-9) return;
  const int x0 = std::max(0, int(std::floor(std::min({a.x, b.x, c.x})))),
            x1 = std::min(canvas.side() - 1, int(std::ceil(std::max({a.x, b.x, c.x}))));
  const int y0 = std::max(0, int(std::floor(std::min({a.y, b.y, c.y})))),
            y1 = std::min(canvas.side() - 1, int(std::ceil(std::max({a.y, b.y, c.y}))));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double u = edge(b, c, x, y) / area, v = edge(c, a, x, y) / area, w = 1 - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      const double z = u * a.z + v * b.z + w * c.z;
      float& nearest = depth[std::size_t(y) * std::size_t(canvas.side()) + std::size_t(x)];
      if (z >= nearest) continue;
      nearest = float(z);
      canvas.put(
          x, y,
          {u * a.colour.r + v * b.colour.r + w * c.colour.r, u * a.colour.g + v * b.colour.g + w * c.colour.g,
           u * a.colour.b + v * b.colour.b + w * c.colour.b});
    }
  }
}

// corner(i): the vertex on the canvas.
template <typename At>
void draw_triangles(const pipeline::FaceMesh& mesh, const At& corner, StageCanvas& canvas) {
  std::vector<float> depth(std::size_t(canvas.side()) * std::size_t(canvas.side()),
                           std::numeric_limits<float>::max());
  for (const auto& t : mesh.triangles) triangle(corner(t[0]), corner(t[1]), corner(t[2]), depth, canvas);
}

// Points lie closer together than pixels: of those in a cell of the canvas the one nearest to its middle is
// drawn, as a disc with a soft rim. Fewer or harder ones would beat against the pixels of the screen the
// picture is scaled to.
constexpr int kCellPx = 5;
constexpr double kDotRadiusPx = 1.9, kDotRimPx = 1.2;

class Dots {
 public:
  explicit Dots(StageCanvas& canvas)
      : canvas_(canvas),
        across_((canvas.side() + kCellPx - 1) / kCellPx),
        cells_(std::size_t(across_) * std::size_t(across_)) {}

  void add(double x, double y, double far_share) {
    if (x < 0 || y < 0 || x >= canvas_.side() || y >= canvas_.side()) return;
    const int column = int(x) / kCellPx, row = int(y) / kCellPx;
    const double off = std::hypot(x - (column + 0.5) * kCellPx, y - (row + 0.5) * kCellPx);
    Dot& held = cells_[std::size_t(row) * std::size_t(across_) + std::size_t(column)];
    if (off < held.off) held = {x, y, off, far_share};
  }
  void draw() const {
    for (const Dot& dot : cells_) {
      if (dot.off < kNone) disc(dot);
    }
  }

 private:
  static constexpr double kNone = 1e9;
  struct Dot {
    double x = 0, y = 0, off = kNone, far_share = 0;
  };
  void disc(const Dot& dot) const {
    const double reach = kDotRadiusPx + kDotRimPx;
    const Rgb colour = near_far_colour(dot.far_share);
    for (int y = int(dot.y - reach); y <= int(dot.y + reach); ++y) {
      for (int x = int(dot.x - reach); x <= int(dot.x + reach); ++x) {
        const double inside =
            (kDotRadiusPx + kDotRimPx / 2 - std::hypot(x + 0.5 - dot.x, y + 0.5 - dot.y)) / kDotRimPx;
        if (inside > 0) canvas_.blend(x, y, colour, std::min(1.0, inside));
      }
    }
  }

  StageCanvas& canvas_;
  int across_;
  std::vector<Dot> cells_;
};

Rgb clay(double lit) { return {60 + 170 * lit, 64 + 174 * lit, 72 + 180 * lit}; }

}  // namespace

void draw_capture(const ImageView& picture, const std::optional<FaceBox>& face, StagePictures& pictures) {
  StageCanvas canvas(pictures.begin(0), StagePictures::kSide);
  const double high = picture.height_px;
  const double side = face ? std::min(high, kHeadsAcross * face->width_px) : high;
  const double left = (face ? face->x_px + face->width_px / 2.0 : picture.width_px / 2.0) - side / 2,
               top = (face ? face->y_px + face->height_px / 2.0 : high / 2) - side / 2;
  const double step = side / canvas.side();
  for (int y = 0; y < canvas.side(); ++y) {
    for (int x = 0; x < canvas.side(); ++x) {
      const int u = int(left + (x + 0.5) * step), v = int(top + (y + 0.5) * step);
      if (u < 0 || v < 0 || u >= picture.width_px || v >= picture.height_px) continue;
      const auto [red, green, blue] = colour_of(picture.row(v), u, picture.format);
      canvas.put(x, y, {1.0 * red, 1.0 * green, 1.0 * blue});
    }
  }
  pictures.done(0);
}

void draw_stage_picture(State stage, const Products& products, StagePictures& pictures) {
  const std::size_t number = 1 + number_of(stage);
  if (!products.pair || number >= kStagePictures) return;
  StageCanvas canvas(pictures.begin(number), StagePictures::kSide);
  const auto& pair = *products.pair;
  if (stage == State::Match && products.matches) draw_matches(pair, *products.matches, canvas);
  else if (stage == State::Reconstruct && products.cloud) draw_cloud(pair, *products.cloud, canvas);
  else if (stage == State::Mesh && products.mesh) draw_surface(pair, *products.mesh, nullptr, canvas);
  else if (stage == State::Texture && products.mesh && products.texture)
    draw_surface(pair, *products.mesh, &*products.texture, canvas);
  else return;
  pictures.done(number);
}

Rgb near_far_colour(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  const Rgb near{255, 176, 64}, middle{64, 200, 170}, far{52, 84, 190};
  const auto mix = [](const Rgb& a, const Rgb& b, double s) {
    return Rgb{a.r + (b.r - a.r) * s, a.g + (b.g - a.g) * s, a.b + (b.b - a.b) * s};
  };
  return t < 0.5 ? mix(near, middle, 2 * t) : mix(middle, far, 2 * t - 1);
}

FaceWindow::FaceWindow(const pipeline::RectifiedPair& pair, int side_px) : canvas_(side_px) {
  const bool known = pair.face_width_px > 0;
  side_ = known ? std::min(kFacesAcross * pair.face_width_px, 1.0 * pair.height_px) : pair.height_px;
  const double cx = known ? pair.face_centre_px.x : pair.width_px / 2.0,
               cy = known ? pair.face_centre_px.y : pair.height_px / 2.0;
  left_ = cx - side_ / 2;
  top_ = cy - side_ / 2;
}

StageCanvas::StageCanvas(std::uint8_t* rgb, int side_px) : rgb_(rgb), side_(side_px) {
  for (std::ptrdiff_t i = 0; i < std::ptrdiff_t(side_) * side_; ++i) put_at(i, {27, 37, 52});
}

void StageCanvas::blend(int x, int y, const Rgb& c, double share) {
  if (x < 0 || y < 0 || x >= side_ || y >= side_) return;
  const std::ptrdiff_t i = std::ptrdiff_t(y) * side_ + x;
  const std::uint8_t* old = rgb_ + std::ptrdiff_t{3} * i;
  const auto mix = [share](double was, double is) { return was + (is - was) * share; };
  put_at(i, {mix(old[0], c.r), mix(old[1], c.g), mix(old[2], c.b)});
}

void StageCanvas::put_at(std::ptrdiff_t i, const Rgb& c) {
  std::uint8_t* to = rgb_ + std::ptrdiff_t{3} * i;
  to[0] = std::uint8_t(std::clamp(c.r, 0.0, 255.0));
  to[1] = std::uint8_t(std::clamp(c.g, 0.0, 255.0));
  to[2] = std::uint8_t(std::clamp(c.b, 0.0, 255.0));
}

void draw_photograph(const pipeline::RectifiedPair& pair, double share, StageCanvas& canvas) {
  if (pair.left.grey.empty()) return;
  for_each_shown(pair, canvas, [&](int x, int y, int u, int v) {
    const double grey = pair.left.grey[std::size_t(v) * std::size_t(pair.width_px) + std::size_t(u)] * share;
    canvas.put(x, y, {grey, grey, grey * 1.08});
  });
}

void draw_matches(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& set, StageCanvas& canvas) {
  const FaceWindow window(pair, canvas.side());
  draw_photograph(pair, 0.62, canvas);
  Range range;
  for (const auto& m : set.matches) {
    if (m.rejected_by == 0) range.add(m.disparity_px);
  }
  Dots dots(canvas);
  for (const auto& m : set.matches) {
    if (m.rejected_by == 0)
      dots.add(window.x(m.left_px.x), window.y(m.left_px.y), 1 - range.share(m.disparity_px));
  }
  dots.draw();
}

void draw_cloud(const pipeline::RectifiedPair& pair, const pipeline::PointCloud& points,
                StageCanvas& canvas) {
  const FaceWindow window(pair, canvas.side());
  Range range;
  for (const auto& p : points.points) range.add(p.at_mm.z);
  Dots dots(canvas);
  for (const auto& p : points.points)
    dots.add(window.x(p.left_px.x), window.y(p.left_px.y), range.share(p.at_mm.z));
  dots.draw();
}

void draw_surface(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh,
                  const pipeline::TextureAtlas* skin, StageCanvas& canvas) {
  const FaceWindow window(pair, canvas.side());
  const bool coloured = skin != nullptr && skin->vertex_rgb.size() >= 3 * mesh.vertices_mm.size();
  const auto corner = [&](std::uint32_t i) {
    const auto& v = mesh.vertices_mm[i];
    const auto& n = mesh.normals[i];
    const pipeline::Vec3d p = apply(pair.rectified_from_left, pipeline::Vec3d{v.x, v.y, v.z});
    const double lit = std::max(0.0, -0.45 * n.x - 0.35 * n.y - 0.82 * n.z);
    Rgb colour = clay(lit);
    if (coloured)
      colour = {1.0 * skin->vertex_rgb[3 * i], 1.0 * skin->vertex_rgb[3 * i + 1],
                1.0 * skin->vertex_rgb[3 * i + 2]};
    return Corner{window.x(pair.focal_px * p.x / p.z + pair.left_centre_px.x),
                  window.y(pair.focal_px * p.y / p.z + pair.left_centre_px.y), p.z, colour};
  };
  draw_triangles(mesh, corner, canvas);
}

void draw_head(const pipeline::FaceMesh& mesh, const pipeline::RigidTransform& head_from_camera,
               double turned_deg, double across_mm, StageCanvas& canvas) {
  constexpr double kPi = 3.14159265358979323846;
  const double side = canvas.side(), c = std::cos(turned_deg * kPi / 180),
               s = std::sin(turned_deg * kPi / 180);
  const pipeline::Rotation turn{{c, 0, s, 0, 1, 0, -s, 0, c}};
  const auto turned = [&](const pipeline::Vec3f& v) {
    return apply(turn, apply(head_from_camera, pipeline::Vec3d{v.x, v.y, v.z}));
  };
  Range x, y;
  for (const auto& v : mesh.vertices_mm) {
    const pipeline::Vec3d p = turned(v);
    x.add(p.x), y.add(p.y);
  }
  const double middle_x = (x.low + x.high) / 2, middle_y = (y.low + y.high) / 2;
  const auto corner = [&](std::uint32_t i) {
    const pipeline::Vec3d p = turned(mesh.vertices_mm[i]);
    const pipeline::Vec3f& n = mesh.normals[i];
    const pipeline::Vec3d m = apply(turn, apply(head_from_camera.rotation, pipeline::Vec3d{n.x, n.y, n.z}));
    const double lit = std::max(0.0, -0.45 * m.x + 0.35 * m.y + 0.82 * m.z);
    return Corner{side * (0.5 + (p.x - middle_x) / across_mm), side * (0.5 - (p.y - middle_y) / across_mm),
                  -p.z, clay(lit)};
  };
  draw_triangles(mesh, corner, canvas);
}

}  // namespace relievo::firmware
