// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers behind the pictures, a page at a time.

#include "ui/screens/service/bench/bench_frame.h"

namespace relievo::ui {
namespace {

constexpr std::int32_t kFarPages = 100;

const char* name_of_table(const Words& tr, BenchTable table) {
  switch (table) {
    case BenchTable::Matches: return tr("Matches");
    case BenchTable::Points: return tr("Points");
    case BenchTable::Model: return tr("Model");
    case BenchTable::Calibration:
    case BenchTable::Count: break;
  }
  return tr("Calibration");
}

struct Wide {   // a column of words, and how much wider than one of numbers
  std::size_t column = ~std::size_t{0};
  float share = 1;
};

// A number, several of them, or the rule that judged.
std::string_view said(BenchFrame& b, std::string_view text) {
  const std::string_view numbers = b.page.with_numbers(text);
  return numbers == text ? b.rule_name(text) : numbers;
}

// Numbers stay left to right, as in any table of measurements.
void cells(BenchFrame& b, std::span<const std::string_view> texts, bool heading, const Wide& wide) {
  Node row = b.page.box(Flow::Row, 6, 4, 0);
  row.box.left_to_right = true;
  row.box.min_height = b.page.px(36);
  row.box.across = Across::Centre;
  b.page.tree.open(row);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    b.page.tree.open(b.page.grown(b.page.box(Flow::Column), i == wide.column ? wide.share : 1.0F));
    if (!texts[i].empty()) {
      Node cell = b.page.text(b.left_to_right(heading ? texts[i] : said(b, texts[i])), 18, heading ? Weight::Bold : Weight::Regular, heading ? b.page.palette.ink : b.page.palette.ink_soft, TextAlign::Start);
      // Columns are as wide as they are: letters of a table grow less.
      cell.style.tabular = true;
      cell.style.size_px = b.page.px((b.page.portrait ? 15.0F : 18.0F) * (1 + (b.page.text_share - 1) * 0.3F));
      b.page.tree.leaf(cell);
    }
    b.page.tree.close();
  }
  b.page.tree.close();
}

void pager(BenchFrame& b) {
  const BenchRows& rows = b.view.rows;
  if (rows.pages < 2) return;
  Node row = b.page.box(Flow::Row, space::kS);
  row.box.across = Across::Centre;
  row.box.along = Along::Centre;
  row.box.left_to_right = true;
  b.page.tree.open(row);
  const auto turn = [&](std::string_view id, const char* spoken, const char* label, std::int32_t pages) {
    Node node = b.page.sized(b.page.box(Flow::Row), 96, size::kStaffTarget);
    node.id = id;
    node.name = spoken;
    node.role = Role::Button;
    node.action = bench(BenchAct::TurnPage, pages);
    node.box.along = Along::Centre;
    node.box.across = Across::Centre;
    node.box.radius = b.page.px(18);
    node.box.fill = b.page.palette.quiet;
    node.box.border = b.page.palette.quiet_border;
    node.box.border_px = b.page.px(2);
    b.page.tree.open(node);
    Node sign = b.page.text(b.left_to_right(label), type::kSmall / b.page.text_share, Weight::Bold, b.page.palette.link, TextAlign::Centre);
    b.page.tree.leaf(sign);
    b.page.tree.close();
  };
  turn("far back", b.tr("A hundred pages back"), "− 100", -kFarPages);
  turn("page back", b.tr("One page back"), "−", -1);
  const auto number = [&](std::size_t value) { return b.page.number(static_cast<double>(value)); };
  Node where = b.page.text(b.joined(number(rows.page + 1), "\u00a0/\u00a0", number(rows.pages)), type::kSmall, Weight::Medium, b.page.palette.ink, TextAlign::Centre);
  where.id = "page number";
  b.page.tree.leaf(where);
  turn("page on", b.tr("One page on"), "+", 1);
  turn("far on", b.tr("A hundred pages on"), "+ 100", kFarPages);
  b.page.tree.close();
}

}  // namespace

void bench_tables_page(StaffFrame& page) {
  if (page.staff.bench == nullptr) return;
  BenchFrame b(page);
  const BenchRows& rows = b.view.rows;
  const std::size_t across = page.portrait || page.text_share > 1.3F ? 2 : kBenchTables;
  for (std::size_t first = 0; first < kBenchTables; first += across) {
    page.tree.open(page.box(Flow::Row, space::kXs));
    for (std::size_t i = first; i < first + across; ++i) {
      const auto table = static_cast<BenchTable>(i);
      b.choice(b.id("table", i), name_of_table(b.tr, table), rows.table == table, bench(BenchAct::ShowTable, static_cast<std::int32_t>(i)));
    }
    page.tree.close();
  }
  if (rows.cells.empty() && (rows.table != BenchTable::Calibration || !b.view.calibrated)) {
    if (b.capture_state()) {
      page.nothing("no rows", icon::kShape, b.tr("There is nothing: a stage before it gave up."));
    }
    return b.capture_buttons(false);
  }
  const std::size_t columns = rows.heads.size(), places = rows.cells.size();
  if (columns == 0) return;
  const Wide wide = rows.table == BenchTable::Calibration ? Wide{3, 3} : rows.table == BenchTable::Matches ? Wide{columns - 1, 1.8F} : Wide{};
  page.begin_list("table");
  cells(b, rows.heads, true, wide);
  for (std::size_t at = 0; at + columns <= places; at += columns) cells(b, rows.cells.subspan(at, columns), false, wide);
  page.tree.close();
  pager(b);
}

}  // namespace relievo::ui
