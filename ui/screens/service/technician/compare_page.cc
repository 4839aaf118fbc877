// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results beside each other, a column each: those put aside, and the present one behind them. A picture of
// the stage, its surface, which one finger turns in all columns, or how far that lies from the present one;
// touched, it fills the page; the algorithms that were changed in any;
// times, counts, and what each result says of itself.
#include <algorithm>
#include <string>

#include "ui/screens/service/staff_frame.h"
#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

// The colours of a difference, from farther to nearer.
void difference_scale(TechnicianFrame& f) {
  if (f.seen.scale.empty()) return;
  const auto end = double(f.seen.full_colour_mm);
  Node row = left_first(f.row_box(space::kXs, 0, 5));
  row.id = "difference scale";
  f.tree.open(row);
  f.write(f.number(-end, 2, "mm"), 18, Weight::Regular, f.palette.ink);
  Node strip = f.grown(f.box(Flow::Column));
  strip.box.height = f.px(20);
  f.tree.leaf(strip);
  const float share = 1 / float(f.seen.scale.size());
  for (std::size_t i = 0; i < f.seen.scale.size(); ++i) {
    const auto& c = f.seen.scale[i];
    f.tree.mark({{float(i) * share, 0, share, 1}, {c[0], c[1], c[2], 255}, 0, false});
  }
  f.write(f.number(end, 2, "mm"), 18, Weight::Regular, f.palette.ink);
  f.tree.close();
  f.scale_words(f.seen.full_colour_mm, 18);
}

void difference_button(TechnicianFrame& f, float grow) {
  f.choice("show difference", f.tr("Difference"), f.seen.differences, TechnicianAct::ShowDifference, grow);
}

// One result by itself, to be turned and measured on.
void alone(TechnicianFrame& f, std::size_t i, bool there) {
  f.face(1, nullptr, 0);
  if (f.seen.differences && f.seen.compared[i].difference.known) difference_scale(f);
  const float grow = f.open_buttons();
  if (there && i < f.seen.put_aside) difference_button(f, grow);
  f.measure_button(grow);
  f.tree.close();
}

using R = TechnicianResult;

// A figure of each result, where it is known.
struct FigureRow {
  const char *id, *label;
  int decimals;
  const char* unit;
  double (*value)(const R&);
  bool (*known)(const R&);
};
bool always(const R&) { return true; }
bool has_model(const R& r) { return r.coverage > 0; }
bool is_predicted(const R& r) { return r.photo_windows > 0; }
constexpr FigureRow kMeasures[] = {
    {"memory", mark_tr("Memory"), 0, "MiB", [](const R& r) { return double(r.arena_peak_mib); }, always},
    {"sigma", mark_tr("Median uncertainty"), 3, "mm", [](const R& r) { return double(r.median_sigma_mm); },
     has_model},
    {"coverage", mark_tr("Face covered"), 1, "%", [](const R& r) { return 100 * double(r.coverage); },
     has_model},
    {"photo", mark_tr("Likeness of the predicted right view"), 3, "",
     [](const R& r) { return double(r.photo_correlation); }, is_predicted},
    {"windows", mark_tr("Compared windows"), 0, "", [](const R& r) { return double(r.photo_windows); },
     is_predicted},
    {"rows", mark_tr("Disagreement of the rows"), 3, "px", [](const R& r) { return double(r.epipolar_px); },
     [](const R& r) { return r.epipolar_px >= 0; }},
};

class Columns {
 public:
  Columns(TechnicianFrame& frame, bool there)
      : f(frame), there_(there), count(std::min(frame.seen.put_aside + (there ? 1 : 0), kCompared)) {}

  void pictures() {
    const auto in_box = f.tree.inside(f.grown(f.box(Flow::Row, space::kXs), labels_above() ? 0.65F : 1.0F));
    if (!labels_above()) beside_pictures();
    for (std::size_t i = 0; i < count; ++i) {
      const auto in_column = f.tree.inside(f.grown(f.box(Flow::Column, 6)));
      f.write(name_of(i), type::kSmall, Weight::Bold, f.palette.ink, TextAlign::Centre);
      picture(i);
    }
  }

  void table() {
    f.begin_panel("figures");
    row("name", f.tr("Pictures"), [this](const TechnicianCompared& one) {
      std::string name(one.result.name.empty() ? "–" : one.result.name);
      std::ranges::replace(name, '_', ' ');  // between date and time a line may end
      return f.left_to_right(name);
    });
    differences();
    algorithms();
    failures();
    f.rule();
    figures();
    f.tree.close();
  }

 private:
  TechnicianFrame& f;
  const bool there_;  // the present one
  const std::size_t count;

