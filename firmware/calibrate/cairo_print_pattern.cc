// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>

#include "firmware/calibrate/calibrate_command.h"
#include "hal/base/words.h"
#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::firmware {
namespace {

struct Paper {
  const char* name;
  double short_mm, long_mm;
};
constexpr std::array kPapers{Paper{"A4", 210, 297}, Paper{"A3", 297, 420}, Paper{"A2", 420, 594},
                             Paper{"A1", 594, 841}, Paper{"A0", 841, 1189}};

constexpr double kUnprintableMm = 5;  // rim that printers leave white
constexpr double kMinMarginMm = 8;    // white around the board, where squares are small
constexpr double kFooterMm = 10;      // for ruler and words, with the rim below
constexpr double kRulerMm = 100;
constexpr double kGapMm = 5;  // between ruler and words

std::string number(double value) { return printed("%.6g", value); }

std::vector<std::string> words_of(const pipeline::BoardPattern& b) {
  const std::string corners = std::to_string(b.columns) + "x" + std::to_string(b.rows);
  const std::string square = number(b.square_mm);
  std::string what = "chessboard";
  std::string how = "--corners " + corners + " --square-mm " + square;
  if (b.kind == pipeline::BoardKind::Charuco) {
    const std::string bits = std::to_string(b.marker_bits);
    what =
        "ChArUco board, markers " + number(b.marker_side_mm()) + " mm of DICT_" + bits + "X" + bits + "_1000";
    how = "--pattern charuco " + how;
    if (b.marker_mm > 0) how += " --marker-mm " + number(b.marker_mm);
    if (b.marker_bits != 4) how += " --marker-bits " + bits;
  }
  return {"Relievo " + what + ", " + corners + " inner corners, squares " + square + " mm: " + how,
          "Print at 100 %, measure this line: " + number(kRulerMm) + " mm. The outer squares measure " +
              number((b.columns + 1) * b.square_mm) + " x " + number((b.rows + 1) * b.square_mm) + " mm."};
}

constexpr double kPointsPerMm = 72 / 25.4;
constexpr double kTextMm = 2.2;
constexpr double kLineMm = 2.8;

struct Destroy {
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Cairo = std::unique_ptr<cairo_t, Destroy>;

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  static_cast<std::vector<std::byte>*>(closure)->insert(static_cast<std::vector<std::byte>*>(closure)->end(),
                                                        bytes, bytes + length);
  return CAIRO_STATUS_SUCCESS;
}

// Scaled so that user space is millimetres.
Surface make_surface(const PatternPage& page, PageFormat format, std::vector<std::byte>& out) {
  const double width = page.width_mm * kPointsPerMm;
  const double height = page.height_mm * kPointsPerMm;
  if (format == PageFormat::Svg)
    return Surface(cairo_svg_surface_create_for_stream(append, &out, width, height));
  Surface surface(cairo_pdf_surface_create_for_stream(append, &out, width, height));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, page.text.front().c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "Relievo");
  return surface;
}

// One path for all: neighbouring areas leave no seam between them.
void paint_board(cairo_t* cairo, const PatternPage& page, const std::vector<pipeline::BlackArea>& black) {
  for (const pipeline::BlackArea& area : black)
    cairo_rectangle(cairo, page.board_x_mm + area.x_mm, page.board_y_mm + area.y_mm, area.width_mm,
                    area.height_mm);
  cairo_fill(cairo);
}

void write(cairo_t* cairo, double x_mm, double y_mm, const char* text) {
  cairo_move_to(cairo, x_mm, y_mm);
  cairo_show_text(cairo, text);
}

// Ticks stand on the line every millimetre; their middles are the marks.
void paint_ruler(cairo_t* cairo, const PatternPage& page) {
  cairo_set_line_width(cairo, 0.15);
  for (int mm = 0; mm <= int(page.ruler_mm); ++mm) {
    const double height = mm % 10 == 0 ? 2.4 : (mm % 5 == 0 ? 1.7 : 1.0);
    cairo_move_to(cairo, page.ruler_x_mm + mm, page.ruler_y_mm);
    cairo_line_to(cairo, page.ruler_x_mm + mm, page.ruler_y_mm - height);
  }
  cairo_move_to(cairo, page.ruler_x_mm, page.ruler_y_mm);
  cairo_line_to(cairo, page.ruler_x_mm + page.ruler_mm, page.ruler_y_mm);
  cairo_stroke(cairo);
  for (int mm = 0; mm <= int(page.ruler_mm); mm += 10) {
    const std::string text = std::to_string(mm) + (mm == int(page.ruler_mm) ? " mm" : "");
    cairo_text_extents_t size;
    cairo_text_extents(cairo, std::to_string(mm).c_str(), &size);
    write(cairo, page.ruler_x_mm + mm - size.x_advance / 2, page.ruler_y_mm + kTextMm, text.c_str());
  }
}

