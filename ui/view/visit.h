// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visit: where a person is on the way through the screens, and what they have typed so far. The
// appliance knows nothing of them before Intent::Pose; what is typed lives here, in fixed memory, and
// is wiped when they leave, are done, or nobody has touched the screen for the setting PatienceS.
//
//   Attract -> Consent -> Name (-> Known) -> Position (-> Turn) -> Working -> Review -> Thanks -> Attract
//      (from Position to Review the machine leads and the visit follows)
//
// Thread: main. Errors: none: what does not fit is not typed.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <string_view>

#include "hal/base/wiped_text.h"
#include "ui/draw/draw_list.h"
#include "ui/language/language.h"
#include "ui/view/action.h"
#include "ui/view/view_state.h"

namespace relievo::ui {

enum class Step : std::uint8_t {
  Attract,
  Consent,
  Name,
  Known,
  Position,
  Turn,
  Working,
  Review,
  Thanks,
  Trouble,
  Starting,
  Declined,
  Count
};
struct StepInfo {
  std::string_view name;
  int number = -1;               // of the four parts of the way; -1: it is none of them
  bool person_expected = false;  // who is silent there is asked, and the visit then ends
};
// In the order of Step.
inline constexpr std::array<StepInfo, std::size_t(Step::Count)> kSteps{{{"Attract"},
                                                                        {"Consent", 0, true},
                                                                        {"Name", 1, true},
                                                                        {"Known", 1, true},
                                                                        {"Position", 2, true},
                                                                        {"Turn", 2},
                                                                        {"Working", 3},
                                                                        {"Review", 3, true},
                                                                        {"Thanks", -1, true},
                                                                        {"Trouble"},
                                                                        {"Starting"},
                                                                        {"Declined"}}};
static_assert(!kSteps.back().name.empty());
constexpr const StepInfo& info_of(Step step) { return kSteps[std::size_t(step)]; }
enum class Overlay : std::uint8_t { None, Help, Languages, Leave, StillThere, LostCode, Privacy };

// WCAG 2.2.1 wants 20 seconds for an answer; a code that is seen nowhere else stands longer than other pages.
inline constexpr std::chrono::seconds kLastCall{20}, kReceiptPatience{120}, kToldFor{30};
inline constexpr std::chrono::milliseconds kTooLate{1000};  // a touch that came as what it was for had ended
inline constexpr std::chrono::milliseconds kStruckTwice{600};  // a touch so soon after another is the same
inline constexpr std::chrono::minutes kFaceAlone{5};  // a face keeps a visit no longer without a touch
inline constexpr float kSteadyFor = 0.3F;             // seconds, before the countdown begins
inline constexpr std::size_t kMostNameBytes = 128, kCodeDigits = 14;
inline constexpr const char* kConsentWording = "sample-2";  // where the operator has no text of their own
inline constexpr std::string_view kToRead = "points";       // the scroller of what one agrees to
// Where the controls are: as usual, all in the lower part of the page, there and on the other side.
enum class Reach : std::uint8_t { Usual, Low, LowOther };
inline constexpr int kMostLookUps = 5;  // a visit; then nobody is told anything any more
inline constexpr std::array<int, 4> kTextPercents{100, 125, 150, 200};
inline constexpr std::array<int, 5> kVolumePercents{20, 35, 50, 70, 100};
inline constexpr std::array<int, 4> kSpeedPercents{75, 100, 135, 180};
inline constexpr std::size_t kUsualVolume = 2, kUsualSpeed = 1;

class Visit {
 public:
  Step step = Step::Starting;
  Overlay overlay = Overlay::None;
  Language language = Language::English;
  std::size_t text_size = 0;  // index into kTextPercents
  bool high_contrast = false;
  Reach reach = Reach::Usual;
  bool spoken = false;  // the pages are read aloud: by the plug of headphones, or asked for
  std::size_t volume = kUsualVolume, speed = kUsualSpeed;  // indices into kVolumePercents, kSpeedPercents
  bool capitals = true;
  bool other_letters = false;  // the keyboard shows á, ß, ø ..., or Latin letters instead of others
  FaceLook look;
  hal::Instant takes_touches_from{};  // on the page as it is: a touch before that was for another one
  bool shot_in_the_dark = false;      // the last picture was asked for though it was too dark for the cameras
  int touches = 0;                    // since "I agree", typing not counted

  int text_percent() const { return kTextPercents[text_size]; }
  std::string_view name() const { return name_.view(); }
  // Is the code of an earlier record asked for, instead of a name?
  bool quotes_code() const { return quotes_code_; }
  // Was the code, as it stands, handed in? What the records said of another one is no answer to it.
  bool code_handed_in() const { return code_handed_in_; }
  EnrolmentKind enrolment_kind() const { return enrolment_kind_; }
  std::chrono::system_clock::time_point agreed_at() const { return agreed_at_; }
  // Seconds until the visit is wiped; only while Overlay::StillThere asks.
  int seconds_left(hal::Instant now) const;
  // Seconds until the picture is taken by itself; nothing while something is to be mended first.
  std::optional<float> countdown(const LiveView& live) const;
  // The same as a number of three that are counted down; 0: there is none.
  int countdown_number(const LiveView& live) const;
  float countdown_s() const { return float(settings_.of(Setting::CountdownMs)) / 1000; }

