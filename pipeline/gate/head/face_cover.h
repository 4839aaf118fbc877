// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Something before a face: a hand, a sheet, hair that hangs down. Asked of the relief before the head itself
// is measured, since of a covered face neither tip nor pose can be told. In the frame of the small picture,
// pixels. Memory: none. Thread: any. Errors: none.
#pragma once

#include "pipeline/gate/head/head_measurement.h"

namespace relievo::pipeline {

// Share of the face about the hint that lies on surfaces which stand before another surface of it: they meet
// along kLeastMeetingMm or more, and the nearer is nearer by kStepMm or more all along. The face before its
// own neck, ear or the room is not meant.
double covered_share(const Relief& relief, const HeadHint& hint);

inline constexpr double kStepMm = 15, kLeastMeetingMm = 25;

}  // namespace relievo::pipeline