// As large as fits beside the ruler.
void paint_words(cairo_t* cairo, const PatternPage& page) {
  double widest = 0;
  for (const std::string& line : page.text) {
    cairo_text_extents_t size;
    cairo_text_extents(cairo, line.c_str(), &size);
    widest = std::max(widest, size.x_advance);
  }
  cairo_set_font_size(cairo, kTextMm * std::min(1.0, page.text_width_mm / std::max(widest, 1e-9)));
  double y = page.ruler_y_mm - 0.3;
  for (const std::string& line : page.text) {
    write(cairo, page.text_x_mm, y, line.c_str());
    y += kLineMm;
  }
}

}  // namespace

Result<PageFormat> page_format(std::string_view file_name) {
  const std::size_t dot = file_name.rfind('.');
  std::string ending(dot == std::string_view::npos ? "" : file_name.substr(dot + 1));
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (ending == "pdf") return PageFormat::Pdf;
  if (ending == "svg") return PageFormat::Svg;
  return invalid("the page is a PDF or an SVG: give a name that ends in .pdf or .svg").at(file_name);
}

Result<PatternPage> lay_out_pattern(const pipeline::BoardPattern& pattern) {
  RELIEVO_TRY(pattern.check());
  const double board_width = (pattern.columns + 1) * pattern.square_mm;
  const double board_height = (pattern.rows + 1) * pattern.square_mm;
  const double margin = std::max(pattern.square_mm, kMinMarginMm);
  const double width = board_width + 2 * margin;
  const double height = board_height + 2 * margin + kFooterMm;
  for (const Paper& paper : kPapers)
    for (const bool upright : {pattern.rows > pattern.columns, pattern.rows <= pattern.columns}) {
      PatternPage page;
      page.paper = paper.name;
      page.width_mm = upright ? paper.short_mm : paper.long_mm;
      page.height_mm = upright ? paper.long_mm : paper.short_mm;
      if (width > page.width_mm || height > page.height_mm) continue;
      page.board_x_mm = (page.width_mm - board_width) / 2;
      page.board_y_mm = margin + (page.height_mm - height) / 2;
      page.ruler_x_mm = 2 * kUnprintableMm;
      page.ruler_y_mm = page.height_mm - kUnprintableMm - 2.4;
      page.ruler_mm = kRulerMm;
      page.text_x_mm = page.ruler_x_mm + kRulerMm + kGapMm;
      page.text_width_mm = page.width_mm - page.text_x_mm - kUnprintableMm;
      page.text = words_of(pattern);
      return page;
    }
  return invalid("this board with its margin is larger than A0 paper; choose fewer or smaller squares")
      .at(number(board_width) + " x " + number(board_height) + " mm");
}

Result<std::vector<std::byte>> draw_page(const PatternPage& page, const pipeline::BoardPattern& pattern,
                                         PageFormat format) {
  RELIEVO_TRY_ASSIGN(const auto black, pipeline::draw_board(pattern));
  std::vector<std::byte> out;
  const Surface surface = make_surface(page, format, out);
  const Cairo cairo(cairo_create(surface.get()));
  cairo_scale(cairo.get(), kPointsPerMm, kPointsPerMm);
  cairo_set_source_rgb(cairo.get(), 1, 1, 1);
  cairo_paint(cairo.get());
  cairo_set_source_rgb(cairo.get(), 0, 0, 0);
  paint_board(cairo.get(), page, black);
  cairo_select_font_face(cairo.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo.get(), kTextMm);
  paint_ruler(cairo.get(), page);
  paint_words(cairo.get(), page);
  cairo_show_page(cairo.get());
  cairo_surface_finish(surface.get());
  if (cairo_status(cairo.get()) != CAIRO_STATUS_SUCCESS ||
      cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    return Error{Errc::LibraryFailed, "cairo could not draw the page"};
  return out;
}

}  // namespace relievo::firmware
