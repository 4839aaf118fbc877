// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/text_engine.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>
#include <utility>

#include "ui/text/pango_paragraph.h"

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

namespace {

// Pieces of a large text fill the atlas, four in a shelf: a long one is scrolled through it.
constexpr int kPieceWidthPx = 510, kPieceHeightPx = 254, kWholeHeightPx = 64;

bool meet(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

std::uint64_t mix(std::uint64_t hash, const void* bytes, std::size_t size) {  // FNV-1a
  const auto* at = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ at[i]) * 1099511628211ULL;
  return hash;
}

std::uint64_t key_of(std::string_view text, const TextStyle& style, int width) {
  std::uint64_t hash = mix(14695981039346656037ULL, text.data(), text.size());
  const std::uint32_t numbers[] = {std::uint32_t(std::lround(style.size_px * 8)),
                                   std::uint32_t(width),
                                   std::uint32_t(style.weight),
                                   std::uint32_t(style.align),
                                   std::uint32_t(style.icon),
                                   std::uint32_t(style.right_to_left),
                                   std::uint32_t(style.tabular)};
  hash = mix(hash, numbers, sizeof numbers);
  return mix(hash, style.language, std::strlen(style.language));
}

class CachedTextEngine final : public TextEngine {
 public:
  Result<void> check_fonts() { return paragraph_->check_fonts(); }

  TextSize measure(std::string_view text, const TextStyle& style, float max_width_px) override {
    return find(text, style, max_width_px).label.size;
  }

  const TextLabel& label(std::string_view text, const TextStyle& style, float max_width_px) override {
    return label_of(find(text, style, max_width_px), text, style, max_width_px);
  }

  std::span<const TextPiece> pieces(std::string_view text, const TextStyle& style, float max_width_px,
                                    const Rect& seen) override {
    Entry& entry = find(text, style, max_width_px);
    const Rect ink = entry.label.ink;
    if (ink.h <= kWholeHeightPx && ink.w <= float(atlas_.side_px() - 2)) {
      entry.pieces.resize(1);
      entry.pieces[0] = {ink, {}};
      if (meet(ink, seen)) entry.pieces[0].atlas = label_of(entry, text, style, max_width_px).atlas;
      return entry.pieces;
    }
    if (entry.pieces.empty()) cut(entry);
    keep_written(entry);
    bool is_set = false;
    for (TextPiece& piece : entry.pieces) {
      if (piece.atlas.w > 0 || !meet(piece.ink, seen)) continue;
      if (!std::exchange(is_set, true)) set(text, style, max_width_px);
      const Rect place = write(piece.ink);
      keep_written(entry);
      piece.atlas = place;
    }
    return entry.pieces;
  }

  TextAtlas& atlas() override { return atlas_; }

  void forget() override {
    labels_.clear();
    atlas_.reset();
    paragraph_->forget();
  }

 private:
  struct Entry {
    TextLabel label;
    std::uint32_t generation = 0;
    std::vector<TextPiece> pieces;
    std::uint32_t pieces_generation = 0;
  };

  Entry& find(std::string_view text, const TextStyle& style, float max_width_px) {
    const int width = std::max(1, int(std::ceil(max_width_px)));
    const std::uint64_t key = key_of(text, style, width);
    const auto known = labels_.find(key);
    if (known != labels_.end()) return known->second;
    if (labels_.size() > 4000) forget();
    Entry& entry = labels_[key];
    entry.label = paragraph_->set(text, style, width);
    return entry;
  }

  void set(std::string_view text, const TextStyle& style, float max_width_px) {
    (void)paragraph_->set(text, style, std::max(1, int(std::ceil(max_width_px))));
  }

  const TextLabel& label_of(Entry& entry, std::string_view text, const TextStyle& style, float max_width_px) {
    if (entry.generation == atlas_.generation()) return entry.label;
    set(text, style, max_width_px);
    const auto most = float(atlas_.side_px() - 2);
    const Rect& ink = entry.label.ink;
    entry.label.atlas = write({ink.x, ink.y, std::min(ink.w, most), std::min(ink.h, most)});
    entry.generation = atlas_.generation();
    return entry.label;
  }

  // What was written before the atlas started anew is gone.
  void keep_written(Entry& entry) {
    if (std::exchange(entry.pieces_generation, atlas_.generation()) == atlas_.generation()) return;
    for (TextPiece& piece : entry.pieces) piece.atlas = {};
  }

  static void cut(Entry& entry) {
    const Rect& ink = entry.label.ink;
    for (float y = ink.y; y < ink.bottom(); y += kPieceHeightPx)
      for (float x = ink.x; x < ink.right(); x += kPieceWidthPx)
        entry.pieces.push_back({{x, y, std::min(float(kPieceWidthPx), ink.right() - x),
                                 std::min(float(kPieceHeightPx), ink.bottom() - y)},
                                {}});
  }

  // Of the paragraph that was set last.
  Rect write(const Rect& ink) {
    const int w = int(ink.w), h = int(ink.h);
    auto at = atlas_.place(w, h);
    if (!at) {
      atlas_.reset();
      at = atlas_.place(w, h);
    }
    const GlyphCoverage drawn = paragraph_->draw(int(ink.x), int(ink.y), w, h);
    for (int y = 0; y < h; ++y) std::memcpy(atlas_.row(at->x, at->y + y), drawn.row(y), std::size_t(w));
    return {float(at->x), float(at->y), ink.w, ink.h};
  }

  std::unique_ptr<PangoParagraph> paragraph_ = PangoParagraph::make();
  TextAtlas atlas_;
  std::unordered_map<std::uint64_t, Entry> labels_;
};

}  // namespace

Result<std::unique_ptr<TextEngine>> TextEngine::make() {
  auto engine = std::make_unique<CachedTextEngine>();
  RELIEVO_TRY(engine->check_fonts());
  return std::unique_ptr<TextEngine>(std::move(engine));
}

}  // namespace relievo::ui
