// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results beside each other, a column each: those put aside, and the present one behind them. A picture of
// the stage, its surface, which one finger turns in all columns, or how far that lies from the present one;
// touched, it fills the page; the algorithms that were changed in any;
// times, counts, and what each result says of itself.
#include <algorithm>
#include <string>

#include "ui/screens/service/fault_words.h"
#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

// The colours of a difference, from farther to nearer.
void difference_scale(TechnicianFrame& f) {
  if (f.view.scale.empty()) return;
  const auto end = double(f.view.full_colour_mm);
  const std::string_view farther = f.page.number(-end, 2, "mm"), nearer = f.page.number(end, 2, "mm");
  Node row = f.page.box(Flow::Row, space::kXs, 0, 5);
  row.id = "difference scale";
  row.box.left_to_right = true;
  row.box.align = Align::Centre;
  f.page.tree.open(row);
  f.page.tree.leaf(f.page.text(farther, 18, Weight::Regular, f.page.palette.ink));
  Node strip = f.page.grown(f.page.box(Flow::Column));
  strip.box.height = f.page.px(20);
  f.page.tree.leaf(strip);
  const float share = 1 / float(f.view.scale.size());
  for (std::size_t i = 0; i < f.view.scale.size(); ++i) {
    const auto& c = f.view.scale[i];
    f.page.tree.mark({{float(i) * share, 0, share, 1}, {c[0], c[1], c[2], 255}, 0, false});
  }
  f.page.tree.leaf(f.page.text(nearer, 18, Weight::Regular, f.page.palette.ink));
  f.page.tree.close();
  f.page.tree.leaf(
      f.page.text(f.page.filled(f.tr("Red is nearer, blue farther; white agrees. Full colour: {}."), nearer),
                  18, Weight::Regular, f.page.palette.ink_soft));
}

void difference_button(TechnicianFrame& f, float grow) {
  f.choice("show difference", f.tr("Difference"), f.view.differences,
           technician_action(TechnicianAct::ShowDifference), grow);
}

// One result by itself, to be turned and measured on.
void alone(TechnicianFrame& f, std::size_t i) {
  f.face(1, nullptr, 0);
  const bool coloured = f.view.differences && f.view.compared[i].difference.known;
  if (coloured) difference_scale(f);
  const float grow = f.open_buttons();
  if (i < f.view.put_aside) difference_button(f, grow);
  f.measure_button(grow);
  f.page.tree.close();
}

class Columns {
 public:
  explicit Columns(TechnicianFrame& frame)
      : f(frame), page(frame.page), count(std::min(frame.view.put_aside + 1, kCompared)) {}

  void pictures() {
    const auto in_box =
        page.tree.inside(page.grown(page.box(Flow::Row, space::kXs), labels_above() ? 0.65F : 1.0F));
    if (!labels_above()) beside_pictures();
    for (std::size_t i = 0; i < count; ++i) {
      Node column = page.grown(page.box(Flow::Column, 6));
      const auto in_column = page.tree.inside(column);
      page.tree.leaf(page.text(is_now(i) ? std::string_view(f.tr("Now")) : name_of(i), type::kSmall,
                               Weight::Bold, page.palette.ink, TextAlign::Centre));
      picture(i);
    }
  }

  void table() {
    page.begin_panel("figures");
    row("name", f.tr("Pictures"), [this](const TechnicianResult& r) {
      std::string name(r.name.empty() ? "–" : r.name);
      std::ranges::replace(name, '_', ' ');  // between date and time a line may end
      return f.left_to_right(name);
    });
    differences();
    algorithms();
    failures();
    page.rule();
    times_and_counts();
    measures();
    page.tree.close();
  }

 private:
  TechnicianFrame& f;
  StaffFrame& page;
  const std::size_t count;

  bool is_now(std::size_t i) const { return i == f.view.put_aside; }
  bool labels_above() const { return page.portrait || page.text_share > 1.2F; }
  const TechnicianResult& result(std::size_t i) const { return f.view.compared[i].result; }
  std::string_view name_of(std::size_t i) const { return page.number(double(i + 1)); }

