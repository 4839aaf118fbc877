// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers behind the pictures, a page at a time.
#include <array>

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {

// The test capture in three dimensions: points, edges, surface, texture and light, each switched on and off;
// the distance of two points on it.
namespace {

void switches(TechnicianFrame& f) {
  const FaceLook& look = f.visit.look;
  f.choice("points", f.tr("Points"), look.points, ActionKind::LookPoints, 0);
  f.choice("edges", f.tr("Edges"), look.edges, ActionKind::LookEdges, 0);
  f.choice("fill", f.tr("Surface"), look.fill, ActionKind::LookFill, 0);
  f.choice("texture", f.tr("Texture"), look.textured, ActionKind::ShowShape, 0);
  f.choice("lit", f.tr("Light"), look.lit, ActionKind::LookLight, 0);
}

void hands(TechnicianFrame& f) {
  // As on the page where a visitor looks at it.
  const auto in_row = f.tree.inside(
      left_first(justified(f.box(Flow::Row, space::kXs, space::kXs, space::kXs), Justify::Centre)));
  f.turning_tools();
}

constexpr float kGap = 6;  // between columns

// In the order of TechnicianTable.
constexpr std::array kTableNames{mark_tr("Matches"), mark_tr("Points"), mark_tr("Model"), mark_tr("Poses"),
                                 mark_tr("Calibration")};
static_assert(kTableNames.size() == std::size_t(TechnicianTable::Count));

struct Wide {  // a column of words, and how much wider than one of numbers
  std::size_t column = ~std::size_t{0};
  float share = 1;
  float number = 4.95F;  // sizes of its letters that a column of numbers is wide: "−108.114"
};

// A number, several of them, or the rule that judged.
std::string_view said(TechnicianFrame& f, std::string_view text) {
  const std::string_view numbers = f.with_numbers(text);
  return numbers == text ? f.rule_name(text) : numbers;
}

// How a record of the table is divided: where its columns have no room abreast, it goes on in the line below.
struct Shape {
  std::size_t columns = 0, abreast = 0;
  Wide wide;
};

float letters_dp(const StaffFrame& f) { return f.portrait ? 15.0F : 18.0F; }

Shape shape_of(const StaffFrame& f, std::size_t columns, const Wide& wide) {
  constexpr float kMargins = 112;  // of page, card and row
  Shape shape{columns, columns, wide};
  const float all = float(columns) - 1 + (wide.column < columns ? wide.share : 1);
  const float gaps = kGap * (float(columns) - 1);
  if (all * wide.number * letters_dp(f) * f.text_share + gaps > f.width_dp - kMargins)
    shape.abreast = (columns + 1) / 2;
  return shape;
}

void cell(TechnicianFrame& f, std::string_view words, bool heading) {
  if (words.empty()) return;
  Node node = f.text(f.left_to_right(heading ? words : said(f, words)), letters_dp(f),
                     heading ? Weight::Bold : Weight::Regular, heading ? f.palette.ink : f.palette.ink_soft,
                     TextAlign::Start);
  node.style.tabular = true;
  node.style.size_px = f.px(letters_dp(f) * f.text_share);  // figures are as wide in every language
  f.tree.leaf(node);
}

// Numbers stay left to right, as in any table of measurements.
void record(TechnicianFrame& f, std::span<const std::string_view> texts, bool heading, const Shape& shape) {
  const bool divided = shape.abreast < shape.columns;
  for (std::size_t first = 0; first < shape.columns; first += shape.abreast) {
    Node row = left_first(aligned(f.box(Flow::Row, kGap, 4, 0), Align::Centre));
    row.box.min_height = f.px(36);
    const auto in_row = f.tree.inside(row);
    for (std::size_t i = first; i < first + shape.abreast; ++i) {
      const auto in_box = f.tree.inside(
          f.grown(f.box(Flow::Column), !divided && i == shape.wide.column ? shape.wide.share : 1.0F));
      if (i < shape.columns) cell(f, texts[i], heading);
    }
  }
  if (divided) f.rule();
}

// Of matches: all, the accepted ones, and those that each rule took first.
using FilterNames = std::array<std::string_view, 2 + kTechnicianRules>;
ListFilters filters_of(TechnicianFrame& f, FilterNames& names) {
  if (f.seen.rows.table != TechnicianTable::Matches) return {};
  names = {f.tr("All"), f.tr("Accepted matches")};
  const TechnicianResult& result = f.seen.result;
  for (std::size_t i = 0; i < result.rule_count; ++i) names[2 + i] = f.rule_name(result.rules[i].name);
  return {names.data(), 2 + result.rule_count};
}

}  // namespace

void technician_model_page(TechnicianFrame& f) {
  if (f.capture_state() && f.seen.model == nullptr) {
    f.failure();
    f.nothing("no model", icon::kShape, f.tr("There is nothing: a stage before it gave up."));
  } else if (f.seen.model != nullptr) {
    const auto in_box = f.tree.inside(f.grown(f.abreast_box(space::kM)));
    f.face(3, hands, size::kTarget + 2 * space::kXs);
    Node side = justified(f.box(Flow::Column, space::kS), Justify::Centre);
    if (!f.portrait) side.box.width = f.px(f.large_words() ? 330 : 260);
    const auto in_side = f.tree.inside(side);
    switches(f);
    f.measure_button(0);
  }
  f.capture_buttons(false);
}

void technician_tables_page(TechnicianFrame& f) {
  const TechnicianRows& rows = f.seen.rows;
  FilterNames names;
  const ListFilters filters = filters_of(f, names);
  if (list_choice(f, rows.place, filters)) return;
  const std::size_t across = f.little_room() ? 2 : kTechnicianTables;
  f.in_rows(kTechnicianTables, across, space::kXs, [&](std::size_t i) {
    const auto table = static_cast<TechnicianTable>(i);
    f.choice(f.id("table", i), one_of(f.tr, kTableNames, table), rows.table == table, ShowTable{table});
  });
  if (rows.cells.empty() && (rows.table != TechnicianTable::Calibration || !f.seen.calibrated)) {
    if (f.capture_state()) {
      if (rows.place.filter > 0) list_pager(f, rows.place, filters);
      f.nothing("no rows", icon::kShape, f.tr("There is nothing: a stage before it gave up."));
    }
    return f.capture_buttons(false);
  }
  const std::size_t columns = rows.heads.size(), places = rows.cells.size();
  if (columns == 0) return;
  const Wide wide = rows.table == TechnicianTable::Calibration
                        ? Wide{3, f.portrait && f.large_words() ? 2.0F : 3.0F}
                    : rows.table == TechnicianTable::Matches ? Wide{columns - 1, 1.8F, 4.4F}
                                                             : Wide{};
  f.begin_list("table");
  const Shape shape =
      rows.table == TechnicianTable::Calibration ? Shape{columns, columns, wide} : shape_of(f, columns, wide);
  record(f, rows.heads, true, shape);
  for (std::size_t at = 0; at + columns <= places; at += columns)
    record(f, rows.cells.subspan(at, columns), false, shape);
  f.tree.close();
  list_pager(f, rows.place, filters);
}

}  // namespace relievo::ui
