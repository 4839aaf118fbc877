// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the page of records draws. Borrowed for one frame. Thread: main.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "ui/view/list_place.h"

namespace relievo::ui {

struct RecordRow {
  std::int64_t number = 0;
  std::string_view name, since, code;
  int portraits = 0;
};

struct RecordsView {
  std::span<const RecordRow> rows;  // newest first
  ListPlace place;
  std::string_view searched;
  const RecordRow* shown = nullptr;        // the one that is looked at
  std::string_view consent, consented_at;  // the text's version and language; when
  bool erased = false;                     // the last thing that was done
  bool exported = false;
  int asked = 0;  // records of the last export; 0: the last thing that was done is another
  int whole = 0;  // of these, on the stick and read back
};

}  // namespace relievo::ui
