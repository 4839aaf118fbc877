// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/pango_paragraph.h"

#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "ui/draw/theme.h"

namespace relievo::ui {
namespace {

constexpr float kScale = PANGO_SCALE;
constexpr int kBalancedLines = 6;  // longer paragraphs are read, not looked at
constexpr std::string_view kLineSeparator = "\u2028";

template <typename T>
struct Unref {
  void operator()(T* object) const { g_object_unref(object); }
};
template <typename T>
using Owned = std::unique_ptr<T, Unref<T>>;
struct UnrefAttributes {
  void operator()(PangoAttrList* list) const { pango_attr_list_unref(list); }
};

// In the order of Weight.
constexpr PangoWeight kWeights[] = {PANGO_WEIGHT_NORMAL, PANGO_WEIGHT_SEMIBOLD, PANGO_WEIGHT_BOLD};
static_assert(std::size(kWeights) == std::size_t(Weight::Bold) + 1);

bool is(const TextStyle& style, const char* language) { return std::strcmp(style.language, language) == 0; }

// Lines as the page's script has them, whatever fonts the letters on them come from: fonts bring room of
// their own, and an Arabic one twice what a line needs.
const type::Lines& lines_of(const TextStyle& style) {
  if (is(style, "ar")) return type::kArabicLines;
  return is(style, "zh-Hans") || is(style, "ja") ? type::kHanLines : type::kLines;
}

const char* families_of(const TextStyle& style) {
  return style.icon ? kIconFamily : is(style, "ja") ? kJapaneseFamilies : kFamilies;
}

class Paragraph final : public PangoParagraph {
 public:
  Paragraph() : map_(pango_cairo_font_map_new()), context_(pango_font_map_create_context(map_.get())) {
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

  Result<void> check_fonts() override {
    for (const char* family : {"Inter", "Noto Sans Arabic", "Noto Sans Hebrew", "Noto Sans CJK SC",
                               "Noto Sans CJK JP", kIconFamily}) {
      PangoFontDescription* wanted = pango_font_description_from_string(family);
      Owned<PangoFont> font(pango_font_map_load_font(map_.get(), context_.get(), wanted));
      pango_font_description_free(wanted);
      PangoFontDescription* got = font ? pango_font_describe(font.get()) : nullptr;
      const bool same = got != nullptr && std::strcmp(pango_font_description_get_family(got), family) == 0;
      if (got != nullptr) pango_font_description_free(got);
      if (!same)
        return Error{
            Errc::NotFound,
            "is not installed: Debian has it in fonts-inter, fonts-noto-core, fonts-noto-cjk, fonts-materialdesignicons-webfont"}
            .at(family);
    }
    return {};
  }

  const TextLabel& set(std::string_view text, const TextStyle& style, int width) override {
    set_style(style);
    set_out(text, style, width);
    set_lines(style);
    set_.size.lines = pango_layout_get_line_count(layout_.get());
    set_.missing = pango_layout_get_unknown_glyphs_count(layout_.get());
    set_.torn = broken_words(false);
    return set_;
  }

  GlyphCoverage draw(int left, int top, int w, int h) override {
    const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_A8, w);
    ink_.assign(std::size_t(stride) * std::size_t(h), 0);
    cairo_surface_t* surface =
        cairo_image_surface_create_for_data(ink_.data(), CAIRO_FORMAT_A8, w, h, stride);
    cairo_t* cairo = cairo_create(surface);
    GSList* line = pango_layout_get_lines_readonly(layout_.get());
    for (const SetLine& one : lines_) {
      if (one.bottom >= float(top) && one.top <= float(top + h)) {  // a long text is drawn in pieces
        cairo_move_to(cairo, double(one.x) - left, double(one.baseline) - top);
        pango_cairo_show_layout_line(cairo, static_cast<PangoLayoutLine*>(line->data));
      }
      line = line->next;
    }
    cairo_destroy(cairo);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    return {ink_.data(), stride};
  }

  void forget() override {
    pango_layout_set_text(layout_.get(), "", 0);
    std::ranges::fill(joined_, '\0');  // clear() would leave the bytes
    std::ranges::fill(ink_, static_cast<unsigned char>(0));
  }

 private:
  struct SetLine {
    float x = 0, baseline = 0;
    float top = 0, bottom = 0;  // of its ink
  };

