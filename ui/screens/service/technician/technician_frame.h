// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianFrame: what the technician's picture pages share on top of StaffFrame: pictures that can be
// touched and marked, rows of choices, the state of the test capture with the buttons that lead on. Lengths
// in dp. Thread: main. Errors: none.
#pragma once

#include <initializer_list>
#include <string_view>

#include "ui/screens/service/staff_frame.h"
#include "ui/technician/technician_view.h"

namespace relievo::ui {

class TechnicianFrame : public StaffFrame {
 public:
  explicit TechnicianFrame(const StaffFrame& page) : StaffFrame(page), seen(*page.staff.technician) {}
  const TechnicianView& seen;

  // Coordinates: "812.00, 604.00 px", on one line; where the comma is the decimal mark a semicolon stands
  // between them.
  std::string_view several(std::initializer_list<double> values, int decimals, const char* unit_name);
  // What a rule for matches is called (pipeline/algorithms); a name nobody knows, as it is.
  std::string_view rule_name(std::string_view key);
  // Buttons beside each other, or below where large words stand upright. Gives the share each of them grows
  // by.
  float open_buttons();
  // One of several: the chosen one is filled and ticked.
  void choice(std::string_view id, std::string_view label, bool chosen, Action action, float grow = 1);
  // Pages whose words are large, or narrow ones, put less beside each other.
  std::size_t across(std::size_t most) const { return little_room() ? (most + 1) / 2 : most; }
  // An explanation among the figures, or in their place.
  void note(std::string_view words, float size = type::kSmall) {
    write(words, size, Weight::Regular, palette.ink_soft);
  }
  // What the colours of a difference say.
  void scale_words(float full_colour_mm, float size = type::kSmall);
  // Camera 0 is the left one, 1 the right one.
  const char* camera_name(std::size_t side) const {
    return side == 0 ? tr("Left camera") : tr("Right camera");
  }
  static PictureSlot slot_of(std::size_t place) {
    return static_cast<PictureSlot>(std::size_t(PictureSlot::TechnicianLeft) + place);
  }
  // How much wider than the figures beside them pictures are: large words take room from them.
  float picture_share(float usual) const { return portrait ? 1.0F : large_words() ? usual * 0.65F : usual; }

  // A dark card of the picture's shape in the room there is; what comes until Tree::close() can be pinned
  // to it (Node::pinned). Touched, `action` says where; `dragged` as in Node.
  void open_picture(std::string_view id, std::string_view spoken, const Picture& picture, PictureSlot slot,
                    Action action = {}, Action dragged = {});
  // The page's model on a dark card, with its scale and the distance of two touched points; `tools` lie on
  // its lower end.
  void face(float share, void (*tools)(TechnicianFrame&), float tools_dp);
  // Touches set points from now on, or no longer.
  void measure_button(float grow);
  // On the open picture: a line over its whole width, a ring; shares of the picture.
  void pin_line(float y, Colour colour, float thick_dp);
  void pin_dot(float x, float y, Colour colour, std::string_view id);

  // The way into every page that needs a capture: nothing there, under way, or what went wrong; true when
  // there is a result to be shown below it.
  bool capture_state();
  // Something is under way that the pages wait for; how much of it is done.
  bool busy() const {
    return seen.phase == TechnicianPhase::Capturing || seen.phase == TechnicianPhase::Running;
  }
  float done() const {
    return seen.phase == TechnicianPhase::Running ? (float(seen.working_on) + seen.progress) / kStages : 0;
  }
  // The buttons under the pages of the test capture.
  // `with_stick`: also those between the reconstruction and the stick.
  void capture_buttons(bool with_run, bool with_stick = false);
  void problem(const FaultView& fault);  // empty: nothing is shown
  void failure();                        // of the present result's stages
  // The reconstructions on the stick, in place of the page: a touch loads one, `beside` the present one.
  void saved_list(bool beside);
  // What becomes of a recording, above the buttons that lead on.
  void stick_state();

 private:
  void ruler();
  void uncalibrated();  // what to do first
  void alert(std::string_view words, std::string_view detail);
  void stick_buttons();
};

const char* title_of(const Words& tr, TechnicianStage stage);
// Has it a surface, to be turned with a finger?
inline bool is_turned(TechnicianStage stage) {
  return stage == TechnicianStage::Mesh || stage == TechnicianStage::Texture;
}
// Of kStages: what it does; what it makes.
const char* work_of(const Words& tr, std::size_t stage);
const char* made_by(const Words& tr, std::size_t stage);

// The pictures and the model of these pages; false where `page` is none of them.
bool fill_technician_pictures(DrawList& list, const TechnicianView& view, const Visit& visit,
                              const Service& service);

// The pages.
void technician_stages_page(TechnicianFrame& f);
void technician_model_page(TechnicianFrame& f);
void technician_tables_page(TechnicianFrame& f);
void technician_algorithms_page(TechnicianFrame& f);
void technician_compare_page(TechnicianFrame& f);
void technician_cameras_page(TechnicianFrame& f);
void technician_calibrate_page(TechnicianFrame& f);

}  // namespace relievo::ui
