// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <unordered_map>

#include "ui/text/phrases.h"
#include "ui/text/text_engine.h"
#include "ui/theme.h"

namespace relievo::ui {
namespace {

constexpr float kScale = PANGO_SCALE;
constexpr int kBalancedLines = 6;  // longer paragraphs are read, not looked at

template <typename T>
struct Unref {
  void operator()(T* object) const { g_object_unref(object); }
};
template <typename T>
using Owned = std::unique_ptr<T, Unref<T>>;
struct UnrefAttributes {
  void operator()(PangoAttrList* list) const { pango_attr_list_unref(list); }
};

std::uint64_t mix(std::uint64_t hash, const void* bytes, std::size_t size) {  // FNV-1a
  const auto* at = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ at[i]) * 1099511628211ULL;
  return hash;
}

std::uint64_t key_of(std::string_view text, const TextStyle& style, int width) {
  std::uint64_t hash = mix(14695981039346656037ULL, text.data(), text.size());
  const std::uint32_t numbers[] = {static_cast<std::uint32_t>(std::lround(style.size_px * 8)), static_cast<std::uint32_t>(width),
                                   static_cast<std::uint32_t>(style.weight), static_cast<std::uint32_t>(style.align),
                                   static_cast<std::uint32_t>(style.icon), static_cast<std::uint32_t>(style.right_to_left), static_cast<std::uint32_t>(style.tabular)};
  hash = mix(hash, numbers, sizeof numbers);
  return mix(hash, style.language, std::strlen(style.language));
}

PangoWeight pango_weight(Weight weight) {
  switch (weight) {
    case Weight::Regular: return PANGO_WEIGHT_NORMAL;
    case Weight::Medium: return PANGO_WEIGHT_SEMIBOLD;
    case Weight::Bold: return PANGO_WEIGHT_BOLD;
  }
  return PANGO_WEIGHT_NORMAL;
}

bool is(const TextStyle& style, const char* language) { return std::strcmp(style.language, language) == 0; }

// Lines as the page's script has them, whatever fonts the letters on them come from: fonts bring room of their own, and
// an Arabic one twice what a line needs.
const type::Lines& lines_of(const TextStyle& style) {
  if (is(style, "ar")) return type::kArabicLines;
  return is(style, "zh-Hans") || is(style, "ja") ? type::kHanLines : type::kLines;
}

const char* families_of(const TextStyle& style) { return style.icon ? kIconFamily : is(style, "ja") ? kJapaneseFamilies : kFamilies; }

class PangoTextEngine final : public TextEngine {
 public:
  PangoTextEngine() : map_(pango_cairo_font_map_new()), context_(pango_font_map_create_context(map_.get())) {
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(context_.get(), options);
    cairo_font_options_destroy(options);
    pango_cairo_context_set_resolution(context_.get(), 72);
    layout_.reset(pango_layout_new(context_.get()));
    tabular_.reset(pango_attr_list_new());
    pango_attr_list_insert(tabular_.get(), pango_attr_font_features_new("tnum=1"));
  }

  Result<void> check_fonts() {
    for (const char* family : {"Inter", "Noto Sans Arabic", "Noto Sans Hebrew", "Noto Sans CJK SC", "Noto Sans CJK JP", kIconFamily}) {
      PangoFontDescription* wanted = pango_font_description_from_string(family);
      Owned<PangoFont> font(pango_font_map_load_font(map_.get(), context_.get(), wanted));
      pango_font_description_free(wanted);
      PangoFontDescription* got = font ? pango_font_describe(font.get()) : nullptr;
      const bool same = got != nullptr && std::strcmp(pango_font_description_get_family(got), family) == 0;
      if (got != nullptr) pango_font_description_free(got);
      if (!same) return Error{Errc::NotFound, "is not installed: run toolchain/setup for the fonts"}.at(family);
    }
    return {};
  }

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
    pango_layout_set_text(layout_.get(), "", 0);
  }

 private:
  struct Entry {
    TextLabel label;
    std::uint32_t generation = 0;
  };
  struct SetLine {
    float x = 0, baseline = 0;
  };
  struct SetText {   // of the paragraph in layout_; its ink from `left` to `bottom`
    float width_px = 0, height_px = 0, left = 0, top = 0, right = 0, bottom = 0;
  };

  Entry& find(std::string_view text, const TextStyle& style, float max_width_px) {
    const int width = std::max(1, static_cast<int>(std::ceil(max_width_px)));
    const std::uint64_t key = key_of(text, style, width);
    const auto known = labels_.find(key);
    if (known != labels_.end()) return known->second;
    if (labels_.size() > 4000) forget();
    Entry& entry = labels_[key];
    set_out(text, style, width);
    set_lines(style);
    // A pixel more: boxes are rounded to whole pixels, and must not lose a word by that.
    entry.label.size = {std::ceil(set_.width_px) + 1, std::ceil(set_.height_px), pango_layout_get_line_count(layout_.get())};
    entry.label.missing = pango_layout_get_unknown_glyphs_count(layout_.get());
    entry.label.torn = broken_words(false);
    return entry;
  }

