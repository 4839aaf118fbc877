// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/budget.h"
#include "firmware/command/commands.h"
#include "firmware/records/receipt.h"
#include "storage/record.h"
#include "storage/text.h"

namespace relievo::firmware {
namespace {

// Whom the store takes, the session takes: nobody is refused once the cameras are open.
static_assert(budget::kSubjectNameBytes == storage::kMaxNameBytes);

std::optional<storage::SubjectId> number_in(std::string_view text) {
  if (text.size() < 2 || text.front() != '#') return std::nullopt;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return storage::SubjectId{number};
}

Result<std::vector<storage::Subject>> of_name(storage::Store& store, std::string_view name) {
  RELIEVO_TRY_ASSIGN(auto found, store.subjects({std::string(name), 0, 2}));
  if (found.size() > 1) {
    return Error{Errc::InvalidInput,
                 "several have this name: use the number, as in '#3' ('relievo subjects list' shows it)"}
        .at(name);
  }
  return found;
}

}  // namespace

Result<storage::Subject> find_subject(storage::Store& store, std::string_view name_or_number) {
  if (const auto id = number_in(name_or_number)) return store.subject(*id);
  if (is_receipt(name_or_number)) return find_by_receipt(store, name_or_number);
  RELIEVO_TRY_ASSIGN(const auto found, of_name(store, name_or_number));
  if (found.empty()) return Error{Errc::NotFound, "nobody of this name is in the store"}.at(name_or_number);
  return found.front();
}

Result<void> check_subject(std::string_view name_or_number) {
  if (storage::is_name(name_or_number)) return {};
  return Error{Errc::InvalidInput,
               "no possible name: give 1 to 200 bytes of UTF-8 without control characters"}
      .at("--subject");
}

Result<std::optional<storage::SubjectId>> choose_subject(storage::Store& store,
                                                         std::string_view name_or_number) {
  if (const auto id = number_in(name_or_number)) {
    RELIEVO_TRY_ASSIGN(const auto known, store.subject(*id));
    return std::optional(known.id);
  }
  // Whoever types a code means its owner: as a name it would stand readable in every list.
  if (is_receipt(name_or_number)) {
    RELIEVO_TRY_ASSIGN(const auto known, find_by_receipt(store, name_or_number));
    return std::optional(known.id);
  }
  RELIEVO_TRY_ASSIGN(const auto found, of_name(store, name_or_number));
  return found.empty() ? std::nullopt : std::optional(found.front().id);
}

}  // namespace relievo::firmware