  // The languages to choose from: to who listens, those that can be heard.
  std::bitset<kLanguages> offered(const ViewState& view) const {
    return spoken ? view.languages & view.voices : view.languages;
  }

  // A finger or key somewhere: the person is there.
  void touched(hal::Instant now);
  // The end of what one agrees to has been on the screen, or the pages are read aloud.
  bool has_read() const { return read_ || spoken; }
  void reads_to_the_end() { read_ = true; }
  // How the face on the page is looked at now: a new portrait comes to be, then turns by itself until
  // somebody touches it.
  FaceLook shown_look(hal::Instant now) const;
  bool rests(hal::Instant now) const;
  // Something is being said to them, or written for them: they cannot answer yet.
  void listens(hal::Instant now) {
    if (overlay != Overlay::StillThere) last_touch_ = now;
  }
  // What is to be asked of the appliance, if anything.
  std::optional<Intent> act(Action action, const ViewState& view);
  // Follows the machine, and the time.
  std::optional<Intent> follow(const ViewState& view);
  void type(std::string_view letter);
  // '1' to '9': one of the letters on that key; again soon after, the next of them.
  void type_by_digit(char digit, hal::Instant now);
  // A text that was shown to the cameras, as though it had been typed; not over something typed.
  void enter(std::string_view text, hal::Instant now);
  void forget();
  // Turns the face by so much; to the side no further than `most_deg`.
  void turn_face(float yaw_deg, float pitch_deg, float most_deg);

 private:
  void go(Step to, hal::Instant now);
  void forget_person();  // not how they like to read
  std::optional<Intent> act_on_path(ActionKind kind, const ViewState& view);
  std::optional<Intent> leave_now(const ViewState& view);
  std::optional<Intent> back(const ViewState& view);  // what lies over the page first
  void erase_letter();
  void follow_machine(const ViewState& view);
  std::optional<Intent> follow_face(const ViewState& view);
  std::optional<Intent> follow_look_up(const ViewState& view);
  std::optional<Intent> act_on_record(ActionKind kind);
  void follow_language(const ViewState& view);
  void follow_headphones(const ViewState& view);
  void follow_presence(const ViewState& view);
  void follow_settings(const ViewState& view);
  FaceLook invitation(hal::Instant now) const;
  void look_as_set();
  bool looks_as_set() const;
  std::chrono::seconds patience() const {
    const std::chrono::seconds set(settings_.of(Setting::PatienceS));
    return step == Step::Thanks ? std::max(set, kReceiptPatience) : set;
  }
  void type_code(std::string_view letters);

  ShortWipedText<kMostNameBytes> name_;
  char digit_ = 0;               // that typed the last letter
  std::size_t digit_after_ = 0;  // bytes of the name before that letter
  std::size_t digit_times_ = 0;
  hal::Instant digit_at_{};
  std::chrono::system_clock::time_point agreed_at_{};
  hal::Instant last_touch_{};
  hal::Instant by_hand_{};  // the same, but for a face before the cameras
  bool read_ = false;
  std::uint32_t live_number_ = 0;
  hal::Instant entered_{};
  hal::Instant waited_until_{};  // for their stick
  bool near_ = true;
  hal::Instant came_near_{}, near_until_{};
  Screen last_screen_ = Screen::SelfTest;
  Language home_ = Language::English;
  bool headphones_ = false;  // and a voice to be heard in them
  bool voices_ = false;
  Settings settings_;  // as the last view had them
  EnrolmentKind enrolment_kind_ = EnrolmentKind::NewSubject;
  bool quotes_code_ = false, code_handed_in_ = false;
  bool looking_up_ = false;
  int look_ups_ = 0;
  bool by_itself_ = false;  // the portrait comes to be and turns; nobody has touched anything since
  bool shot_ = false;       // asked for, and not yet under way
  bool has_sides_ = false;  // the face that is looked at
};

// The letters on the digit keys of a keypad: on the keys where telephones have them (ITU-T E.161, ETSI ES 202
// 130 for Arabic and Hebrew), but on each the frequent ones of names first, which takes a third of the
// presses away (Pavlovych and Stuerzlinger 2003, "Less-Tap"). The digit itself comes last. `times` 0 is the
// first, round and round. `digit`: '1' to '9'. The text is a constant.
std::string_view keypad_letter(Language language, char digit, std::size_t times, bool capital);

}  // namespace relievo::ui