  // What stands over the labels.
  void beside_pictures() {
    Node words = page.grown(page.box(Flow::Column, space::kS), label_share());
    const auto in_words = page.tree.inside(words);
    page.tree.leaf(page.text(title_of(f.tr, f.view.stage), type::kSmall, Weight::Bold, page.palette.ink));
    page.tree.leaf(page.text(how(), 18, Weight::Regular, page.palette.ink_soft));
  }
  const char* how() const {
    if (count == kCompared) return f.tr("Four stand side by side: drop one to put another beside them.");
    return f.tr(
        "Put this result aside, then calculate again or load another one: up to four stand side by side.");
  }
  bool shows_difference(std::size_t i) const {
    return f.view.differences && f.view.compared[i].difference.known;
  }
  float label_share() const { return count > 2 ? 0.9F : 0.7F; }

  void picture(std::size_t i) {
    const TechnicianCompared& one = f.view.compared[i];
    const std::string_view spoken = is_now(i) ? std::string_view(f.tr("Now")) : name_of(i);
    const auto slot = static_cast<PictureSlot>(std::size_t(PictureSlot::TechnicianLeft) + i);
    const std::string_view id = is_now(i) ? "present picture" : f.id("kept picture", i);
    const Action alone = one.model != nullptr ? Action(ActionKind::StaffMode, std::int32_t(i + 1)) : Action();
    if (shows_difference(i)) {
      f.open_picture(id, page.filled("{}: {}", {f.tr("Difference"), spoken}), one.difference.map, slot,
                     alone);
    } else if (one.model != nullptr && is_turned(f.view.stage)) {
      Node card = page.grown(page.box(Flow::Stack));
      card.box.fill = page.palette.stage;
      card.box.radius = page.px(12);
      page.tree.open(card);
      Node face = page.box(Flow::Column);
      tell(face, Role::Picture, id, f.tr("The model: turn it with a finger"), {ActionKind::TurnFace, 0});
      face.by_key = alone;
      face.mark = Mark::Face;
      face.face = std::uint8_t(i);
      face.box.radius = page.px(12);
      page.tree.leaf(face);
    } else {
      f.open_picture(id, spoken, one.picture, slot, alone);
    }
    if (!is_now(i)) drop_button(i);
    page.tree.close();
  }
  void drop_button(std::size_t i) {
    const auto in_box_2 = page.tree.inside(page.box(Flow::Column));
    Node end = page.box(Flow::Row);
    end.box.justify = Justify::End;
    const auto in_end = page.tree.inside(end);
    Node cross = page.sized(page.box(Flow::Row), size::kStaffTarget, size::kStaffTarget);
    tell(cross, Role::Button, f.id("drop", i), f.tr("Drop this result"), technician_action(DropResult{i}));
    centre(cross);
    cross.box.radius = page.px(12);
    cross.box.fill = page.palette.quiet;
    const auto in_cross = page.tree.inside(cross);
    page.sign(icon::kClose, 26 / page.text_share, page.palette.link);
  }

  // A line of the table: a cell for each result.
  template <typename Cell>
  void row(std::string_view id, std::string_view label, const Cell& cell, bool bad = false,
           bool english = false) {
    const bool above = labels_above();
    Node line = page.box(above ? Flow::Column : Flow::Row, above ? 2 : space::kXs, 0, 5);
    line.id = id;
    line.box.min_height = page.px(38);
    if (!above) line.box.align = Align::Centre;
    page.tree.open(line);
    if (!label.empty() || !above) {
      const auto in_box_3 = page.tree.inside(above ? page.box(Flow::Column)
                                                   : page.grown(page.box(Flow::Column), label_share()));
      if (!label.empty()) page.tree.leaf(page.text(label, 18, Weight::Medium, page.palette.ink));
    }
    if (above) page.tree.open(page.box(Flow::Row, space::kXs));
    for (std::size_t i = 0; i < count; ++i) {
      const auto in_box_4 = page.tree.inside(page.grown(page.box(Flow::Column)));
      Node said =
          page.text(cell(result(i)), count == kCompared ? 18 * std::min(1.0F, 1.25F / page.text_share) : 18,
                    Weight::Regular, bad ? page.palette.bad : page.palette.ink, TextAlign::Centre);
      said.style.tabular = true;
      if (english) said.style.language = "en";
      if (!said.text.empty()) page.tree.leaf(said);
    }
    if (above) page.tree.close();
    page.tree.close();
  }
  template <typename Value, typename Known>
  void figure(std::string_view id, std::string_view label, int decimals, const char* unit, const Value& value,
              const Known& known) {
    row(id, label, [&](const TechnicianResult& r) {
      return r.there && known(r) ? page.number(double(value(r)), decimals, unit) : std::string_view("–");
    });
  }