  void set_style(const TextStyle& style) {
    PangoLayout* layout = layout_.get();
    PangoFontDescription* font = pango_font_description_new();
    pango_font_description_set_family_static(font, families_of(style));
    pango_font_description_set_weight(font, style.icon ? PANGO_WEIGHT_NORMAL : kWeights[int(style.weight)]);
    pango_font_description_set_absolute_size(font, style.size_px * kScale);
    pango_context_set_base_dir(context_.get(),
                               style.right_to_left ? PANGO_DIRECTION_RTL : PANGO_DIRECTION_LTR);
    pango_context_set_language(context_.get(), pango_language_from_string(style.language));
    pango_layout_context_changed(layout);
    pango_layout_set_auto_dir(layout, FALSE);
    pango_layout_set_font_description(layout, font);
    pango_font_description_free(font);
    pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
    const bool at_right = style.right_to_left != (style.align == TextAlign::End);
    pango_layout_set_alignment(layout, style.align == TextAlign::Centre ? PANGO_ALIGN_CENTER
                                       : at_right                       ? PANGO_ALIGN_RIGHT
                                                                        : PANGO_ALIGN_LEFT);
    pango_layout_set_attributes(layout, style.tabular ? tabular_.get() : nullptr);
  }

  void put(std::string_view text, int width) {
    pango_layout_set_text(layout_.get(), text.data(), int(text.size()));
    pango_layout_set_width(layout_.get(), width < 0 ? -1 : width * PANGO_SCALE);
  }

  // Sets the paragraph out at the narrowest width that needs no more lines: lines of even length.
  void set_out(std::string_view text, const TextStyle& style, int width) {
    PangoLayout* layout = layout_.get();
    put(text, width);
    const int lines = pango_layout_get_line_count(layout);
    const bool evened = lines > 1 && lines <= kBalancedLines;
    if (!(lines > 1 && ends_between_phrases(text, style, width, lines, evened)) && evened) {
      int narrow = width / 2, wide = width;
      while (wide - narrow > 4) {
        const int middle = (narrow + wide) / 2;
        pango_layout_set_width(layout, middle * PANGO_SCALE);
        if (pango_layout_get_line_count(layout) <= lines && !breaks_words() && is_within(middle))
          wide = middle;
        else narrow = middle;
      }
      pango_layout_set_width(layout, wide * PANGO_SCALE);
    }
    // The box is as wide as its widest line.
    PangoRectangle logical;
    pango_layout_get_extents(layout, nullptr, &logical);
    pango_layout_set_width(layout, logical.width + PANGO_SCALE / 2);
  }

  // Lines end between phrases (Chinese, Japanese) or sentences (two lines) where that costs no line more;
  // otherwise as the script has it. The ends are chosen here and said by line separators: where spans are
  // told to allow no breaks, Pango 1.50 may end the program ("process_line: assertion failed").
  bool ends_between_phrases(std::string_view text, const TextStyle& style, int width, int lines,
                            bool evened) {
    const bool unspaced = is(style, "zh-Hans") || is(style, "ja");
    if (!unspaced && lines != 2) return false;
    std::vector<std::size_t> starts = unspaced ? phrase_starts(text, is(style, "ja")) : sentence_starts(text);
    if (starts.empty() || text.find('\n') != std::string_view::npos) return false;
    starts.insert(starts.begin(), 0);
    widths_.clear();
    for (std::size_t i = 0; i < starts.size(); ++i) {
      put(text.substr(starts[i], i + 1 < starts.size() ? starts[i + 1] - starts[i] : std::string_view::npos),
          -1);
      PangoRectangle logical;
      pango_layout_get_extents(layout_.get(), nullptr, &logical);
      widths_.push_back(float(logical.width) / kScale);
    }
    joined_.clear();
    std::size_t from = 0;
    for (const std::size_t phrase : fill_lines(widths_, float(width), evened)) {
      std::string_view line = text.substr(from, starts[phrase] - from);
      if (line.ends_with(' ')) line.remove_suffix(1);
      joined_.append(line).append(kLineSeparator);
      from = starts[phrase];
    }
    put(joined_.append(text.substr(from)), width);
    if (pango_layout_get_line_count(layout_.get()) <= lines && !breaks_words() && is_within(width))
      return true;
    put(text, width);
    return false;
  }

