// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/staff_screens.h"

#include <array>

#include "ui/screens/service/technician/technician_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

constexpr const char *kPulse = "\uf430", *kFlash = "\uf241", *kPaper = "\uf219", *kPeople = "\uf016",
                     *kChart = "\uf128", *kHeart = "\uf5f6", *kKey = "\uf30b", *kRuler = "\uf46d",
                     *kPath = "\uf328", *kTable = "\uf4eb", *kTune = "\uf62e", *kCompare = "\uf18a",
                     *kCog = "\uf493", *kTarget = "\uf4fe", *kClock = "\uf0f0";

// A page of the technician's, where there is one.
template <void (*kDraw)(TechnicianFrame&)>
void technician(StaffFrame& page) {
  if (page.staff.technician == nullptr) return;
  TechnicianFrame f(page);
  kDraw(f);
}

// In the order of the menu.
constexpr auto kPages = [] {
  using enum StaffPage;
  return std::to_array<StaffPageInfo>({
      {Records, "open records", mark_tr("Records"), kPeople, false, true, records_page, mark_tr("Records")},
      {Statistics, "open statistics", mark_tr("Statistics"), kChart, false, true, statistics_page},
      {Consent, "open consent", mark_tr("Consent text"), kPaper, false, true, consent_in_force},
      {Cameras, "open cameras", mark_tr("Cameras"), icon::kCamera, true, false,
       technician<technician_cameras_page>, mark_tr("Cameras")},
      {Calibrate, "open calibrate", mark_tr("Calibration"), kRuler, true, false,
       technician<technician_calibrate_page>},
      {Trigger, "open trigger", mark_tr("Trigger test"), kFlash, true, false, trigger_page},
      {Health, "open health", mark_tr("Health"), kHeart, true, false, health_page, mark_tr("Health")},
      {SelfTest, "open self test", mark_tr("Self-test"), kPulse, true, false, self_test_page},
      {Log, "open log", mark_tr("Log"), kPaper, true, false, log_page},
      {Stages, "open stages", mark_tr("Test capture"), kPath, true, false, technician<technician_stages_page>,
       mark_tr("Test capture")},
      {Model, "open model", mark_tr("Model"), icon::kShape, true, false, technician<technician_model_page>},
      {Tables, "open tables", mark_tr("Figures"), kTable, true, false, technician<technician_tables_page>},
      {Algorithms, "open algorithms", mark_tr("Algorithms"), kTune, true, false,
       technician<technician_algorithms_page>},
      {Compare, "open compare", mark_tr("Comparison"), kCompare, true, false,
       technician<technician_compare_page>},
      {Settings, "open settings", mark_tr("Settings"), kCog, true, true, settings_page, mark_tr("Settings")},
      {Clock, "open clock", mark_tr("Date and time"), kClock, true, true, clock_page},
      {Touch, "open touch", mark_tr("Touch screen"), kTarget, true, false, touch_page},
      {Recovery, "open recovery", mark_tr("Recovery words"), kKey, false, true, recovery_page},
      {Pins, "open pins", mark_tr("Change my PIN"), kKey, true, true, pins_page},
  });
}();

void draw_page(StaffFrame& page) {
  if (page.service.page == StaffPage::Pin) return pin_page(page);
  if (page.service.page == StaffPage::FirstStart) return first_start_page(page);
  for (const StaffPageInfo& info : kPages) {
    if (info.page != page.service.page || !may_open(page.staff.role, info)) continue;
    page.begin(page.tr(info.title), info.letter);
    info.draw(page);
    return page.end();
  }
  menu_page(page);
}

}  // namespace

std::span<const StaffPageInfo> staff_pages() { return kPages; }

bool may_open(StaffRole role, const StaffPageInfo& info) {
  return (role == StaffRole::Technician && info.for_technician) ||
         (role == StaffRole::Operator && info.for_operator);
}

const Palette& build_staff_screen(Tree& tree, const ViewState& view, const Visit& visit,
                                  const Service& service, const Rect& screen) {
  const Palette& palette = visit.high_contrast ? kHighContrast : kLight;
  tree.begin(info_of(visit.language).right_to_left);
  StaffFrame page(tree, view, visit, service, palette, screen);
  Node root = page.box(Flow::Stack);
  root.id = "screen";
  tree.open(root);
  draw_page(page);
  if (visit.overlay != Overlay::None) overlay_screen(page);
  tree.close();
  return palette;
}

void fill_staff_pictures(DrawList& list, const ViewState& view, const Visit& visit, const Service& service) {
  list.pictures = {};
  list.faces = {};
  if (view.service->technician != nullptr &&
      fill_technician_pictures(list, *view.service->technician, visit, service))
    return;
  if (const RecoveryView* sheet = view.service->recovery)
    list.pictures[std::size_t(PictureSlot::TechnicianLeft)] = sheet->code;
  list.faces[0].model = view.service->model;
  list.faces[0].version = view.service->model == nullptr ? 0 : view.service->model_number;
  list.face_look = visit.look;
}

void staff_entrance(Page& page) {
  if (page.view.service == nullptr || page.visit.overlay != Overlay::None) return;
  const Step step = page.visit.step;
  if (step != Step::Attract && step != Step::Trouble) return;
  const auto in_corner =
      page.tree.inside(aligned(justified(page.box(Flow::Row, 0, 16, 16), Justify::End), Align::Start));
  Node lock = centred(page.sized(page.box(Flow::Column), size::kTarget, size::kTarget));
  tell(lock, Role::Button, "staff", page.tr("Staff: hold for three seconds"), ActionKind::StaffEnter);
  lock.hold = true;
  lock.filling = page.palette.accent;
  lock.box.radius = page.px(size::kRadius);
  const auto in_lock = page.tree.inside(lock);
  page.sign(icon::kLock, 30 / page.text_share, page.palette.ink_soft);
}

}  // namespace relievo::ui
