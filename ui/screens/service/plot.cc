// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <algorithm>
#include <cmath>

#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {
namespace {

constexpr int kMostSteps = 4;
constexpr float kHeight = 96, kLetters = 16, kBarShare = 0.8F, kLineDp = 2.5F, kLimitDp = 2;

// What is known of the values: how many, the highest, the newest.
struct Known {
  std::size_t count = 0, highest = 0, last = 0;
};
Known known_of(std::span<const float> values) {
  Known known;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (known.count++ == 0 || values[i] > values[known.highest]) known.highest = i;
    known.last = i;
  }
  return known;
}

class Drawing {
 public:
  Drawing(StaffFrame& on, const Plot& of)
      : page(on), what(of), scale(plot_scale(of.values, of.limit)), known(known_of(of.values)) {}

  void all() {
    Node whole = page.box(Flow::Column, 4, 0, 8);  // told as one: nobody wants to hear the axes
    tell(whole, Role::Picture, what.id, what.title);
    whole.value = words();
    const auto in_whole = page.tree.inside(whole);
    head();
    Node row = left_first(aligned(page.box(Flow::Row, 6), Align::Start));
    const auto in_row = page.tree.inside(row);
    upright_axis();
    const auto in_box = page.tree.inside(page.grown(page.box(Flow::Column, 2)));
    field();
    level_axis();
  }

 private:
  StaffFrame& page;
  const Plot& what;
  const PlotScale scale;
  const Known known;

  float letters() const { return kLetters * page.text_share; }
  float line_px() const { return std::round(page.px(letters()) * type::kLines.apart); }
  float height_px() const { return page.px(kHeight) + line_px(); }
  std::string_view said(double value) const {
    const int more = value == std::floor(value) ? 0 : 1;
    return page.number(value, std::max(scale.decimals(), more) + (scale.decimals() > 0 ? 1 : 0), what.unit);
  }
  // Numbers are as large in every language, and their lines as high.
  Node label(std::string_view words, TextAlign align) const {
    Node node = page.text(words, kLetters, Weight::Regular, page.palette.ink_soft, align);
    node.style.size_px = page.px(letters());
    node.style.language = info_of(Language::English).code;
    node.style.tabular = true;
    return node;
  }

  void head() {
    Node row = page.box(Flow::Row, space::kM);
    row.box.wrap = true;
    page.tree.open(row);
    page.wide(page.text(what.title, type::kSmall, Weight::Medium, page.palette.ink));
    const Colour ink = what.figure_ink.seen() ? what.figure_ink : page.palette.ink_soft;
    page.tree.open(justified(page.row_box(space::kXs), Justify::End));
    if (what.figure_sign != nullptr) page.sign(what.figure_sign, 24, ink);
    if (!what.figure.empty())
      page.write(page.filled("{}", what.figure), type::kSmall, Weight::Regular, ink, TextAlign::End);
    page.tree.close(2);
    if (!std::isnan(what.limit)) page.write(limit_words(), 18, Weight::Regular, page.palette.bad);
  }
  std::string_view limit_words() {
    return page.filled(page.tr("Limit: {}"), page.number(what.limit, scale.decimals(), what.unit));
  }

  // Evenly spaced, the middle of each at its height.
  void upright_axis() {
    Node axis = aligned(justified(page.box(Flow::Column), Justify::SpaceBetween), Align::End);
    axis.box.height = height_px();
    const auto in_axis = page.tree.inside(axis);
    for (int i = scale.steps; i >= 0; --i)
      page.tree.leaf(
          label(page.number(scale.from + i * scale.step, scale.decimals(), i == scale.steps ? what.unit : ""),
                TextAlign::End));
  }

  void level_axis() {
    std::array<std::string_view, 3> under = what.under;
    const std::size_t count = std::min(what.names.size(), what.values.size());
    if (under[0].empty() && count > 0) {
      under[0] = what.names.front();
      if (count > 2 && count % 2 == 1) under[1] = what.names[count / 2];
      if (count > 1) under[2] = what.names[count - 1];
    }
    const auto in_row_2 = page.tree.inside(left_first(page.box(Flow::Row)));
    const TextAlign aligned[] = {TextAlign::Start, TextAlign::Centre, TextAlign::End};
    for (std::size_t i = 0; i < under.size(); ++i) {
      const auto in_box_2 = page.tree.inside(page.grown(page.box(Flow::Column)));
      if (!under[i].empty())
        page.tree.leaf(label(under[i], page.mirrored() && i != 1 ? aligned[2 - i] : aligned[i]));
    }
  }