  // Where the lines of the paragraph lie, and their ink. Lines are as high as their script has them; the
  // first and the last give more where a letter of another script needs it.
  void set_lines(const TextStyle& style) {
    PangoRectangle whole;
    pango_layout_get_extents(layout_.get(), nullptr, &whole);
    float ink_left = 1e6F, ink_top = 1e6F, ink_right = -1e6F, ink_bottom = -1e6F, height = 0;
    lines_.clear();
    const type::Lines& lines = lines_of(style);
    const float apart =
        std::round(style.size_px * (style.weight == Weight::Bold ? lines.apart_bold : lines.apart));
    PangoLayoutIter* at = pango_layout_get_iter(layout_.get());
    do {
      PangoRectangle ink, logical;
      pango_layout_iter_get_line_extents(at, &ink, &logical);
      const float own = float(pango_layout_iter_get_baseline(at)) / kScale, top = float(ink.y) / kScale;
      const float bottom = float(ink.y + ink.height) / kScale, left = float(ink.x - whole.x) / kScale;
      // Whole pixels, so that letters stay sharp; a sign stands as its font has it.
      const float first = style.icon ? own : std::round(std::max(style.size_px * lines.above, own - top));
      const float baseline = lines_.empty() ? first : lines_.back().baseline + apart;
      lines_.push_back(
          {float(logical.x - whole.x) / kScale, baseline, baseline + top - own, baseline + bottom - own});
      height = style.icon ? float(whole.height) / kScale
                          : baseline + std::max(style.size_px * lines.below, bottom - own);
      if (ink.width <= 0 || ink.height <= 0) continue;
      ink_left = std::min(ink_left, left), ink_right = std::max(ink_right, left + float(ink.width) / kScale);
      ink_top = std::min(ink_top, baseline + top - own),
      ink_bottom = std::max(ink_bottom, baseline + bottom - own);
    } while (pango_layout_iter_next_line(at) != 0);
    pango_layout_iter_free(at);
    if (ink_left > ink_right) ink_left = ink_top = ink_right = ink_bottom = 0;  // blanks
    // A pixel more: boxes are rounded to whole pixels, and must not lose a word by that.
    set_.size = {std::ceil(float(whole.width) / kScale) + 1, std::ceil(height), 0};
    // All in whole pixels, so that letters stay sharp.
    const float x = std::floor(ink_left) - 1, y = std::floor(ink_top) - 1;
    set_.ink = {x, y, std::ceil(ink_right) + 1 - x, std::ceil(ink_bottom) + 1 - y};
  }

  bool is_within(int width) {
    PangoRectangle logical;
    pango_layout_get_extents(layout_.get(), nullptr, &logical);
    return logical.width <= width * PANGO_SCALE;
  }

  // A line that ends inside a word, be it at a soft hyphen: allowed where nothing else fits, never for even
  // lines.
  bool breaks_words() { return broken_words(true) > 0; }

  int broken_words(bool at_hyphens_too) {
    int count = 0, broken = 0;
    const PangoLogAttr* marks = pango_layout_get_log_attrs_readonly(layout_.get(), &count);
    const char* text = pango_layout_get_text(layout_.get());
    for (GSList* at = pango_layout_get_lines_readonly(layout_.get()); at != nullptr; at = at->next) {
      auto* line = static_cast<PangoLayoutLine*>(at->data);
      const long start = g_utf8_pointer_to_offset(text, text + pango_layout_line_get_start_index(line));
      if (start > 0 && start < count &&
          (marks[start].is_line_break == 0 || (at_hyphens_too && marks[start].break_inserts_hyphen != 0)))
        ++broken;
    }
    return broken;
  }

  Owned<PangoFontMap> map_;
  Owned<PangoContext> context_;
  Owned<PangoLayout> layout_;
  std::unique_ptr<PangoAttrList, UnrefAttributes> tabular_;
  std::vector<unsigned char> ink_;
  TextLabel set_;
  std::vector<SetLine> lines_;
  std::vector<float> widths_;
  std::string joined_;
};

}  // namespace

std::unique_ptr<PangoParagraph> PangoParagraph::make() { return std::make_unique<Paragraph>(); }

}  // namespace relievo::ui
