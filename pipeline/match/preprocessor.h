// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Preprocessor: changes the grey values that selectors and matchers see, in place; geometry, colours (the
// texture is laid from them) and the face region stay as they are. Errors: OutOfMemory, Cancelled,
// InvalidInput (a pair without pixels): what the grey values are then is not said.
#pragma once

#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

class Preprocessor {
 public:
  virtual ~Preprocessor() = default;
  virtual std::string_view name() const = 0;
  virtual Result<void> process(RectifiedPair& pair, StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
