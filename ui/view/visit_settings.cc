// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a visit looks and sounds: when it begins, as the staff has set it, and silent but for who brings
// headphones; and what moves by itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "hal/base/utf8.h"
#include "ui/view/visit.h"

namespace relievo::ui {

// What a visitor types or shows: their name, in memory of its own that is wiped.
namespace {

constexpr std::chrono::milliseconds kSameKey{1000};  // within it a key means its next letter

// Keys 1 to 9, of small letters and of capital ones.
using Keys = std::array<std::string_view, 9>;
using Keypad = std::array<Keys, 2>;
constexpr Keypad kPlain{{{" -'.1", "acb2", "edf3", "ihg4", "lkj5", "nom6", "rspq7", "tuv8", "wyzx9"},
                         {" -'.1", "ACB2", "EDF3", "IHG4", "LKJ5", "NOM6", "RSPQ7", "TUV8", "WYZX9"}}},
    kGerman{{{" -'.1", "aäcb2", "edf3", "ihg4", "lkj5", "nomö6", "rsßpq7", "tüuv8", "wyzx9"},
             {" -'.1", "AÄCB2", "EDF3", "IHG4", "LKJ5", "MNOÖ6", "RSPQẞ7", "TUÜV8", "WYZX9"}}},
    kFrench{{{" -'.1", "acbçâà2", "eédfèêë3", "ihgîï4", "lkj5", "nomôœ6", "rspq7", "tuvûùü8", "yzwxÿ9"},
             {" -'.1", "ACBÇÂÀ2", "EÉDFÈÊË3", "IHGÎÏ4", "LKJ5", "NOMÔŒ6", "RSPQ7", "TUVÛÙÜ8", "YZWXŸ9"}}},
    kSpanish{{{" -'.1", "acáb2", "edéf3", "iíhg4", "lkj5", "noñóm6", "rspq7", "tuvúü8", "yzwx9"},
              {" -'.1", "ACBÁ2", "EDFÉ3", "IHGÍ4", "LKJ5", "MNOÑÓ6", "RSPQ7", "TUVÚÜ8", "YZWX9"}}};
constexpr Keys kArabic{" -1", "تبةث2", "اأءإآئؤ3", "سشصض4", "ردزذ5", "حجخ6", "نيهوى7", "لمقفك8", "عطغظ9"},
    kHebrew{" -'1", "ודה2", "אבג3", "נמןם4", "ילכך5", "חטז6", "רתש7", "קצץ8", "עפסף9"};
constexpr std::array kKeypads{
    kPlain, kGerman, kFrench, kSpanish, Keypad{kArabic, kArabic}, Keypad{kHebrew, kHebrew},
    kPlain, kPlain};  // in the order of Language
static_assert(kKeypads.size() == kLanguages);

constexpr float kBirthS = 2.2F, kTurnS = 16, kTurnDeg = 28;  // there and back once
constexpr float kLooksDeg = 27;
constexpr float kLookedAtHz = 30;  // so often the head that invites is drawn anew: it moves all day
constexpr std::chrono::seconds kReads{10};

float seconds(hal::Instant::duration time) { return std::chrono::duration<float>(time).count(); }
// Begins and ends at rest.
float eased(float share) { return share * share * (3 - 2 * share); }

}  // namespace

std::string_view keypad_letter(Language language, char digit, std::size_t times, bool capital) {
  const std::string_view key = kKeypads[std::size_t(language)][capital ? 1 : 0][std::size_t(digit - '1')];
  std::size_t at = 0;
  for (std::size_t i = 0; i < times; ++i) {
    at += first_letter_of(key.substr(at)).bytes;
    if (at == key.size()) at = 0;
  }
  return key.substr(at, first_letter_of(key.substr(at)).bytes);
}

void Visit::type(std::string_view letter) {
  if (step != Step::Name || overlay != Overlay::None) return;
  digit_ = 0;
  if (quotes_code_) return type_code(letter);
  if (letter == " " && (name().empty() || name().ends_with(' '))) return;
  if (!name_.add(letter)) return;
  capitals = letter == " " || letter == "-";
  if (info_of(language).latin) other_letters = false;  // a single ö; a name has all letters of its script
}

// Its digits alone: they are grouped where they are shown.
void Visit::type_code(std::string_view letters) {
  for (const char& c : letters) {
    if (c < '0' || c > '9' || name().size() == kCodeDigits) continue;
    name_.add({&c, 1});
    code_handed_in_ = false;
  }
}

void Visit::type_by_digit(char digit, hal::Instant now) {
  if (quotes_code_) return type_code({&digit, 1});
  const bool again = digit == digit_ && now - digit_at_ < kSameKey;
  const std::size_t times = again ? digit_times_ + 1 : 0;
  if (again && name().size() > digit_after_) erase_letter();  // the letter before may have been refused
  digit_after_ = name().size();
  const Language typed = other_letters && !info_of(language).latin ? Language::English : language;
  type(keypad_letter(typed, digit, times, capitals));
  digit_ = digit;
  digit_times_ = times;
  digit_at_ = now;
}

void Visit::enter(std::string_view text, hal::Instant now) {
  if (step != Step::Name || overlay != Overlay::None || !name().empty() || text.size() > kMostNameBytes)
    return;
  touched(now);
  if (quotes_code_) return type_code(text);
  name_ = text;
  capitals = other_letters = false;
}

void Visit::erase_letter() {
  digit_ = 0;
  code_handed_in_ = false;
  name_.cut(last_letter_at(name()));
  capitals = name().empty() || name().ends_with(' ') || name().ends_with('-');
}

FaceLook Visit::shown_look(hal::Instant now) const {
  if (step == Step::Attract) return invitation(now);
  if (!by_itself_) return look;
  FaceLook moved = look;
  const float since = seconds(now - entered_), turning = since - kBirthS;
  moved.born = eased(std::clamp(since / kBirthS, 0.0F, 1.0F));
  if (turning > 0)
    moved.yaw_deg =
        kTurnDeg * std::sin(2 * std::numbers::pi_v<float> * turning / kTurnS) * std::min(1.0F, turning / 2);
  return moved;
}

// A face without sides is open behind: seen from far aside or from above it would be a mask.
void Visit::turn_face(float yaw_deg, float pitch_deg, float most_deg) {
  constexpr float kMostYaw = 60, kMostPitch = 30, kMostPitchOfHead = 50;
  const bool mask = step == Step::Review && !has_sides_;
  if (mask) most_deg = std::min(most_deg, kMostYaw);
  look.yaw_deg = std::clamp(look.yaw_deg + yaw_deg, -most_deg, most_deg);
  const float most_pitch =
      mask ? kMostPitch * (1 - 0.75F * std::abs(look.yaw_deg) / kMostYaw) : kMostPitchOfHead;
  look.pitch_deg = std::clamp(look.pitch_deg + pitch_deg, -most_pitch, most_pitch);
}

// Nobody is near and nobody was: the page that invites rests.
bool Visit::rests(hal::Instant now) const {
  return step == Step::Attract && !near_ && now - std::max(near_until_, last_touch_) > kReads;
}

// The head that invites sees who comes near, then looks to and fro; it stands still while somebody is at the
// screen and reads.
FaceLook Visit::invitation(hal::Instant now) const {
  FaceLook head{.yaw_deg = -kLooksDeg, .pitch_deg = 9, .zoom = 1.12F, .light_deg = -40};
  if (!settings_.is_on(Setting::Motion) || rests(now)) return head;
  const float seen = seconds(now - came_near_);
  const float since =
      std::floor(std::min(seconds(now - last_touch_ - kReads), seen) * kLookedAtHz) / kLookedAtHz;
  if (since > 0) head.yaw_deg *= std::cos(2 * std::numbers::pi_v<float> * since / kTurnS);
  return head;
}

void Visit::follow_presence(const ViewState& view) {
  if (view.somebody_near) near_until_ = view.now;
  if (std::exchange(near_, view.somebody_near) != view.somebody_near && near_) came_near_ = view.now;
}

void Visit::look_as_set() {
  language = home_;
  const auto size = std::ranges::find(kTextPercents, settings_.of(Setting::TextPercent));
  text_size = std::size_t(size - kTextPercents.begin()) % kTextPercents.size();
  high_contrast = settings_.is_on(Setting::Contrast);
  reach = Reach::Usual;
  spoken = headphones_;
  volume = kUsualVolume;
  speed = kUsualSpeed;
}

bool Visit::looks_as_set() const {
  return language == home_ && text_percent() == settings_.of(Setting::TextPercent) &&
         high_contrast == settings_.is_on(Setting::Contrast) && reach == Reach::Usual &&
         spoken == headphones_ && volume == kUsualVolume && speed == kUsualSpeed;
}

// Who plugs headphones in is spoken to; who pulls them out is not, lest others hear it.
void Visit::follow_headphones(const ViewState& view) {
  voices_ = (view.languages & view.voices).any();
  const bool heard = view.headphones && voices_;
  if (std::exchange(headphones_, heard) != heard) {
    spoken = heard;
    touched(view.now);
  }
  spoken = spoken && voices_;
}

// What the staff has chosen is seen at once where nobody's visit has begun.
void Visit::follow_settings(const ViewState& view) {
  const bool other = settings_ != view.settings;
  settings_ = view.settings;
  if (other && (step == Step::Attract || step == Step::Starting)) look_as_set();
}

}  // namespace relievo::ui
