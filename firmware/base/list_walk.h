// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ListWalk: the appliance's half of every list of more than a page: which page is shown, which stretches of
// the list were asked for, which filter holds. It knows numbers of rows, not the rows. Thread: main.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "ui/view/service_view.h"
#include "ui/view/staff_request.h"

namespace relievo::firmware {

class ListWalk {
 public:
  explicit ListWalk(std::int64_t per_page) : per_page_(per_page) {}
  // What has to be done: other rows be shown, labels be found for the stretches, or which filters there are.
  enum class Ask : std::uint8_t { Rows, Labels, Filters };
  Ask ask(const ui::ListRequest& request);
  // So many rows are there now; the page stays as near as there are pages.
  void set_rows(std::int64_t rows);
  void begin_anew();  // at the first page, without a filter

  std::int64_t first_row() const { return page_ * per_page_; }
  std::int64_t end_row() const { return std::min(rows_, first_row() + per_page_); }
  std::size_t filter() const { return filter_; }
  // The stretches asked for last, and the row at the top of each.
  std::size_t stretches() const { return count_; }
  std::int64_t top_row(std::size_t stretch) const { return stretches_[stretch].first * per_page_; }
  void set_label(std::size_t stretch, std::string label);
  // Of all of them, by the row at the top.
  template <typename Label>
  void label_each(const Label& label) {
    for (std::size_t i = 0; i < count_; ++i) set_label(i, label(std::size_t(top_row(i))));
  }
  // Wipes the labels.
  void forget();
  ui::ListPlace view() const;

 private:
  struct Stretch {
    std::int64_t first = 0, last = 0;
    std::string label;
  };
  std::int64_t pages() const { return std::max<std::int64_t>(1, (rows_ + per_page_ - 1) / per_page_); }
  const std::int64_t per_page_;
  std::int64_t rows_ = 0, page_ = 0;
  std::size_t filter_ = 0, count_ = 0, labelled_ = 0;
  std::array<Stretch, ui::kListStretches> stretches_;
};

}  // namespace relievo::firmware