  // Sets the paragraph out at the narrowest width that needs no more lines: lines of even length.
  void set_out(std::string_view text, const TextStyle& style, int width) {
    PangoLayout* layout = layout_.get();
    PangoFontDescription* font = pango_font_description_new();
    pango_font_description_set_family_static(font, families_of(style));
    pango_font_description_set_weight(font, style.icon ? PANGO_WEIGHT_NORMAL : pango_weight(style.weight));
    pango_font_description_set_absolute_size(font, style.size_px * kScale);
    pango_context_set_base_dir(context_.get(), style.right_to_left ? PANGO_DIRECTION_RTL : PANGO_DIRECTION_LTR);
    pango_context_set_language(context_.get(), pango_language_from_string(style.language));
    pango_layout_context_changed(layout);
    pango_layout_set_auto_dir(layout, FALSE);
    pango_layout_set_font_description(layout, font);
    pango_font_description_free(font);
    pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
    const bool at_right = style.right_to_left != (style.align == TextAlign::End);
    pango_layout_set_alignment(layout, style.align == TextAlign::Centre ? PANGO_ALIGN_CENTER : at_right ? PANGO_ALIGN_RIGHT : PANGO_ALIGN_LEFT);
    pango_layout_set_text(layout, text.data(), static_cast<int>(text.size()));
    PangoAttrList* const plain = style.tabular ? tabular_.get() : nullptr;
    pango_layout_set_attributes(layout, plain);
    pango_layout_set_width(layout, width * PANGO_SCALE);
    const int lines = pango_layout_get_line_count(layout);
    if (lines > 1 && (is(style, "zh-Hans") || is(style, "ja"))) keep_whole(phrase_starts(text, is(style, "ja")), text, width, lines, plain);
    else if (lines == 2 && style.weight == Weight::Bold) keep_whole(sentence_starts(text), text, width, lines, plain);
    int narrow = 0, wide = width;
    if (lines > 1 && lines <= kBalancedLines) {
      for (narrow = width / 2; wide - narrow > 4;) {
        const int middle = (narrow + wide) / 2;
        pango_layout_set_width(layout, middle * PANGO_SCALE);
        if (pango_layout_get_line_count(layout) <= lines && !breaks_words() && is_within(middle)) wide = middle;
        else narrow = middle;
      }
      pango_layout_set_width(layout, wide * PANGO_SCALE);
    }
    // The box is as wide as its widest line.
    PangoRectangle logical;
    pango_layout_get_extents(layout, nullptr, &logical);
    pango_layout_set_width(layout, logical.width + PANGO_SCALE / 2);
  }

  // Where the lines of the paragraph lie, and their ink. Lines are as high as their script has them; the first and the
  // last give more where a letter of another script needs it.
  void set_lines(const TextStyle& style) {
    PangoRectangle whole;
    pango_layout_get_extents(layout_.get(), nullptr, &whole);
    set_ = {static_cast<float>(whole.width) / kScale, 0, 1e6F, 1e6F, -1e6F, -1e6F};
    lines_.clear();
    const type::Lines& lines = lines_of(style);
    const float apart = std::round(style.size_px * (style.weight == Weight::Bold ? lines.apart_bold : lines.apart));
    PangoLayoutIter* at = pango_layout_get_iter(layout_.get());
    do {
      PangoRectangle ink, logical;
      pango_layout_iter_get_line_extents(at, &ink, &logical);
      const float own = static_cast<float>(pango_layout_iter_get_baseline(at)) / kScale, top = static_cast<float>(ink.y) / kScale;
      const float bottom = static_cast<float>(ink.y + ink.height) / kScale, left = static_cast<float>(ink.x - whole.x) / kScale;
      // Whole pixels, so that letters stay sharp; a sign stands as its font has it.
      const float first = style.icon ? own : std::round(std::max(style.size_px * lines.above, own - top));
      const float baseline = lines_.empty() ? first : lines_.back().baseline + apart;
      lines_.push_back({static_cast<float>(logical.x - whole.x) / kScale, baseline});
      set_.height_px = style.icon ? static_cast<float>(whole.height) / kScale : baseline + std::max(style.size_px * lines.below, bottom - own);
      if (ink.width <= 0 || ink.height <= 0) continue;
      set_.left = std::min(set_.left, left), set_.right = std::max(set_.right, left + static_cast<float>(ink.width) / kScale);
      set_.top = std::min(set_.top, baseline + top - own), set_.bottom = std::max(set_.bottom, baseline + bottom - own);
    } while (pango_layout_iter_next_line(at) != 0);
    pango_layout_iter_free(at);
    if (set_.left > set_.right) set_.left = set_.top = set_.right = set_.bottom = 0;   // blanks
  }

