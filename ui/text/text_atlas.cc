// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/text_atlas.h"

#include <algorithm>
#include <cstring>

namespace relievo::ui {

std::optional<AtlasPlace> TextAtlas::place(int width_px, int height_px) {
  const int width = width_px + 1, height = height_px + 1;  // a texel apart: filtering must not mix labels
  if (width > side_ || height > side_) return std::nullopt;
  Shelf* best = nullptr;
  for (Shelf& shelf : shelves_) {
    const bool fits =
        shelf.height >= height && shelf.height <= height + height / 2 + 4 && shelf.used + width <= side_;
    if (fits && (best == nullptr || shelf.height < best->height)) best = &shelf;
  }
  if (best == nullptr) {
    if (shelf_end_ + height > side_) return std::nullopt;
    shelves_.push_back({shelf_end_, height, 0});
    shelf_end_ += height;
    best = &shelves_.back();
  }
  const AtlasPlace at{best->used, best->y};
  best->used += width;
  changed_.first = changed_.first >= changed_.last ? at.y : std::min(changed_.first, at.y);
  changed_.last = std::max(changed_.last, at.y + height);
  return at;
}

void TextAtlas::reset() {
  shelves_.clear();
  shelf_end_ = 0;
  std::memset(texels_.data(), 0, texels_.size());
  changed_ = {0, side_};
  ++generation_;
}

TextAtlas::Rows TextAtlas::take_changed() {
  const Rows rows{changed_.first, std::min(changed_.last, side_)};
  changed_ = {0, 0};
  return rows;
}

}  // namespace relievo::ui
