// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TextAtlas: one grey picture with all the text that is on the screen, packed in shelves. When it is
// full it starts anew (generation grows) and what is shown is drawn into it again.
// Memory: one byte a texel, taken once. Texels; origin top left. Thread: main.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace relievo::ui {

struct AtlasPlace {
  int x = 0, y = 0;
};

class TextAtlas {
 public:
  explicit TextAtlas(int side_px = 2048)
      : side_(side_px), texels_(static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px)) {}

  int side_px() const { return side_; }
  const std::uint8_t* texels() const { return texels_.data(); }
  std::uint32_t generation() const { return generation_; }

  // Room for a label; nothing when there is none: reset() and draw everything again.
  std::optional<AtlasPlace> place(int width_px, int height_px);
  std::uint8_t* row(int x, int y) {
    return texels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + x;
  }
  void reset();

  // Rows that changed since the last call: [first, last). Empty when first >= last.
  struct Rows {
    int first = 0, last = 0;
  };
  Rows take_changed();

 private:
  int side_;
  std::vector<std::uint8_t> texels_;
  struct Shelf {
    int y = 0, height = 0, used = 0;
  };
  std::vector<Shelf> shelves_;
  int shelf_end_ = 0;
  Rows changed_;
  std::uint32_t generation_ = 1;
};

}  // namespace relievo::ui
