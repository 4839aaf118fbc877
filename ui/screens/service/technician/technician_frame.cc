// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/technician/technician_frame.h"

#include <algorithm>
#include <array>

#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {
namespace {

// In the order of TechnicianStage.
constexpr std::array kStageTitles{mark_tr("Pictures"), mark_tr("Processed"), mark_tr("Rectified"),
                                  mark_tr("Matches"),  mark_tr("Disparity"), mark_tr("Points"),
                                  mark_tr("Surface"),  mark_tr("Texture"),   mark_tr("Poses")};
static_assert(kStageTitles.size() == std::size_t(TechnicianStage::Count));

constexpr std::array<const char*, kStages> kWorks{mark_tr("Matching"), mark_tr("Reconstruction"),
                                                  mark_tr("Surface"), mark_tr("Texture"), mark_tr("Model")},
    kMade{mark_tr("Accepted matches"), mark_tr("Points"), mark_tr("Triangles"), mark_tr("Texels"),
          mark_tr("Landmarks")};

// Which of the stages makes what is shown, from 1 on.
std::int32_t work_before(TechnicianStage stage) {
  if (stage == TechnicianStage::Cloud) return 2;
  if (stage == TechnicianStage::Mesh) return 3;
  return stage >= TechnicianStage::Texture ? 4 : 1;
}

// Beside each other the surfaces of the stage; alone, in mode 1 and on, whatever there is of that result.
void fill_compared(DrawList& list, const TechnicianView& view, int mode) {
  static_assert(kCompared == kFaces);
  const std::size_t alone = std::size_t(std::max(0, mode));
  for (std::size_t i = 0; i < kCompared; ++i) {
    const TechnicianCompared& one = view.compared[i];
    if (one.model == nullptr || (alone == 0 ? !is_turned(view.stage) : alone != i + 1)) continue;
    const TechnicianDifference& d = one.difference;
    if (alone > 0 && view.differences && d.known && d.colours != nullptr)
      list.faces[0] = {one.model, nullptr, d.number, d.colours};
    else list.faces[alone == 0 ? i : 0] = {one.model, nullptr, one.model_number, nullptr};
  }
  list.face_look.textured = view.stage == TechnicianStage::Texture || list.faces[0].colours != nullptr;
  list.face_look.fill = true;
  list.face_look.edges = list.face_look.points = false;
}

}  // namespace

const char* title_of(const Words& tr, TechnicianStage stage) { return one_of(tr, kStageTitles, stage); }

// Beyond the last stage poses are fused: that, too, makes the model.
const char* work_of(const Words& tr, std::size_t stage) {
  return one_of(tr, kWorks, std::min(stage, kStages - 1));
}
const char* made_by(const Words& tr, std::size_t stage) { return one_of(tr, kMade, stage); }

std::string_view TechnicianFrame::several(std::initializer_list<double> values, int decimals,
                                          const char* unit_name) {
  const char* between = info_of(tr.language()).decimal_mark == ',' ? ";\u00a0" : ",\u00a0";
  std::string_view all;
  for (const double* value = values.begin(); value != values.end(); ++value) {
    const std::string_view next = number(*value, decimals, value + 1 == values.end() ? unit_name : "");
    all = value == values.begin() ? next : left_to_right({all, between, next});
  }
  return all;
}

std::string_view TechnicianFrame::rule_name(std::string_view key) {
  if (key == "similarity") return tr("Similarity");
  if (key == "uniqueness") return tr("Uniqueness");
  if (key == "continuity") return tr("Continuity");
  if (key == "ordering") return tr("Order");
  if (key == "left-right") return tr("Left against right");
  return key == "statistical" ? std::string_view(tr("Statistics of the neighbours")) : key;
}

void TechnicianFrame::scale_words(float full_colour_mm, float size) {
  note(filled(tr("Red is nearer, blue farther; white agrees. Full colour: {}."),
              number(full_colour_mm, 2, "mm")),
       size);
}

float TechnicianFrame::open_buttons() {
  const bool stacked = portrait && large_words();
  tree.open(box(stacked ? Flow::Column : Flow::Row, space::kS));
  return stacked ? 0 : 1;
}

void TechnicianFrame::choice(std::string_view id, std::string_view label, bool chosen, Action action,
                             float grow) {
  small_button(id, label, chosen ? icon::kCheck : nullptr, chosen ? ButtonLook::Main : ButtonLook::Quiet,
               action, grow);
}

void TechnicianFrame::open_picture(std::string_view id, std::string_view spoken, const Picture& picture,
                                   PictureSlot slot, Action action, Action dragged) {
  Node frame = stage(12);
  frame.aspect = aspect_of(picture.pixels);
  tree.open(frame);
  Node image = box(Flow::Column);
  tell(image, Role::Picture, id, spoken, action);
  if (!picture.pixels.empty()) depict(image, slot);
  image.box.radius = px(12);
  image.dragged = dragged;
  tree.leaf(image);
}

void TechnicianFrame::pin_line(float y, Colour colour, float thick_dp) {
  tree.leaf(pinned(line_box(thick_dp, colour), 0.5F, y));
}

void TechnicianFrame::pin_dot(float x, float y, Colour colour, std::string_view id) {
  Node dot = pinned(sized(box(Flow::Column), 22, 22), x, y);
  dot.id = id;
  ui::frame(dot, {}, colour, px(3.5F), px(11));
  tree.leaf(dot);
}