  bool is_now(std::size_t i) const { return i == f.seen.put_aside; }
  bool labels_above() const { return f.little_room(); }
  const R& result(std::size_t i) const { return f.seen.compared[i].result; }
  std::string_view name_of(std::size_t i) const {
    return is_now(i) ? std::string_view(f.tr("Now")) : f.number(i + 1);
  }

  // What stands over the labels.
  void beside_pictures() {
    const auto in_words = f.tree.inside(f.grown(f.box(Flow::Column, space::kS), label_share()));
    f.write(title_of(f.tr, f.seen.stage), type::kSmall, Weight::Bold, f.palette.ink);
    if (there_) f.note(how(), 18);
  }
  const char* how() const {
    if (count == kCompared) return f.tr("Four stand side by side: drop one to put another beside them.");
    return f.tr(
        "Put this result aside, then calculate again or load another one: up to four stand side by side.");
  }
  bool shows_difference(std::size_t i) const {
    return f.seen.differences && f.seen.compared[i].difference.known;
  }
  float label_share() const { return count > 2 ? 0.9F : 0.7F; }

  void picture(std::size_t i) {
    const TechnicianCompared& one = f.seen.compared[i];
    const std::string_view spoken = name_of(i);
    const PictureSlot slot = f.slot_of(i);
    const std::string_view id = is_now(i) ? "present picture" : f.id("kept picture", i);
    const Action alone = one.model != nullptr ? Action(ActionKind::StaffMode, std::int32_t(i + 1)) : Action();
    if (shows_difference(i)) {
      f.open_picture(id, f.filled("{}: {}", {f.tr("Difference"), spoken}), one.difference.map, slot, alone);
    } else if (one.model != nullptr && is_turned(f.seen.stage)) {
      f.tree.open(f.stage(12));
      Node face = f.model(id, f.tr("The model: turn it with a finger"), 12);
      face.by_key = alone;
      face.face = std::uint8_t(i);
      f.tree.leaf(face);
    } else {
      f.open_picture(id, spoken, one.picture, slot, alone);
    }
    if (!is_now(i)) drop_button(i);
    f.tree.close();
  }
  void drop_button(std::size_t i) {
    const auto in_box_2 = f.tree.inside(f.box(Flow::Column));
    const auto in_end = f.tree.inside(justified(f.box(Flow::Row), Justify::End));
    Node cross = f.painted(centred(f.sized(f.box(Flow::Row), size::kStaffTarget, size::kStaffTarget)),
                           f.palette.quiet, 12);
    tell(cross, Role::Button, f.id("drop", i), f.tr("Drop this result"), DropResult{i});
    const auto in_cross = f.tree.inside(cross);
    f.sign(icon::kClose, 26 / f.text_share, f.palette.link);
  }

  // A line of the table: a cell for each result.
  template <typename Cell>
  void row(std::string_view id, std::string_view label, const Cell& cell, bool bad = false,
           bool english = false) {
    const bool above = labels_above();
    Node line = f.box(above ? Flow::Column : Flow::Row, above ? 2 : space::kXs, 0, 5);
    line.id = id;
    line.box.min_height = f.px(38);
    if (!above) line.box.align = Align::Centre;
    f.tree.open(line);
    if (!label.empty() || !above) {
      const auto in_box_3 =
          f.tree.inside(above ? f.box(Flow::Column) : f.grown(f.box(Flow::Column), label_share()));
      if (!label.empty()) f.write(label, 18, Weight::Medium, f.palette.ink);
    }
    if (above) f.tree.open(f.box(Flow::Row, space::kXs));
    for (std::size_t i = 0; i < count; ++i) {
      const auto in_box_4 = f.tree.inside(f.grown(f.box(Flow::Column)));
      Node said = f.text(cell(f.seen.compared[i]),
                         count == kCompared ? 18 * std::min(1.0F, 1.25F / f.text_share) : 18, Weight::Regular,
                         bad ? f.palette.bad : f.palette.ink, TextAlign::Centre);
      said.style.tabular = true;
      if (english) said.style.language = "en";
      if (!said.text.empty()) f.tree.leaf(said);
    }
    if (above) f.tree.close();
    f.tree.close();
  }
  template <typename Value>
  void figure(std::string_view id, std::string_view label, int decimals, const char* unit, const Value& value,
              bool (*known)(const R&) = always) {
    row(id, label, [&](const TechnicianCompared& one) {
      const R& r = one.result;
      return r.there && known(r) ? f.number(value(r), decimals, unit) : std::string_view("–");
    });
  }

