// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/text_engine.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "ui/text/pango_paragraph.h"

namespace relievo::ui {
namespace {

std::uint64_t mix(std::uint64_t hash, const void* bytes, std::size_t size) {  // FNV-1a
  const auto* at = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ at[i]) * 1099511628211ULL;
  return hash;
}

std::uint64_t key_of(std::string_view text, const TextStyle& style, int width) {
  std::uint64_t hash = mix(14695981039346656037ULL, text.data(), text.size());
  const std::uint32_t numbers[] = {static_cast<std::uint32_t>(std::lround(style.size_px * 8)),
                                   static_cast<std::uint32_t>(width),
                                   static_cast<std::uint32_t>(style.weight),
                                   static_cast<std::uint32_t>(style.align),
                                   static_cast<std::uint32_t>(style.icon),
                                   static_cast<std::uint32_t>(style.right_to_left),
                                   static_cast<std::uint32_t>(style.tabular)};
  hash = mix(hash, numbers, sizeof numbers);
  return mix(hash, style.language, std::strlen(style.language));
}

class CachedTextEngine final : public TextEngine {
 public:
  Result<void> check_fonts() { return paragraph_.check_fonts(); }

  TextSize measure(std::string_view text, const TextStyle& style, float max_width_px) override {
    return find(text, style, max_width_px).label.size;
  }

  const TextLabel& label(std::string_view text, const TextStyle& style, float max_width_px) override {
    Entry& entry = find(text, style, max_width_px);
    if (entry.generation != atlas_.generation()) rasterise(text, style, max_width_px, entry);
    return entry.label;
  }

  TextAtlas& atlas() override { return atlas_; }

  void forget() override {
    labels_.clear();
    atlas_.reset();
    paragraph_.forget();
  }

 private:
  struct Entry {
    TextLabel label;
    std::uint32_t generation = 0;
  };

  Entry& find(std::string_view text, const TextStyle& style, float max_width_px) {
    const int width = std::max(1, static_cast<int>(std::ceil(max_width_px)));
    const std::uint64_t key = key_of(text, style, width);
    const auto known = labels_.find(key);
    if (known != labels_.end()) return known->second;
    if (labels_.size() > 4000) forget();
    Entry& entry = labels_[key];
    const SetText& set = paragraph_.set(text, style, width);
    // A pixel more: boxes are rounded to whole pixels, and must not lose a word by that.
    entry.label.size = {std::ceil(set.width_px) + 1, std::ceil(set.height_px), set.lines};
    entry.label.missing = set.missing;
    entry.label.torn = set.torn;
    return entry;
  }

  void rasterise(std::string_view text, const TextStyle& style, float max_width_px, Entry& entry) {
    const SetText& set = paragraph_.set(text, style, std::max(1, static_cast<int>(std::ceil(max_width_px))));
    // All in whole pixels, so that letters stay sharp.
    const int left = static_cast<int>(std::floor(set.left)) - 1,
              top = static_cast<int>(std::floor(set.top)) - 1;
    const int right = static_cast<int>(std::ceil(set.right)) + 1,
              bottom = static_cast<int>(std::ceil(set.bottom)) + 1;
    const int w = std::clamp(right - left, 1, atlas_.side_px() - 2),
              h = std::clamp(bottom - top, 1, atlas_.side_px() - 2);
    auto at = atlas_.place(w, h);
    if (!at) {
      atlas_.reset();
      at = atlas_.place(w, h);
    }
    entry.generation = atlas_.generation();
    entry.label.ink = {static_cast<float>(left), static_cast<float>(top), static_cast<float>(w),
                       static_cast<float>(h)};
    entry.label.atlas = {static_cast<float>(at->x), static_cast<float>(at->y), static_cast<float>(w),
                         static_cast<float>(h)};
    const GlyphCoverage drawn = paragraph_.draw(left, top, w, h);
    for (int y = 0; y < h; ++y)
      std::memcpy(atlas_.row(at->x, at->y + y), drawn.row(y), static_cast<std::size_t>(w));
  }

  PangoParagraph paragraph_;
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
