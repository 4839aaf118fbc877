// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Advice: what the person in front of the cameras can do. Not an error: nothing is broken.
// One at a time, the first that holds in the order below: the order in which a person can act on it. Behind
// each stands the component of ISO/IEC 29794-5 (the reference implementation's name, OFIQ) that speaks of the
// same, where there is one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace relievo::pipeline {

enum class Advice : std::uint8_t {
  None,
  NoFace,
  MoreThanOneFace,  // SingleFacePresent
  TooClose,         // step back
  TooFar,           // come closer; InterEyeDistance, HeadSize
  OffCentre,        // which way, the measures say; the four ...CropOfTheFaceImage
  TurnedAside,      // HeadPoseYaw
  LooksUpOrDown,    // HeadPosePitch
  Tilted,           // HeadPoseRoll: an ear to a shoulder
  Moved,            // hold still
  TooDark,          // UnderExposurePrevention, LuminanceMean
  TooBright,        // OverExposurePrevention, LuminanceMean
  UnevenLight,      // IlluminationUniformity
  Highlights,       // the skin mirrors a lamp
  Blurred,          // Sharpness, while nothing moves: wipe the lens, wait for the focus
  FaceHidden,       // hair, hand, mask: FaceOcclusionPrevention, MouthOcclusionPrevention
  EyesHidden,       // EyesVisible
  EyesClosed,       // EyesOpen
  GlassesGlare,     // glasses mirror a lamp
  MouthOpen,        // MouthClosed; teeth, tongue
  NotNeutral,       // ExpressionNeutrality: a smile
  Background,       // something beside the head: make room
};

// What somebody is told who turns the head after the frontal picture, and how far the sides are that are
// photographed: yaw against the front, + to the picture's right.
enum class TurnAdvice : std::uint8_t {
  Lost,     // no head is found: look at the cameras again
  ToLeft,   // turn on, to the picture's left
  ToRight,  // to the picture's right
  Level,    // chin up or down, ears level
  Slower,
  Hold,  // the side is right: it is photographed in a moment
  Done
};
inline constexpr std::size_t kSides = 4;
inline constexpr std::array<double, kSides> kSidesDeg{-45, -25, 25, 45};

}  // namespace relievo::pipeline
