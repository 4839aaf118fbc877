// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ColumnSpan: columns of a row from `begin` up to `end`; none where they are equal.
#pragma once

namespace relievo::pipeline {

struct ColumnSpan {
  int begin, end;
};

}  // namespace relievo::pipeline