  // Against the present one, and what the colours say.
  void differences() {
    if (!there_ || !f.seen.differences) return;
    const auto each = [&](std::string_view id, const char* label, float TechnicianDifference::*mm) {
      row(id, label, [&](const TechnicianCompared& one) {
        return one.difference.known ? f.number(one.difference.*mm, 2, "mm") : std::string_view("–");
      });
    };
    each("difference median", f.tr("Median difference"), &TechnicianDifference::median_mm);
    each("difference most", f.tr("95 % differ by less than"), &TechnicianDifference::most_mm);
    difference_scale(f);
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
    row(f.id("option", number), f.left_to_right(f.breakable(key)), [&](const TechnicianCompared& one) {
      const std::string_view value = value_of(one.result.algorithms, key);
      return value.empty() ? std::string_view(delivered) : f.left_to_right(f.breakable(value));
    });
  }
  void algorithms() {
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::string_view rest = result(i).algorithms; !rest.empty();) {
        const std::string_view key = rest.substr(0, rest.find(" = "));
        const bool seen = std::any_of(
            f.seen.compared.begin(), f.seen.compared.begin() + std::ptrdiff_t(i),
            [key](const TechnicianCompared& one) { return !value_of(one.result.algorithms, key).empty(); });
        if (!seen) option(number++, key);
        rest.remove_prefix(std::min(std::min(rest.find('\n'), rest.size() - 1) + 1, rest.size()));
      }
    }
    if (number == 0)
      row("option 0", f.tr("Algorithms"), [this](const auto&) { return std::string_view(f.tr("Default")); });
  }
  void failures() {
    const auto failed = [](const TechnicianCompared& one) { return !one.result.failure.empty(); };
    if (std::ranges::none_of(f.seen.compared, failed)) return;
    const auto said = [this](const TechnicianCompared& one) {
      const Fault& fault = one.result.failure;
      if (fault.empty()) return std::string_view();
      return f.filled("{} – {}", {work_of(f.tr, one.result.failed_at), words_of(f.tr, fault.code)});
    };
    row("failed", "", said, true);
    const auto detail = [this](const TechnicianCompared& one) {
      const Fault& fault = one.result.failure;
      return fault.empty() ? std::string_view() : f.left_to_right(f.breakable(fault.detail));
    };
    row("failed detail", "", detail, false, true);
  }
  void figures() {
    for (std::size_t i = 0; i < kStages; ++i)
      figure(f.id("seconds", i), work_of(f.tr, i), 2, "s", [i](const R& r) { return r.seconds[i]; });
    figure("all matches", f.tr("Matches"), 0, "", [](const R& r) { return r.matches; });
    for (std::size_t i = 0; i < kStages; ++i)
      figure(f.id("count", i), made_by(f.tr, i), 0, "", [i](const R& r) { return r.made[i]; });
    for (const FigureRow& one : kMeasures)
      figure(one.id, f.tr(one.label), one.decimals, one.unit, one.value, one.known);
  }
};

void buttons(TechnicianFrame& f, bool there, bool any) {
  if (f.busy()) return;
  const float grow = f.open_buttons();
  const bool room = !there || f.seen.put_aside + 1 < kCompared;
  if (any) {
    const auto next = static_cast<TechnicianStage>((std::size_t(f.seen.stage) + 1) % kTechnicianStages);
    f.small_button("next stage", title_of(f.tr, f.seen.stage), icon::kAgain, ButtonLook::Quiet,
                   ShowStage{next}, grow);
    if (there && f.seen.put_aside > 0) {
      difference_button(f, grow);
      if (f.portrait) f.tree.close(), f.open_buttons();  // two and two
    }
    if (there && room)
      f.small_button("keep", f.tr("Put this result aside"), nullptr, ButtonLook::Quiet,
                     TechnicianAct::KeepResult, grow);
  }
  if (room && !f.seen.recording.running)
    f.small_button("list saved", f.tr("Load from the stick"), icon::kDisk, ButtonLook::Quiet,
                   TechnicianAct::ListSaved, grow);
  f.tree.close();
}

}  // namespace

void technician_compare_page(TechnicianFrame& f) {
  if (f.seen.saved.listed) return f.saved_list(true);
  // Those put aside are shown also where there is no present one.
  const bool kept_alone = f.seen.calibrated && !f.busy() && !f.seen.result.there && f.seen.put_aside > 0;
  if (kept_alone) f.problem(f.seen.problem);
  const bool there = !kept_alone && f.capture_state();
  const std::size_t count = kept_alone ? f.seen.put_aside : there ? f.seen.put_aside + 1 : 0;
  const auto one = std::size_t(std::max(0, f.service.mode));
  if (one > 0 && one <= count && f.seen.compared[one - 1].model != nullptr) return alone(f, one - 1, there);
  if (count > 0) {
    Columns columns(f, there);
    columns.pictures();
    columns.table();
  }
  f.stick_state();
  buttons(f, there, count > 0);
  f.capture_buttons(true);
}

}  // namespace relievo::ui
