// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ViewState: everything a screen may draw, as plain data made anew for every frame. A screen reads
// it, draws, and answers with an Intent: it decides nothing and remembers nothing about the person.
// Thread: main. Ownership: pictures and models are borrowed for the length of one frame.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/clock.h"
#include "pipeline/model/advice.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/stereo_frame.h"
#include "ui/device/settings.h"
#include "ui/draw/draw_list.h"
#include "ui/language/language.h"
#include "ui/view/service_view.h"

namespace relievo::ui {

// The states a person or a technician can see: the same words as the machine's states.
enum class Screen : std::uint8_t {
  SelfTest,
  Idle,
  Calibrate,
  Position,
  Capture,
  Turn,
  Match,
  Reconstruct,
  Mesh,
  Texture,
  Fuse,
  Review,
  Store,
  Export,
  Staff,
  Fault
};

// What went wrong, as far as it makes a difference to the person who reads it.
enum class Trouble : std::uint8_t {
  None,
  Camera,       // unplugged, or silent
  Calibration,  // the cameras have moved
  Refused,      // no model could be made of these pictures
  Storage,      // full or broken
  StorageFull,  // this portrait was not stored: for want of room
  TookTooLong,
  Uncalibrated,  // nobody has calibrated this device yet
  Clock,         // set to a time that cannot be: a consent would bear a wrong date
  Restarted,     // the power went, or the program did, in the middle of something
  Other
};

// Nothing a visitor can pass by: it stands until the staff have mended it.
constexpr bool bars_the_way(Trouble trouble) {
  return trouble == Trouble::Uncalibrated || trouble == Trouble::Calibration || trouble == Trouble::Clock;
}

// What the records say to the name or code that was typed.
enum class Known : std::uint8_t {
  NotAsked,
  Asking,
  Nobody,  // somebody new
  Name,    // somebody has this name
  Code,    // a code, and the record it was given for
  NoSuchCode
};

// How a head stands that turns after the frontal picture. Directions are the picture's, not the mirror's.
struct TurnView {
  pipeline::TurnAdvice advice = pipeline::TurnAdvice::Lost;
  float yaw_deg = 0;  // against the front, + to the picture's right
  std::bitset<pipeline::kSides> taken;
};

// The newest picture of the left camera, made small, while a person finds their place.
struct LiveView {
  ImageView picture;         // Rgb8; empty: none yet
  std::uint32_t number = 0;  // grows with every picture
  pipeline::Advice advice = pipeline::Advice::NoFace;
  float face_x = 0, face_y = 0;  // its middle from the middle of where it should be, in widths of the face
  float ideal_width = 0;         // of a face at the best distance, share of the picture's width; 0: not known
  float nearness = 0;            // 1 at a good distance, 0.5 twice as far, 2 half as far; 0: not known
  // Of the head, from one that looks at the cameras: + turned to the picture's right, looking down, leaning
  // to the picture's left.
  float yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  float steady_s = 0;  // so long everything has been right
  std::optional<TurnView> turn;
};

inline constexpr std::size_t kStageViews = 5;  // Capture, Match, Reconstruct, Mesh, Texture

// Of the code on paper.
enum class Printing : std::uint8_t { None, Ready, Busy, Done, Failed };

// The visitor's copy of their model, on a stick of their own.
enum class Taking : std::uint8_t {
  None,     // the operator does not offer it
  NoStick,  // one may be plugged in
  NotOurs,  // one was there before the visit began: it may be another person's
  Ready,
  Busy
};
struct TakeHomeView {
  Taking taking = Taking::None;
  float progress = 0;               // 0 to 1
  Outcome outcome = Outcome::None;  // of the last try
  std::string_view link;            // to what the operator offers; empty: nothing
  Picture link_code;                // the same as a QR code
};

// The operator's own consent text, in the languages they have it in. Plain data, UTF-8.
struct ConsentPoint {
  std::string title, words;
  bool operator==(const ConsentPoint&) const = default;
};

struct ConsentText {
  std::string title;
  std::vector<ConsentPoint> points;
  bool operator==(const ConsentText&) const = default;
};

// In a link, where the number stands that names a portrait and erases nothing.
inline constexpr std::string_view kModelPlace = "{model}", kHttps = "https://";
// "museum.example" of "https://museum.example/heads/1".
constexpr std::string_view site_of(std::string_view link) {
  link.remove_prefix(std::min(link.size(), kHttps.size()));
  return link.substr(0, link.find('/'));
}

// Who runs the device.
struct Host {
  std::string name, reached;    // how they are reached; both may be empty
  std::string link;             // where they offer a portrait, with kModelPlace in it; empty: nowhere
  std::vector<std::byte> sign;  // Rgb8 or Grey8, rows without padding; empty: none
  int sign_width_px = 0, sign_height_px = 0;
  PixelFormat sign_format = PixelFormat::Rgb8;
  ImageView sign_view() const {
    return {sign.data(), sign_width_px, sign_height_px, sign_width_px * bytes_per_pixel(sign_format),
            sign_format};
  }
  bool operator==(const Host&) const = default;
};

struct ConsentTexts {
  std::string version;  // stored with every record, as "2026-03"
  Host host;
  std::array<std::optional<ConsentText>, kLanguages> in;
  const ConsentText* of(Language language) const {
    const auto& text = in[std::size_t(language)];
    return text ? &*text : nullptr;
  }
  bool operator==(const ConsentTexts&) const = default;
};

struct ViewState {
  Screen screen = Screen::SelfTest;
  hal::Instant now{};
  std::chrono::system_clock::time_point wall_now{};
  float progress = 0;  // 0 to 1 of the way from the photograph to the portrait; falls for a new one alone
  Trouble trouble = Trouble::None;
  FaultView calibration_note;  // for the technician: what speaks against the calibration
  std::string_view receipt;    // what to quote for an erasure; from the moment of storing on
  Picture receipt_code;        // the same as a QR code
  Printing printing = Printing::None;
  TakeHomeView take_home;
  bool cameras_on = false;  // they are streaming: as the capture thread has it
  int attempt = 0;          // 1 for the first capture of a session
  LiveView live;
  // The photograph and what the stages made of it; empty: not born yet. Kept while the session is open.
  std::array<Picture, kStageViews> stages{};
  const pipeline::StereoFrame* frame = nullptr;          // the pictures of this session, once taken
  const pipeline::FaceModel* model = nullptr;            // from Review on
  std::uint32_t model_number = 0;                        // another for every model
  const pipeline::FaceModel* invitation_head = nullptr;  // a simulated head for the page that invites
  std::bitset<kLanguages> languages = std::bitset<kLanguages>().set();  // that a visitor may choose
  std::bitset<kLanguages> voices;                                       // that have a voice here
  bool somebody_near = true;              // as far as the device can tell, without its cameras
  bool headphones = false;                // are plugged: what is said is heard by one person alone
  Language home = Language::English;      // the one a visit begins in; one of them
  Settings settings;                      // the staff's
  const ServiceView* service = nullptr;   // for the staff's pages; none: there are none
  const ConsentTexts* consent = nullptr;  // the operator's own; none: the sample
  Known known = Known::NotAsked;
  Trouble out_of_order = Trouble::None;  // shown instead of the page that invites; Other: too hot
};

}  // namespace relievo::ui
