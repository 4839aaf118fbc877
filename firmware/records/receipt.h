// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The code a person gets for their erasure: the twelve digits drawn for them and two check digits (ISO/IEC
// 7064, MOD 97-10), as "4821-9037-5512-71". One wrong or swapped digit is noticed. Digits only: every
// keyboard has them, and none looks like another.
#pragma once

#include <string>
#include <string_view>

#include "hal/base/wiped_text.h"
#include "storage/store.h"

namespace relievo::firmware {

std::string receipt_of(const storage::Subject& subject);
ShortWipedText<24> short_receipt_of(const storage::Subject& subject);  // the same, without the heap

// A number for the same person that whoever offers their portrait may know: nobody but this store can make it
// of the code, or the code of it. 32 hexadecimal digits, the same at every time. Thread: the keeper. Errors:
// the store's.
Result<std::string> link_number_of(storage::Store& store, const storage::Subject& subject);

// Whether it is such a code at all. Dashes and spaces between the digits may be others, or none, in a drawn
// one.
bool is_receipt(std::string_view code);
// Thread: the keeper. NotFound: it is no such code, or nobody's; the store's errors.
Result<storage::Subject> find_by_receipt(storage::Store& store, std::string_view code);

}  // namespace relievo::firmware