  // Lines end between phrases (or sentences) where that costs no line more; otherwise as the script has it.
  void keep_whole(std::vector<std::size_t> starts, std::string_view text, int width, int lines, PangoAttrList* plain) {
    if (starts.empty()) return;
    PangoAttrList* whole = plain != nullptr ? pango_attr_list_copy(plain) : pango_attr_list_new();
    starts.push_back(text.size());
    std::size_t from = 0;
    for (const std::size_t to : starts) {
      PangoAttribute* phrase = pango_attr_allow_breaks_new(FALSE);
      phrase->start_index = static_cast<guint>(from);
      phrase->end_index = static_cast<guint>(to);
      pango_attr_list_insert(whole, phrase);
      from = to;
    }
    pango_layout_set_attributes(layout_.get(), whole);
    pango_attr_list_unref(whole);
    if (pango_layout_get_line_count(layout_.get()) > lines || breaks_words() || !is_within(width)) pango_layout_set_attributes(layout_.get(), plain);
  }

  bool is_within(int width) {
    PangoRectangle logical;
    pango_layout_get_extents(layout_.get(), nullptr, &logical);
    return logical.width <= width * PANGO_SCALE;
  }

  // A line that ends inside a word, be it at a soft hyphen: allowed where nothing else fits, never for even lines.
  bool breaks_words() { return broken_words(true) > 0; }

  int broken_words(bool at_hyphens_too) {
    int count = 0, broken = 0;
    const PangoLogAttr* marks = pango_layout_get_log_attrs_readonly(layout_.get(), &count);
    const char* text = pango_layout_get_text(layout_.get());
    for (GSList* at = pango_layout_get_lines_readonly(layout_.get()); at != nullptr; at = at->next) {
      auto* line = static_cast<PangoLayoutLine*>(at->data);
      const long start = g_utf8_pointer_to_offset(text, text + pango_layout_line_get_start_index(line));
      if (start > 0 && start < count && (marks[start].is_line_break == 0 || (at_hyphens_too && marks[start].break_inserts_hyphen != 0))) ++broken;
    }
    return broken;
  }

  void rasterise(std::string_view text, const TextStyle& style, float max_width_px, Entry& entry) {
    set_out(text, style, std::max(1, static_cast<int>(std::ceil(max_width_px))));
    set_lines(style);
    // All in whole pixels, so that letters stay sharp.
    const int left = static_cast<int>(std::floor(set_.left)) - 1, top = static_cast<int>(std::floor(set_.top)) - 1;
    const int right = static_cast<int>(std::ceil(set_.right)) + 1, bottom = static_cast<int>(std::ceil(set_.bottom)) + 1;
    const int w = std::clamp(right - left, 1, atlas_.side_px() - 2), h = std::clamp(bottom - top, 1, atlas_.side_px() - 2);
    auto at = atlas_.place(w, h);
    if (!at) {
      atlas_.reset();
      at = atlas_.place(w, h);
    }
    entry.generation = atlas_.generation();
    entry.label.ink = {static_cast<float>(left), static_cast<float>(top), static_cast<float>(w), static_cast<float>(h)};
    entry.label.atlas = {static_cast<float>(at->x), static_cast<float>(at->y), static_cast<float>(w), static_cast<float>(h)};
    const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_A8, w);
    ink_.assign(static_cast<std::size_t>(stride) * static_cast<std::size_t>(h), 0);
    cairo_surface_t* surface = cairo_image_surface_create_for_data(ink_.data(), CAIRO_FORMAT_A8, w, h, stride);
    cairo_t* cairo = cairo_create(surface);
    GSList* line = pango_layout_get_lines_readonly(layout_.get());
    for (const SetLine& one : lines_) {
      cairo_move_to(cairo, static_cast<double>(one.x) - left, static_cast<double>(one.baseline) - top);
      pango_cairo_show_layout_line(cairo, static_cast<PangoLayoutLine*>(line->data));
      line = line->next;
    }
    cairo_destroy(cairo);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    for (int y = 0; y < h; ++y)
      std::memcpy(atlas_.row(at->x, at->y + y), ink_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(stride), static_cast<std::size_t>(w));
  }

  Owned<PangoFontMap> map_;
  Owned<PangoContext> context_;
  Owned<PangoLayout> layout_;
  std::unique_ptr<PangoAttrList, UnrefAttributes> tabular_;
  TextAtlas atlas_;
  std::unordered_map<std::uint64_t, Entry> labels_;
  std::vector<unsigned char> ink_;
  SetText set_;
  std::vector<SetLine> lines_;
};

}  // namespace

Result<std::unique_ptr<TextEngine>> TextEngine::make() {
  auto engine = std::make_unique<PangoTextEngine>();
  RELIEVO_TRY(engine->check_fonts());
  return std::unique_ptr<TextEngine>(std::move(engine));
}

}  // namespace relievo::ui
