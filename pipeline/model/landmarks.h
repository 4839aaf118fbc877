// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Landmarks: the named points of a face, after L. G. Farkas, Anthropometry of the Head and Face (2nd ed.,
// 1994), found on the measured surface. Left camera's frame, millimetres; left and right are the person's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

enum class LandmarkName : std::uint8_t {
  Pronasale,          // foremost point of the nose, on the plane of symmetry: the head frame's origin
  Nasion,             // deepest point of the root of the nose (sellion, as soft tissue shows it)
  Subnasale,          // where the nose's septum meets the upper lip
  Pogonion,           // foremost point of the chin
  EndocanthionRight,  // inner corner of the eye
  EndocanthionLeft,
  ExocanthionRight,  // outer corner of the eye
  ExocanthionLeft,
  CheilionRight,  // corner of the mouth
  CheilionLeft,
  Count
};
inline constexpr std::size_t kLandmarkCount = std::size_t(LandmarkName::Count);

struct Landmark {
  Vec3f at_mm;
  float sigma_mm = 0;  // one standard deviation of each coordinate, as measured against truth
  bool found = false;  // false: at_mm and sigma_mm say nothing
};

using Landmarks = std::array<Landmark, kLandmarkCount>;

// As files name them, in the order of LandmarkName.
inline constexpr std::array<std::string_view, kLandmarkCount> kLandmarkWords{
    "pronasale",          "nasion",
    "subnasale",          "pogonion",
    "endocanthion_right", "endocanthion_left",
    "exocanthion_right",  "exocanthion_left",
    "cheilion_right",     "cheilion_left"};
static_assert(!kLandmarkWords.back().empty());
constexpr std::string_view word(LandmarkName name) { return kLandmarkWords[std::size_t(name)]; }

constexpr const Landmark& of(const Landmarks& landmarks, LandmarkName name) {
  return landmarks[std::size_t(name)];
}

}  // namespace relievo::pipeline
