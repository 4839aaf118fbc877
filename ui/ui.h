// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ui: turns fingers into intents, and ViewState into a DrawList. It holds the visit, the tree and what
// the hands do; it knows neither SDL nor GL nor a thread.
//
//   feed(Input) ... frame(ViewState) -> draw_list(), and take_intent() until there is none
//
// Pixels. Thread: main. Errors: none.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "ui/display.h"
#include "ui/render/face_geometry.h"
#include "ui/speech/narrator.h"
#include "ui/text/text_engine.h"
#include "ui/tree/tree.h"
#include "ui/view/action.h"
#include "ui/view/service.h"
#include "ui/view/view_state.h"
#include "ui/view/visit.h"

namespace relievo::ui {

class Ui {
 public:
  explicit Ui(std::unique_ptr<TextEngine> text) : text_(std::move(text)) {}

  void resize(int width_px, int height_px) { width_px_ = width_px, height_px_ = height_px; }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  void feed(const Input& input, const ViewState& view);
  void frame(const ViewState& view);
  // The frame of another visit, or of the staff's side: for screenshots and tests.
  void show(const ViewState& view, const Visit& visit, const Service& service = {});

  std::optional<Intent> take_intent();
  VisitRequest request() const;
  std::optional<StaffRequest> take_staff_request() { return service_.take_request(); }
  // The person has gone since the last call: pictures of them in other hands are to be wiped, too.
  bool take_forgotten() { return std::exchange(forgotten_, false); }

  // What is to be said of the newest frame; `busy`: something is being said. Empty: nothing new. The
  // utterance holds until the next call.
  const Utterance& speak(const ViewState& view, bool busy);
  // Does anybody want to hear the pages? The staff's say names: they are for headphones alone.
  bool is_heard(const ViewState& view) const { return visit_.spoken && (view.headphones || !service_.open); }

  const DrawList& draw_list() const { return list_; }
  TextEngine& text() { return *text_; }
  const Tree& tree() const { return tree_; }
  Visit& visit() { return visit_; }
  const Visit& visit() const { return visit_; }
  Service& service() { return service_; }
  // A page that a visitor has had no time to see: its buttons are not pressed yet. The staff know theirs, and
  // hold what cannot be undone.
  bool has_just_come(hal::Instant now) const { return !service_.open && now < visit_.takes_touches_from; }
  std::string_view focus() const {
    return hands_.show_focus ? std::string_view(hands_.focus) : std::string_view();
  }
  const Service& service() const { return service_; }

 private:
  struct Finger {
    bool down = false;
    std::int64_t id = 0;
    float x = 0, y = 0, start_x = 0, start_y = 0;
    bool dragging = false;
    hal::Instant felt{};  // last
  };
  struct Place {
    Step step = Step::Starting;
    Overlay overlay = Overlay::None;
    std::optional<StaffPage> page;  // none: the visitor's side
    int mode = 0;
    bool code = false;  // is asked for, not a name
    bool operator==(const Place&) const = default;
  };
  static constexpr std::size_t kIntents = 8;
  void draw(const ViewState& view);
  void follow_staff(const ViewState& view);
  void ask(std::optional<Intent> intent);
  void hear(ActionKind kind, const ViewState& view);
  void down(const Input& input, const ViewState& view);
  void comes(bool asked_for, hal::Instant now);
  bool on_model(const Finger& finger) const;
  void move(const Input& input, const ViewState& view);
  void up(const Input& input, const ViewState& view);
  void focus_on(int direction);
  const Node* before_content() const;
  void focus_beside(float right, float down, const ViewState& view);
  void move_focus(const Node* at, const Node* next, int direction);
  const Node* focused() const { return hands_.show_focus ? tree_.find(hands_.focus) : nullptr; }
  const Node* field() const;  // where letters are asked for
  void type(const Input& input, const ViewState& view);
  bool does_nothing(ActionKind kind) const;
  void keep_focus();
  float scrolled_px(const Node& scroller) const {
    return hands_.scrolled == scroller.id ? hands_.scroll_px : 0;
  }
  bool scroll(const Node& scroller, float to_px);  // false: it is there
  void bring_into_view(const Node& node);
  void read_on();
  bool comes_to_the_end();
  void activate(const Node& node, const ViewState& view);
  void tap(const Node& node, const Finger& finger, const Input& input, const ViewState& view);
  void touch(const Node& node, Action action, const Input& input, const ViewState& view);
  void activate_focus(const ViewState& view);
  const Node* ruled() const;
  FaceProjection projection_on(const Node& face);
  bool follow_ruler();
  void drag_face(float dx, float dy);
  void pinch(const Finger& moved, float old_x, float old_y, const Finger& other);

  std::unique_ptr<TextEngine> text_;
  Visit visit_;
  Service service_;
  Narrator narrator_;
  bool heard_ = false;                       // the last time it was asked what to say
  bool withheld_ = false;                    // then: asked for, and not said
  Language introduced_ = Language::English;  // in which it was said how to go on
  std::size_t focus_at_ = 0;                 // of the node with the focus, in the tree
  Tree tree_;
  FaceStand stand_;  // of the model that is measured on, and which
  std::uint32_t stands_ = 0;
  Interaction hands_;
  DrawList list_;
  std::array<Finger, 2> fingers_{};
  std::int64_t newest_ = 0;  // of the fingers
  std::array<Intent, kIntents> intents_{};
  std::size_t intent_count_ = 0;
  Place last_;
  hal::Instant pressed_at_{};
  bool key_held_ = false;  // what is pressed was asked for by the keypad
  bool acted_ = false;     // somebody pressed something since the last frame
  bool forgotten_ = false;
  int width_px_ = 1280, height_px_ = 800;
};

}  // namespace relievo::ui