  // Against the present one, and what the colours say.
  void differences() {
    if (!f.view.differences) return;
    const auto each = [&](std::string_view id, const char* label, auto value) {
      row(id, label, [&](const TechnicianResult& r) {
        const TechnicianDifference& d = f.view.compared[std::size_t(number_of(r))].difference;
        return d.known ? page.number(double(value(d)), 2, "mm") : std::string_view("–");
      });
    };
    each("difference median", f.tr("Median difference"),
         [](const TechnicianDifference& d) { return d.median_mm; });
    each("difference most", f.tr("95 % differ by less than"),
         [](const TechnicianDifference& d) { return d.most_mm; });
    difference_scale(f);
  }
  std::ptrdiff_t number_of(const TechnicianResult& r) const {
    const auto found = std::ranges::find_if(f.view.compared,
                                            [&](const TechnicianCompared& one) { return &one.result == &r; });
    return found - f.view.compared.begin();
  }

  // The value of a changed option; empty: as delivered.
  static std::string_view value_of(std::string_view lines, std::string_view key) {
    while (!lines.empty()) {
      const std::size_t end = std::min(lines.find('\n'), lines.size());
      const std::string_view line = lines.substr(0, end);
      lines.remove_prefix(std::min(end + 1, lines.size()));
      if (line.starts_with(key) && line.substr(key.size()).starts_with(" = "))
        return line.substr(key.size() + 3);
    }
    return {};
  }
  void option(std::size_t number, std::string_view key) {
    const char* delivered = f.tr("Default");
    row(f.id("option", number), f.left_to_right(f.breakable(key)), [&](const TechnicianResult& r) {
      const std::string_view value = value_of(r.algorithms, key);
      return value.empty() ? std::string_view(delivered) : f.left_to_right(f.breakable(value));
    });
  }
  void algorithms() {
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::string_view rest = result(i).algorithms; !rest.empty();) {
        const std::string_view key = rest.substr(0, rest.find(" = "));
        const bool seen = std::any_of(
            f.view.compared.begin(), f.view.compared.begin() + std::ptrdiff_t(i),
            [key](const TechnicianCompared& one) { return !value_of(one.result.algorithms, key).empty(); });
        if (!seen) option(number++, key);
        rest.remove_prefix(std::min(std::min(rest.find('\n'), rest.size() - 1) + 1, rest.size()));
      }
    }
    if (number == 0) {
      row("option 0", f.tr("Algorithms"),
          [this](const TechnicianResult&) { return std::string_view(f.tr("Default")); });
    }
  }
  void failures() {
    const auto failed = [](const TechnicianCompared& one) { return !one.result.failure.empty(); };
    if (std::ranges::none_of(f.view.compared, failed)) return;
    row(
        "failed", "",
        [this](const TechnicianResult& r) {
          if (r.failure.empty()) return std::string_view();
          return std::string_view(
              page.filled("{} – {}", {work_of(f.tr, r.failed_at), words_of(f.tr, r.failure.code)}));
        },
        true);
    row(
        "failed detail", "",
        [this](const TechnicianResult& r) {
          return r.failure.empty() ? std::string_view() : f.left_to_right(f.breakable(r.failure.detail));
        },
        false, true);
  }
  void times_and_counts() {
    const auto always = [](const TechnicianResult&) { return true; };
    for (std::size_t i = 0; i < kStages; ++i)
      figure(
          f.id("seconds", i), work_of(f.tr, i), 2, "s",
          [i](const TechnicianResult& r) { return r.seconds[i]; }, always);
    figure(
        "all matches", f.tr("Matches"), 0, "", [](const TechnicianResult& r) { return r.matches; }, always);
    const char* const made[] = {f.tr("Accepted matches"), f.tr("Points"), f.tr("Triangles"), f.tr("Texels"),
                                f.tr("Landmarks")};
    for (std::size_t i = 0; i < kStages; ++i)
      figure(
          f.id("count", i), made[i], 0, "", [i](const TechnicianResult& r) { return r.made[i]; }, always);
    figure(
        "memory", f.tr("Memory"), 0, "MiB", [](const TechnicianResult& r) { return r.arena_peak_mib; },
        always);
  }
  void measures() {
    const auto model = [](const TechnicianResult& r) { return r.coverage > 0; };
    figure(
        "sigma", f.tr("Median uncertainty"), 3, "mm",
        [](const TechnicianResult& r) { return r.median_sigma_mm; }, model);
    figure(
        "coverage", f.tr("Face covered"), 1, "%", [](const TechnicianResult& r) { return 100 * r.coverage; },
        model);
    const auto predicted = [](const TechnicianResult& r) { return r.photo_windows > 0; };
    figure(
        "photo", f.tr("Likeness of the predicted right view"), 3, "",
        [](const TechnicianResult& r) { return r.photo_correlation; }, predicted);
    figure(
        "windows", f.tr("Compared windows"), 0, "", [](const TechnicianResult& r) { return r.photo_windows; },
        predicted);
    figure(
        "rows", f.tr("Disagreement of the rows"), 3, "px",
        [](const TechnicianResult& r) { return r.epipolar_px; },
        [](const TechnicianResult& r) { return r.epipolar_px >= 0; });
  }
};

