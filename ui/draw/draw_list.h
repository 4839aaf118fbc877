// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DrawList: what is to be seen in one frame, as plain data in drawing order; no GL in it. The tree
// fills it, a Renderer draws it. Its vectors keep their room: after the first frames nothing is
// allocated. Pixels of the screen, origin at its top left corner. Colours: sRGB, alpha not premultiplied.
// Ownership: pictures, text atlas and model are borrowed until the frame is drawn. Thread: main.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/base/image_view.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/point_cloud.h"

namespace relievo::ui {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0, a = 0;
  constexpr bool seen() const { return a != 0; }
  constexpr Colour with_alpha(float share) const { return {r, g, b, std::uint8_t(float(a) * share)}; }
  bool operator==(const Colour&) const = default;
};

struct Rect {
  float x = 0, y = 0, w = 0, h = 0;
  constexpr float right() const { return x + w; }
  constexpr float bottom() const { return y + h; }
  constexpr bool holds(float px, float py) const {
    return px >= x && py >= y && px < right() && py < bottom();
  }
  bool operator==(const Rect&) const = default;
};

enum class Mark : std::uint8_t {
  Flat,   // a rectangle, from `fill` at the top to `fill_end` at the bottom
  Shape,  // rounded, with a border; blurred it is a shadow
  Glyph,  // a part of the text atlas, in `fill`
  Image,  // a picture with round corners
  Ring,   // an ellipse's line in `border`, `share` of it from the top clockwise; `fill` outside it.
          // The ellipse lies in the middle of the rect; uv.x and uv.y are its half axes, pixels
  Face    // the model, in three dimensions
};

// Pictures that change while they are shown; `version` tells the renderer when.
enum class PictureSlot : std::uint8_t {
  None,
  Live,
  Photograph,
  Matches,
  Cloud,
  Mesh,
  Texture,
  Sign,
  Receipt,
  Link,
  TechnicianLeft,
  TechnicianRight,
  TechnicianThird,
  TechnicianFourth,
  Count
};
inline constexpr std::size_t kPictureSlots = std::size_t(PictureSlot::Count);
struct Picture {
  ImageView pixels;           // Rgb8 or Grey8, rows without padding
  std::uint32_t version = 0;  // 0: there is none
  bool operator==(const Picture& other) const {
    return version == other.version && pixels.bytes == other.pixels.bytes;
  }
};

// A model that can be turned; `version` tells the renderer when it is another one.
inline constexpr std::size_t kFaces = 4;
struct Face {
  const pipeline::FaceModel* model = nullptr;
  const pipeline::PointCloud* cloud = nullptr;      // the points it was made of, where they are known
  std::uint32_t version = 0;                        // 0: there is none
  const pipeline::TextureAtlas* colours = nullptr;  // in place of the model's texture
  bool operator==(const Face&) const = default;
};

// How the models are looked at.
struct FaceLook {
  float yaw_deg = 0, pitch_deg = 0;
  float roll_deg = 0;  // of what is seen, clockwise
  float zoom = 1;
  float light_deg = -35;  // where the light stands, from the left
  bool textured = true;
  bool fill = true, lit = true;  // the surface itself; shaded by the light
  bool edges = false,
       points =
           false;  // the triangles' sides, as fine as the screen shows (face_geometry.h); the measured points
  bool backdrop = false;  // what the photograph showed around it stands behind, and its rim fades into that
  float born =
      1;  // how far it has come to be: 0 the photograph, then points, the bare surface, 1 its colours
  bool operator==(const FaceLook&) const = default;
};

struct Command {
  Mark mark = Mark::Flat;
  Rect rect;
  Rect clip;            // nothing is drawn outside
  Rect uv{0, 0, 1, 1};  // of the picture, 0 to 1; of the atlas, texels
  Colour fill, fill_end, border;
  float radius = 0, border_px = 0, blur_px = 0, share = 1;
  PictureSlot picture = PictureSlot::None;
  std::uint8_t face = 0;  // which of the models
  bool operator==(const Command&) const = default;
};

struct DrawList {
  std::vector<Command> commands;
  std::array<Picture, kPictureSlots> pictures{};
  std::array<Face, kFaces> faces{};
  FaceLook face_look;  // all are looked at alike

  void clear() { commands.clear(); }
  // Does it look the same? Then nobody need draw it again.
  bool operator==(const DrawList&) const = default;
};

}  // namespace relievo::ui
