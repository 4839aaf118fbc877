// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Preprocessor: changes the grey values that selectors and matchers see; geometry, colours (the texture
// is laid from them) and the face region stay as they are. The result lives in the context's output.
// Errors: OutOfMemory, Cancelled, InvalidInput (a pair without pixels).
#pragma once

#include <string_view>

#include "pipeline/model/rectified_pair.h"
#include "pipeline/stage.h"

namespace relievo::pipeline {

class Preprocessor {
 public:
  virtual ~Preprocessor() = default;
  virtual std::string_view name() const = 0;
  virtual Result<RectifiedPair> process(const RectifiedPair& pair, StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