bool fill_technician_pictures(DrawList& list, const TechnicianView& view, const Visit& visit,
                              const Service& service) {
  const StaffPage page = service.page;
  const auto put = [&list](std::size_t place, const Picture& picture) {
    list.pictures[std::size_t(TechnicianFrame::slot_of(place))] = picture;
  };
  const auto show = [&put](const Picture& left, const Picture& right) {
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

void TechnicianFrame::problem(const FaultView& fault) {
  if (!fault.empty()) alert(words_of(tr, fault.code), fault.detail);
}

void TechnicianFrame::failure() {
  const TechnicianResult& r = seen.result;
  if (!r.failure.empty())
    alert(filled("{} – {}", {work_of(tr, r.failed_at), words_of(tr, r.failure.code)}), r.failure.detail);
}

void TechnicianFrame::alert(std::string_view words, std::string_view detail) {
  Node row = row_box(space::kS, 0, 8);
  tell(row, Role::Status, "problem", {});
  const auto in_row = tree.inside(row);
  sign(icon::kAlert, 26, palette.bad);
  const auto in_box = tree.inside(grown(box(Flow::Column)));
  write(words, 18, Weight::Regular, palette.bad);
  tree.leaf(english(detail, 17));
}

void TechnicianFrame::uncalibrated() {
  const auto in_room = tree.inside(centred(grown(box(Flow::Column, space::kM, space::kXl, 0))));
  heading("uncalibrated", tr("The cameras must be calibrated"), type::kHeading, TextAlign::Centre);
  small_button("to calibration", tr("Calibration"), icon::kWrench, ButtonLook::Main,
               {ActionKind::StaffOpen, int(StaffPage::Calibrate)});
}

bool TechnicianFrame::capture_state() {
  if (!seen.calibrated) {
    uncalibrated();
    return false;
  }
  problem(seen.problem);
  if (seen.phase == TechnicianPhase::Ready || (seen.phase == TechnicianPhase::Failed && seen.result.there))
    return true;
  tree.open(justified(grown(box(Flow::Column, space::kM, space::kXl, 0)), Justify::Centre));
  if (!busy()) {
    heading("nothing", tr("No test capture yet"), type::kHeading, TextAlign::Centre);
    body("nothing words",
         tr("It is looked at stage by stage and belongs to nobody: when you leave, it is wiped."),
         TextAlign::Centre);
  } else {
    heading(
        "working",
        seen.phase == TechnicianPhase::Capturing ? tr("One moment, please") : work_of(tr, seen.working_on),
        type::kHeading, TextAlign::Centre);
    progress("run progress", done());
  }
  tree.close();
  return false;
}

void TechnicianFrame::stick_buttons() {
  const float grow = open_buttons();
  if (seen.recording.running) {
    small_button("stop recording", tr("Stop"), icon::kClose, ButtonLook::Main, TechnicianAct::StopRecording,
                 grow);
  } else {
    if (seen.can_record) {
      small_button("record", tr("Record on the stick"), icon::kDisk, ButtonLook::Quiet, TechnicianAct::Record,
                   grow);
      small_button("save", tr("Save on the stick"), icon::kDisk, ButtonLook::Quiet, TechnicianAct::Save,
                   grow);
    }
    small_button("list saved", tr("Load from the stick"), icon::kDisk, ButtonLook::Quiet,
                 TechnicianAct::ListSaved, grow);
  }
  tree.close();
}

void TechnicianFrame::stick_state() {
  const TechnicianRecording& r = seen.recording;
  if (busy()) return;
  if (r.running) return progress("record progress", r.progress);
  if (r.outcome != Outcome::Done) return outcome(r.outcome);
  status("recorded", filled(tr("Recorded on the stick as {}. It can be pulled out."), left_to_right(r.where)),
         Mood::Good);
}

void TechnicianFrame::saved_list(bool beside) {
  problem(seen.problem);
  if (seen.saved.names.empty()) {
    nothing("no saved", icon::kDisk, tr("There is no saved reconstruction on the stick."));
  } else {
    begin_panel("saved");
    section(tr("Saved on the stick, the newest first"));
    tree.open(box(Flow::Column, space::kS, 0, space::kXs));
    for (std::size_t i = 0; i < seen.saved.names.size(); ++i)
      small_button(id("saved", i), left_to_right(breakable(seen.saved.names[i])), icon::kShape,
                   ButtonLook::Quiet, LoadSaved{i, beside});
    tree.close(2);
  }
  const float grow = open_buttons();
  small_button("leave saved", tr("Back"), nullptr, ButtonLook::Quiet, TechnicianAct::LeaveSaved, grow);
  tree.close();
}

void TechnicianFrame::capture_buttons(bool with_run, bool with_stick) {
  if (with_stick && !busy()) stick_buttons();
  if (!seen.calibrated) return;
  const float grow = open_buttons();
  if (busy()) {
    small_button("stop", tr("Stop"), icon::kClose, ButtonLook::Main, TechnicianAct::Stop, grow);
  } else {
    const bool there = seen.result.there;
    small_button("capture", tr("Test capture"), icon::kCamera, there ? ButtonLook::Quiet : ButtonLook::Main,
                 TechnicianAct::Capture, grow);
    if (seen.can_add_side)
      small_button(
          "add side",
          seen.sides == 0 ? tr("Add a side") : filled("{} ({})", {tr("Add a side"), number(seen.sides)}),
          icon::kCamera, ButtonLook::Quiet, TechnicianAct::AddSide, grow);
    if ((with_run || seen.sides > 0) && there)
      small_button("run", tr("Calculate again"), icon::kAgain, ButtonLook::Main, RunStages{}, grow);
    else if (with_stick && there && (seen.stage != TechnicianStage::Poses || seen.pose_count > 0))
      small_button("run from", tr("Calculate again from here"), icon::kAgain, ButtonLook::Quiet,
                   RunStages{work_before(seen.stage)}, grow);
  }
  tree.close();
}

}  // namespace relievo::ui