void buttons(TechnicianFrame& f, bool there) {
  const bool busy = f.view.phase == TechnicianPhase::Capturing || f.view.phase == TechnicianPhase::Running;
  if (busy) return;
  const float grow = f.open_buttons();
  const bool room = f.view.put_aside + 1 < kCompared;
  if (there) {
    const auto next = static_cast<TechnicianStage>((std::size_t(f.view.stage) + 1) % kTechnicianStages);
    f.page.small_button("next stage", title_of(f.tr, f.view.stage), icon::kAgain, ButtonLook::Quiet,
                        technician_action(ShowStage{next}), grow);
    if (f.view.put_aside > 0) {
      difference_button(f, grow);
      if (f.page.portrait) f.page.tree.close(), f.open_buttons();  // two and two
    }
    if (room)
      f.page.small_button("keep", f.tr("Put this result aside"), nullptr, ButtonLook::Quiet,
                          technician_action(TechnicianAct::KeepResult), grow);
  }
  if (room && !f.view.recording.running)
    f.page.small_button("list saved", f.tr("Load from the stick"), icon::kDisk, ButtonLook::Quiet,
                        technician_action(TechnicianAct::ListSaved), grow);
  f.page.tree.close();
}

}  // namespace

void technician_compare_page(StaffFrame& page) {
  if (page.staff.technician == nullptr) return;
  TechnicianFrame f(page);
  if (f.view.saved.listed) return f.saved_list(true);
  const bool there = f.capture_state();
  const auto one = std::size_t(std::max(0, page.service.mode));
  if (there && one > 0 && one <= f.view.put_aside + 1 && f.view.compared[one - 1].model != nullptr)
    return alone(f, one - 1);
  if (there) {
    Columns columns(f);
    columns.pictures();
    columns.table();
  }
  f.stick_state();
  buttons(f, there);
  f.capture_buttons(true);
}

}  // namespace relievo::ui
