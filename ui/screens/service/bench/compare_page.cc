// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two sets of algorithms on the same test capture, side by side: pictures of a stage, times, counts, and what
// each result says of itself.
#include <algorithm>

#include "ui/screens/service/bench/bench_frame.h"

namespace relievo::ui {
namespace {

void pictures(BenchFrame& b) {
  Node row = b.page.grown(b.page.box(Flow::Row, space::kS), b.picture_share(1.1F));
  b.page.tree.open(row);
  const char* const titles[] = {b.tr("Put aside"), b.tr("Now")};
  for (std::size_t i = 0; i < 2; ++i) {
    Node column = b.page.grown(b.page.box(Flow::Column, 6));
    column.box.along = Along::Centre;
    b.page.tree.open(column);
    b.page.tree.leaf(
        b.page.text(titles[i], type::kSmall, Weight::Bold, b.page.palette.ink, TextAlign::Centre));
    b.open_picture(i == 0 ? "kept picture" : "present picture", titles[i], b.view.compared[i],
                   i == 0 ? PictureSlot::BenchLeft : PictureSlot::BenchRight);
    b.close_picture();
    b.page.tree.close();
  }
  b.page.tree.close();
}

struct Row {
  std::string_view id;
  const char* label;
  std::string_view kept, now;
};

void figures(BenchFrame& b, const Row& row, bool heading = false) {
  Node line = b.page.box(Flow::Row, space::kXs, 0, 5);
  line.id = row.id;
  line.box.min_height = b.page.px(38);
  line.box.across = Across::Centre;
  b.page.tree.open(line);
  const auto cell = [&](std::string_view text, float share, Weight weight, TextAlign align) {
    b.page.tree.open(b.page.grown(b.page.box(Flow::Column), share));
    Node said = b.page.text(text, 18, weight, b.page.palette.ink, align);
    said.style.tabular = true;
    if (!text.empty()) b.page.tree.leaf(said);
    b.page.tree.close();
  };
  cell(row.label, 1.5F, Weight::Medium, TextAlign::Start);
  cell(row.kept, 1, heading ? Weight::Bold : Weight::Regular, TextAlign::End);
  cell(row.now, 1, heading ? Weight::Bold : Weight::Regular, TextAlign::End);
  b.page.tree.close();
}

// What a result was made with, over the width of both columns of figures: a line for each option that was
// changed.
void algorithms(BenchFrame& b, std::string_view id, const char* title, const BenchResult& r) {
  Node line = b.page.box(Flow::Row, space::kXs, 0, 5);
  line.id = id;
  b.page.tree.open(line);
  const auto said = [&](std::string_view text, Weight weight) {
    b.page.tree.leaf(b.page.text(text, 18, weight, b.page.palette.ink));
  };
  b.page.tree.open(b.page.grown(b.page.box(Flow::Column)));
  said(title, Weight::Medium);
  b.page.tree.close();
  b.page.tree.open(b.page.grown(b.page.box(Flow::Column), 2.5F));
  if (!r.there) said("–", Weight::Regular);
  else if (r.algorithms.empty()) said(b.tr("as delivered"), Weight::Regular);
  for (std::string_view rest = r.there ? r.algorithms : std::string_view(); !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    said(b.left_to_right(b.breakable(rest.substr(0, end))), Weight::Regular);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  b.page.tree.close();
  b.page.tree.close();
}

void table(BenchFrame& b) {
  const BenchResult &k = b.view.kept, &n = b.view.result;
  const auto figure = [&](const BenchResult& r, double value, int decimals, const char* unit_name,
                          bool known = true) {
    return r.there && known ? b.page.number(value, decimals, unit_name) : std::string_view("–");
  };
  b.page.begin_panel("figures");
  b.page.section(b.tr("Algorithms"));
  algorithms(b, "kept set", b.tr("Put aside"), k);
  algorithms(b, "present set", b.tr("Now"), n);
  b.page.rule();
  figures(b, {"head", "", b.tr("Put aside"), b.tr("Now")}, true);
  for (std::size_t i = 0; i < k.seconds.size(); ++i)
    figures(b, {b.id("seconds", i), work_of(b.tr, i), figure(k, static_cast<double>(k.seconds[i]), 2, "s"),
                figure(n, static_cast<double>(n.seconds[i]), 2, "s")});
  figures(b, {"all matches", b.tr("Matches"), figure(k, static_cast<double>(k.matches), 0, ""),
              figure(n, static_cast<double>(n.matches), 0, "")});
  const char* const made[] = {b.tr("Accepted matches"), b.tr("Points"), b.tr("Triangles"), b.tr("Texels")};
  for (std::size_t i = 0; i < k.made.size(); ++i)
    figures(b, {b.id("count", i), made[i], figure(k, static_cast<double>(k.made[i]), 0, ""),
                figure(n, static_cast<double>(n.made[i]), 0, "")});
  const auto two = [&](std::string_view id, const char* label, auto value, int decimals,
                       const char* unit_name, auto known) {
    figures(b, {id, label, figure(k, static_cast<double>(value(k)), decimals, unit_name, known(k)),
                figure(n, static_cast<double>(value(n)), decimals, unit_name, known(n))});
  };
  const auto model = [](const BenchResult& r) { return r.coverage > 0; };
  two(
      "sigma", b.tr("Median uncertainty"), [](const BenchResult& r) { return r.median_sigma_mm; }, 3, "mm",
      model);
  two(
      "coverage", b.tr("Face covered"), [](const BenchResult& r) { return 100 * r.coverage; }, 1, "%", model);
  const auto predicted = [](const BenchResult& r) { return r.photo_windows > 0; };
  two(
      "photo", b.tr("Likeness of the predicted right view"),
      [](const BenchResult& r) { return r.photo_correlation; }, 3, "", predicted);
  two(
      "windows", b.tr("Compared windows"), [](const BenchResult& r) { return r.photo_windows; }, 0, "",
      predicted);
  two(
      "rows", b.tr("Disagreement of the rows"), [](const BenchResult& r) { return r.epipolar_px; }, 3, "px",
      [](const BenchResult& r) { return r.epipolar_px >= 0; });
  two(
      "memory", b.tr("Memory"), [](const BenchResult& r) { return r.arena_peak_mib; }, 0, "MiB",
      [](const BenchResult&) { return true; });
  b.page.tree.close();
}

}  // namespace

void bench_compare_page(StaffFrame& page) {
  if (page.staff.bench == nullptr) return;
  BenchFrame b(page);
  if (b.capture_state()) {
    b.failure();
    if (!b.view.kept.there)
      page.body(
          "how",
          b.tr("Put this result aside, choose other algorithms, calculate again: then both stand here."));
    page.tree.open(page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
    pictures(b);
    page.tree.open(page.grown(page.box(Flow::Column)));
    table(b);
    page.tree.close();
    page.tree.close();
    const float grow = b.open_buttons();
    page.small_button("keep", b.tr("Put this result aside"), nullptr, ButtonLook::Quiet,
                      bench(BenchAct::KeepResult), grow);
    const auto next = static_cast<std::int32_t>((static_cast<std::size_t>(b.view.stage) + 1) % kBenchStages);
    page.small_button("next stage", title_of(b.tr, b.view.stage), icon::kAgain, ButtonLook::Quiet,
                      bench(BenchAct::ShowStage, next), grow);
    page.tree.close();
  }
  b.capture_buttons(true);
}

}  // namespace relievo::ui