  void field() {
    Node room = page.box(Flow::Stack);
    room.box.height = height_px();
    room.box.pad_y = std::round(line_px() / 2);
    const auto in_room = page.tree.inside(room);
    page.tree.leaf(page.box(Flow::Column));
    for (int i = 0; i <= scale.steps; ++i)
      level(scale.from + i * scale.step, i == 0 ? page.palette.ink_soft : page.palette.card_border, 1);
    if (what.look == PlotLook::Bars) bars();
    else line();
    if (!std::isnan(what.limit)) level(double(what.limit), page.palette.bad, kLimitDp);
  }
  void level(double value, Colour colour, float dp) {
    page.tree.mark({{0, height_of(value), 1, 0}, colour, std::max(1.0F, page.px(dp))});
  }
  // From the top, as a share.
  float height_of(double value) const { return 1 - float(scale.share(value)); }
  Colour colour_of(float value) const { return value > what.limit ? page.palette.bad : page.palette.accent; }

  void bars() {
    const float slot = 1 / float(std::max<std::size_t>(1, what.values.size())), zero = height_of(0);
    for (std::size_t i = 0; i < what.values.size(); ++i) {
      const float value = what.values[i];
      if (std::isnan(value) || value == 0) continue;
      const float y = height_of(double(value));
      page.tree.mark(
          {{(float(i) + (1 - kBarShare) / 2) * slot, std::min(y, zero), kBarShare * slot, std::abs(zero - y)},
           colour_of(value),
           0});
    }
  }
  // As steps: a value holds until the next.
  void line() {
    const float slot = 1 / float(std::max<std::size_t>(1, what.values.size())),
                thick = std::max(1.0F, page.px(kLineDp));
    for (std::size_t i = 0; i < what.values.size(); ++i) {
      if (std::isnan(what.values[i])) continue;
      const float x = float(i) * slot, y = height_of(double(what.values[i]));
      page.tree.mark({{x, y, slot, 0}, colour_of(what.values[i]), thick});
      if (i == 0 || std::isnan(what.values[i - 1])) continue;
      const float before = height_of(double(what.values[i - 1]));
      if (before != y)
        page.tree.mark({{x, std::min(before, y), 0, std::abs(before - y)}, colour_of(what.values[i]), thick});
    }
  }

  std::string_view words() {
    if (known.count == 0) return page.tr("There is none yet");
    const auto at = [&](std::size_t i) {
      return i < what.names.size() ? what.names[i] : std::string_view("–");
    };
    std::string_view all =
        page.filled(page.tr("Highest: {} ({})"), {said(what.values[known.highest]), at(known.highest)});
    if (what.look == PlotLook::Line && known.count > 1)
      all = page.filled("{}. {}: {}", {all, page.tr("Now"), said(what.values[known.last])});
    if (!std::isnan(what.limit)) all = page.filled("{}. {}", {all, limit_words()});
    return what.figure.empty() ? all : page.filled("{}. {}", {what.figure, all});
  }
};

}  // namespace

int PlotScale::decimals() const { return std::max(0, int(std::ceil(-std::log10(step) - 1e-9))); }

PlotScale plot_scale(std::span<const float> values, float limit) {
  double least = 0, most = std::isnan(limit) ? 0 : double(limit);
  for (const float value : values) {
    if (std::isnan(value)) continue;
    least = std::min(least, double(value));
    most = std::max(most, double(value));
  }
  if (most <= least) most = least + 1;
  const double rough = (most - least) / kMostSteps, power = std::pow(10, std::floor(std::log10(rough)));
  PlotScale scale;
  for (const double times : {1.0, 2.0, 5.0, 10.0}) {
    scale.step = times * power;
    if (scale.step >= rough * (1 - 1e-6)) break;
  }
  scale.from = std::floor(least / scale.step + 1e-6) * scale.step;
  scale.steps = std::max(1, int(std::ceil((most - scale.from) / scale.step - 1e-6)));
  return scale;
}

void StaffFrame::plot(const Plot& what) {
  due_rule();
  Drawing(*this, what).all();
  rule_due_ = true;
}

}  // namespace relievo::ui
