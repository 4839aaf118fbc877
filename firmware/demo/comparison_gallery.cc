// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/demo/technician_exhibits.h"
#include "firmware/technician/show/surface_difference.h"

namespace relievo::firmware {
namespace {

// How the one put aside differs, and the present one by itself.
void add_differences(Lender& all, const ui::ViewState& review, ui::TechnicianView view) {
  view.differences = true;
  view.full_colour_mm = 0.5F;
  view.scale = difference_scale();
  view.compared[0].difference = {true, -0.04F, 0.31F, {review.stages[1].picture, 900041}, nullptr, 900041};
  view.compared[view.put_aside] = {view.result, view.shown[0], view.model, view.model_number, {}};
  all.add("technician_difference", ui::StaffPage::Compare, view);
  all.add("technician_compare_alone", ui::StaffPage::Compare, view);
  all.lent.back().mode = 1;
  all.lent.back().measures = true;
}

}  // namespace

// The same capture by other algorithms, another document, and one whose matcher gave up.
void add_comparisons(Lender& all, const ui::ViewState& review, ui::TechnicianView view) {
  const auto put_aside = [&view] {
    view.compared[view.put_aside++] = {view.result, view.shown[0], view.model, view.model_number, {}};
  };
  const auto add_with_present = [&](std::string_view name) {
    view.compared[view.put_aside] = {view.result, view.shown[0], view.model, view.model_number, {}};
    all.add(name, ui::StaffPage::Compare, view);
  };
  lend(review, ui::TechnicianStage::Mesh, view);
  put_aside();
  view.result.algorithms = "matcher = zmncc\nzmncc.window_px = 9";
  view.result.seconds[0] = 3.87F;
  view.result.accepted = view.result.made[0] = 96114;
  add_with_present("technician_compare");
  add_differences(all, review, view);
  put_aside();
  view.result.name = "2026-03-11_16-40-52";
  view.result.algorithms = {};
  add_with_present("technician_compare_three");
  lend(review, ui::TechnicianStage::Disparity, view);
  for (std::size_t i = 0; i < view.put_aside; ++i) view.compared[i].picture = view.shown[0];
  put_aside();
  view.result.algorithms = "matcher = sgm";
  view.result.failure = {
      Errc::NoFace,
      "the points form no surface of a face's size: look straight into the cameras and try again"};
  view.result.failed_at = 2;
  view.result.coverage = 0;
  view.model = nullptr;
  add_with_present("technician_compare_four");
}

}  // namespace relievo::firmware
