// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/technician/technician_frame.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "ui/screens/service/fault_words.h"

namespace relievo::ui {
namespace {

// In the order of TechnicianStage.
constexpr std::array kStageTitles{mark_tr("Pictures"), mark_tr("Processed"), mark_tr("Rectified"),
                                  mark_tr("Matches"),  mark_tr("Disparity"), mark_tr("Points"),
                                  mark_tr("Surface"),  mark_tr("Texture"),   mark_tr("Poses")};
static_assert(kStageTitles.size() == std::size_t(TechnicianStage::Count));

}  // namespace

const char* title_of(const Words& tr, TechnicianStage stage) { return tr(kStageTitles[std::size_t(stage)]); }

const char* work_of(const Words& tr, std::size_t stage) {
  if (stage == 0) return tr("Matching");
  if (stage == 1) return tr("Reconstruction");
  if (stage == 2) return tr("Surface");
  return stage == 3 ? tr("Texture") : tr("Model");
}

namespace {

// Which of the stages makes what is shown, from 1 on.
std::int32_t work_before(TechnicianStage stage) {
  if (stage == TechnicianStage::Cloud) return 2;
  if (stage == TechnicianStage::Mesh) return 3;
  return stage >= TechnicianStage::Texture ? 4 : 1;
}

}  // namespace

std::string_view TechnicianFrame::id(std::string_view what, std::size_t number) const {
  char text[64];
  const int length = std::snprintf(text, sizeof text, "%.*s %zu", int(what.size()), what.data(), number);
  return page.tree.keep({text, std::size_t(std::clamp(length, 0, 63))});
}

std::string_view TechnicianFrame::left_to_right(std::string_view text) const {
  const std::string_view first = page.tree.keep(isolate::kLeft);
  return {first.data(), first.size() + page.tree.keep(text).size() + page.tree.keep(isolate::kEnd).size()};
}

std::string_view TechnicianFrame::joined(std::string_view a, std::string_view between,
                                         std::string_view b) const {
  const std::string_view first = page.tree.keep(isolate::kLeft);
  std::size_t length = first.size();
  for (const std::string_view part : {a, between, b, std::string_view(isolate::kEnd)})
    length += page.tree.keep(part).size();
  return {first.data(), length};
}

std::string_view TechnicianFrame::several(std::initializer_list<double> values, int decimals,
                                          const char* unit_name) const {
  const char* between = info_of(tr.language()).decimal_mark == ',' ? ";\u00a0" : ",\u00a0";
  std::string_view all;
  for (const double* value = values.begin(); value != values.end(); ++value) {
    const std::string_view next = page.number(*value, decimals, value + 1 == values.end() ? unit_name : "");
    all = value == values.begin() ? next : joined(all, between, next);
  }
  return all;
}

std::string_view TechnicianFrame::rule_name(std::string_view key) const {
  if (key == "similarity") return tr("Similarity");
  if (key == "uniqueness") return tr("Uniqueness");
  if (key == "continuity") return tr("Continuity");
  if (key == "ordering") return tr("Order");
  if (key == "left-right") return tr("Left against right");
  return key == "statistical" ? std::string_view(tr("Statistics of the neighbours")) : key;
}

std::string_view TechnicianFrame::breakable(std::string_view names) const {
  const std::string_view first = page.tree.keep({});
  std::size_t length = 0;
  for (const char& c : names) {
    length += page.tree.keep({&c, 1}).size();
    if (c == '.' || c == '_' || c == '+') length += page.tree.keep("\u200b").size();
  }
  return {first.data(), length};
}

float TechnicianFrame::open_buttons() const {
  const bool stacked = page.portrait && page.text_share > 1.2F;
  page.tree.open(page.box(stacked ? Flow::Column : Flow::Row, space::kS));
  return stacked ? 0 : 1;
}

void TechnicianFrame::choice(std::string_view id, std::string_view label, bool chosen, Action action,
                             float grow) {
  page.small_button(id, label, chosen ? icon::kCheck : nullptr, chosen ? ButtonLook::Main : ButtonLook::Quiet,
                    action, grow);
}

void TechnicianFrame::open_picture(std::string_view id, std::string_view spoken,
                                   const TechnicianPicture& picture, PictureSlot slot, Action action,
                                   Action dragged) {
  Node frame = page.grown(page.box(Flow::Stack));
  frame.aspect =
      picture.pixels.empty() ? 1.0F : float(picture.pixels.width_px) / float(picture.pixels.height_px);
  frame.box.fill = page.palette.stage;
  frame.box.radius = page.px(12);
  page.tree.open(frame);
  Node image = page.box(Flow::Column);
  tell(image, Role::Picture, id, spoken);
  if (!picture.pixels.empty()) {
    image.mark = Mark::Image;
    image.picture = slot;
  }
  image.box.radius = page.px(12);
  image.action = action;
  image.dragged = dragged;
  page.tree.leaf(image);
}

void TechnicianFrame::close_picture() { page.tree.close(); }

void TechnicianFrame::pin_line(float y, Colour colour, float thick_dp) {
  Node line = page.box(Flow::Column);
  line.pinned = true;
  line.pin_x = 0.5F;
  line.pin_y = y;
  line.box.height = std::max(1.0F, page.px(thick_dp));
  line.box.fill = colour;
  page.tree.leaf(line);
}

void TechnicianFrame::pin_dot(float x, float y, Colour colour, std::string_view id) {
  Node dot = page.sized(page.box(Flow::Column), 22, 22);
  dot.id = id;
  dot.pinned = true;
  dot.pin_x = x;
  dot.pin_y = y;
  dot.box.border = colour;
  dot.box.border_px = page.px(3.5F);
  dot.box.radius = page.px(11);
  page.tree.leaf(dot);
}

namespace {

// Beside each other the surfaces of the stage; alone, in mode 1 and on, whatever there is of that result.
void fill_compared(DrawList& list, const TechnicianView& view, int mode) {
  static_assert(kCompared == kFaces);
  const auto face_of = [&](const TechnicianCompared& one) {
    const TechnicianDifference& d = one.difference;
    if (!view.differences || !d.known || d.colours == nullptr)
      return Face{one.model, nullptr, one.model_number, nullptr};
    return Face{one.model, nullptr, d.number, d.colours};
  };
  const std::size_t alone = std::size_t(std::max(0, mode));
  for (std::size_t i = 0; i < kCompared; ++i) {
    const TechnicianCompared& one = view.compared[i];
    if (alone == 0 && one.model != nullptr && is_turned(view.stage))
      list.faces[i] = {one.model, nullptr, one.model_number, nullptr};
    if (alone == i + 1 && one.model != nullptr) list.faces[0] = face_of(one);
  }
  list.face_look.textured = view.stage == TechnicianStage::Texture || list.faces[0].colours != nullptr;
  list.face_look.fill = true;
  list.face_look.edges = list.face_look.points = false;
}

}  // namespace

bool fill_technician_pictures(DrawList& list, const TechnicianView& view, const Visit& visit,
                              const Service& service) {
  const StaffPage page = service.page;
  const auto put = [&list](std::size_t place, const TechnicianPicture& picture) {
    list.pictures[std::size_t(PictureSlot::TechnicianLeft) + place] = {picture.pixels, picture.version};
  };
  const auto show = [&put](const TechnicianPicture& left, const TechnicianPicture& right) {
    put(0, left);
    put(1, right);
  };
  if (page == StaffPage::Stages) show(view.shown[0], view.shown[1]);
  if (page == StaffPage::Compare) {
    for (std::size_t i = 0; i < kCompared; ++i) {
      const TechnicianCompared& one = view.compared[i];
      put(i, view.differences && one.difference.known ? one.difference.map : one.picture);
    }
    list.face_look = visit.look;
    fill_compared(list, view, service.mode);
  }
  if (page == StaffPage::Cameras)
    show(view.cameras.camera[0].picture, view.cameras.relief_shown && service.mode == 0
                                             ? view.cameras.relief
                                             : view.cameras.camera[1].picture);
  if (page == StaffPage::Calibrate) show(view.calibration.pictures[0], view.calibration.pictures[1]);
  if (page == StaffPage::Model && view.model != nullptr) {
    list.faces[0] = {view.model, view.cloud, view.model_number, nullptr};
    list.face_look = visit.look;
  }
  return page >= StaffPage::Stages && page <= StaffPage::Calibrate;
}

void TechnicianFrame::problem(const Fault& fault) {
  if (!fault.empty()) alert(words_of(tr, fault.code), fault.detail);
}

void TechnicianFrame::failure() {
  const TechnicianResult& r = view.result;
  if (!r.failure.empty())
    alert(page.filled("{} – {}", {work_of(tr, r.failed_at), words_of(tr, r.failure.code)}), r.failure.detail);
}

void TechnicianFrame::alert(std::string_view words, std::string_view detail) {
  Node row = page.box(Flow::Row, space::kS, 0, 8);
  row.id = "problem";
  row.role = Role::Status;
  row.box.align = Align::Centre;
  const auto in_row = page.tree.inside(row);
  page.sign(icon::kAlert, 26, page.palette.bad);
  const auto in_box = page.tree.inside(page.grown(page.box(Flow::Column)));
  Node said = page.text(words, 18, Weight::Regular, page.palette.bad);
  page.tree.leaf(said);
  page.tree.leaf(page.english(detail, 17));
}

void TechnicianFrame::uncalibrated() {
  Node room = page.grown(page.box(Flow::Column, space::kM, space::kXl, 0));
  centre(room);
  const auto in_room = page.tree.inside(room);
  page.heading("uncalibrated", tr("This device is not calibrated yet"), type::kHeading, TextAlign::Centre);
  page.small_button("to calibration", tr("Calibration"), icon::kWrench, ButtonLook::Main,
                    {ActionKind::StaffOpen, int(StaffPage::Calibrate)});
}

bool TechnicianFrame::capture_state() {
  if (!view.calibrated) {
    uncalibrated();
    return false;
  }
  problem(view.problem);
  if (view.phase == TechnicianPhase::Ready || (view.phase == TechnicianPhase::Failed && view.result.there))
    return true;
  Node room = page.grown(page.box(Flow::Column, space::kM, space::kXl, 0));
  room.box.justify = Justify::Centre;
  page.tree.open(room);
  if (view.phase == TechnicianPhase::Empty || view.phase == TechnicianPhase::Failed) {
    page.heading("nothing", tr("No test capture yet"), type::kHeading, TextAlign::Centre);
    page.body("nothing words",
              tr("It is looked at stage by stage and belongs to nobody: when you leave, it is wiped."),
              TextAlign::Centre);
  } else {
    page.heading(
        "working",
        view.phase == TechnicianPhase::Capturing ? tr("One moment, please") : work_of(tr, view.working_on),
        type::kHeading, TextAlign::Centre);
    const float done =
        view.phase == TechnicianPhase::Capturing ? 0 : (float(view.working_on) + view.progress) / kStages;
    page.progress("run progress", done);
  }
  page.tree.close();
  return false;
}

void TechnicianFrame::stick_buttons() {
  const float grow = open_buttons();
  if (view.recording.running) {
    page.small_button("stop recording", tr("Stop"), icon::kClose, ButtonLook::Main,
                      technician_action(TechnicianAct::StopRecording), grow);
  } else {
    if (view.can_record)
      page.small_button("record", tr("Record on the stick"), icon::kDisk, ButtonLook::Quiet,
                        technician_action(TechnicianAct::Record), grow);
    if (view.can_record)
      page.small_button("save", tr("Save on the stick"), icon::kDisk, ButtonLook::Quiet,
                        technician_action(TechnicianAct::Save), grow);
    page.small_button("list saved", tr("Load from the stick"), icon::kDisk, ButtonLook::Quiet,
                      technician_action(TechnicianAct::ListSaved), grow);
  }
  page.tree.close();
}

void TechnicianFrame::stick_state() {
  const TechnicianRecording& r = view.recording;
  if (view.phase == TechnicianPhase::Capturing || view.phase == TechnicianPhase::Running) return;
  if (r.running) return page.progress("record progress", r.progress);
  if (r.outcome != Outcome::Done) return page.outcome();
  page.status("recorded",
              page.filled(tr("Recorded on the stick as {}. It can be pulled out."), left_to_right(r.where)),
              Mood::Good);
}

void TechnicianFrame::saved_list(bool beside) {
  problem(view.problem);
  if (view.saved.names.empty()) {
    page.nothing("no saved", icon::kDisk, tr("There is no saved reconstruction on the stick."));
  } else {
    page.begin_panel("saved");
    page.section(tr("Saved on the stick, the newest first"));
    page.tree.open(page.box(Flow::Column, space::kS, 0, space::kXs));
    for (std::size_t i = 0; i < view.saved.names.size(); ++i)
      page.small_button(id("saved", i), left_to_right(breakable(view.saved.names[i])), icon::kShape,
                        ButtonLook::Quiet, technician_action(LoadSaved{i, beside}));
    page.tree.close();
    page.tree.close();
  }
  const float grow = open_buttons();
  page.small_button("leave saved", tr("Back"), nullptr, ButtonLook::Quiet,
                    technician_action(TechnicianAct::LeaveSaved), grow);
  page.tree.close();
}

void TechnicianFrame::capture_buttons(bool with_run, bool with_stick) {
  const bool busy = view.phase == TechnicianPhase::Capturing || view.phase == TechnicianPhase::Running;
  if (with_stick && !busy) stick_buttons();
  if (!view.calibrated) return;
  const float grow = open_buttons();
  if (busy) {
    page.small_button("stop", tr("Stop"), icon::kClose, ButtonLook::Main,
                      technician_action(TechnicianAct::Stop), grow);
  } else {
    const bool there = view.result.there;
    page.small_button("capture", tr("Test capture"), icon::kCamera,
                      there ? ButtonLook::Quiet : ButtonLook::Main, technician_action(TechnicianAct::Capture),
                      grow);
    if (view.can_add_side)
      page.small_button("add side",
                        view.sides == 0
                            ? tr("Add a side")
                            : page.filled("{} ({})", {tr("Add a side"), page.number(double(view.sides))}),
                        icon::kCamera, ButtonLook::Quiet, technician_action(TechnicianAct::AddSide), grow);
    if ((with_run || view.sides > 0) && there)
      page.small_button("run", tr("Calculate again"), icon::kAgain, ButtonLook::Main,
                        technician_action(RunStages{}), grow);
    else if (with_stick && there)
      page.small_button("run from", tr("Calculate again from here"), icon::kAgain, ButtonLook::Quiet,
                        technician_action(RunStages{work_before(view.stage)}), grow);
  }
  page.tree.close();
}

}  // namespace relievo::ui
