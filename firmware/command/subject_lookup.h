// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From what a person typed to somebody in the store: a name, a number as "#3", or the code a visitor was
// given. Errors: NotFound; InvalidInput (several have the name: the numbers tell them apart). Thread: main.
#pragma once

#include <string_view>

#include "storage/store.h"

namespace relievo::firmware {

// Could somebody have this name? Asked before anything is opened: nobody is photographed in vain.
Result<void> check_subject(std::string_view name_or_number);
Result<storage::Subject> find_subject(storage::Store& store, std::string_view name_or_number);
// The one of that name, or somebody new. A number or a code makes nobody: it is somebody's, or NotFound.
Result<std::optional<storage::SubjectId>> choose_subject(storage::Store& store,
                                                         std::string_view name_or_number);

}  // namespace relievo::firmware
