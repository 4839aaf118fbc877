// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How an algorithm's settings describe themselves, once: every Options struct has a free function
//
//   template <typename Field> void describe(XOptions& o, Field&& field) {
//     field("window_px", o.window_px, OptionRange{3, 63}, "side of the window, pixels");
//   }
//
// from which `--set`, the TOML file, the technician's page and the documentation are made.
#pragma once

namespace relievo::pipeline {

struct OptionRange {
  double least;
  double most;
};

}  // namespace relievo::pipeline
