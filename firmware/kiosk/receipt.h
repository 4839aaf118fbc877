// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The code a person gets for their erasure: the subject's number with two check digits (ISO/IEC 7064,
// MOD 97-10), as "000123-09". One wrong or swapped digit is noticed.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "storage/record.h"

namespace relievo::firmware {

std::string receipt_of(storage::SubjectId subject);
// Nothing where it is no such code.
std::optional<storage::SubjectId> subject_of_receipt(std::string_view code);

}  // namespace relievo::firmware
