// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/list_walk.h"

namespace relievo::firmware {

ListWalk::Ask ListWalk::ask(const ui::ListRequest& request) {
  const std::int64_t last = pages() - 1;
  if (const auto* go = std::get_if<ui::GoToPage>(&request)) {
    page_ = std::clamp<std::int64_t>(go->page, 0, last);
    return Ask::Rows;
  }
  if (const auto* filter = std::get_if<ui::FilterList>(&request)) {
    filter_ = filter->filter;
    page_ = 0;
    return Ask::Rows;
  }
  if (std::holds_alternative<ui::FindFilters>(request)) return Ask::Filters;
  const auto& divide = std::get<ui::DivideList>(request);
  const std::int64_t from = std::clamp<std::int64_t>(divide.first, 0, last),
                     to = std::clamp<std::int64_t>(divide.last, from, last), all = to - from + 1;
  count_ = std::size_t(std::min<std::int64_t>(all, ui::kListStretches));
  labelled_ = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto begin = [&](std::size_t k) { return from + all * std::int64_t(k) / std::int64_t(count_); };
    stretches_[i] = {begin(i), begin(i + 1) - 1, {}};
  }
  return Ask::Labels;
}

void ListWalk::set_rows(std::int64_t rows) {
  rows_ = rows;
  page_ = std::min(page_, pages() - 1);
}

void ListWalk::begin_anew() {
  page_ = 0;
  filter_ = 0;
  forget();
}

void ListWalk::set_label(std::size_t stretch, std::string label) {
  if (stretch >= count_) return;
  stretches_[stretch].label = std::move(label);
  labelled_ = stretch + 1;
}

void ListWalk::forget() {
  for (Stretch& one : stretches_) one = {};
  count_ = labelled_ = 0;
}

ui::ListPlace ListWalk::view() const {
  ui::ListPlace place;
  place.page = page_;
  place.pages = pages();
  place.filter = filter_;
  place.stretch_count = labelled_ == count_ ? count_ : 0;
  for (std::size_t i = 0; i < place.stretch_count; ++i)
    place.stretches[i] = {stretches_[i].first, stretches_[i].last, stretches_[i].label};
  return place;
}

}  // namespace relievo::firmware
