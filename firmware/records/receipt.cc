// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/records/receipt.h"

#include <charconv>
#include <cstdio>

namespace relievo::firmware {
namespace {

constexpr std::size_t kDrawnDigits = 12, kCheckDigits = 2;

struct Quoted {
  std::int64_t number = 0;
  bool drawn = false;
};

int check_digits(std::int64_t number) { return static_cast<int>(98 - (number % 97 * 100) % 97); }

std::optional<std::int64_t> number_in(std::string_view digits) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool all = error == std::errc() && end == digits.data() + digits.size() && !digits.starts_with('-');
  return all && number > 0 ? std::optional(number) : std::nullopt;
}

std::optional<std::int64_t> checked(std::string_view number, std::string_view check) {
  const auto value = number_in(number), digits = number_in(check);
  return value && digits && *digits == check_digits(*value) ? value : std::nullopt;
}

std::optional<Quoted> read(std::string_view code) {
  std::string digits;
  for (const char c : code)
    if (c != '-' && c != ' ') digits += c;
  const bool whole =
      !code.empty() && code.front() != '-' && code.back() != '-' && code.front() != ' ' && code.back() != ' ';
  if (whole && digits.size() == kDrawnDigits + kCheckDigits) {
    const auto number = checked(std::string_view(digits).substr(0, kDrawnDigits),
                                std::string_view(digits).substr(kDrawnDigits));
    return number ? std::optional(Quoted{*number, true}) : std::nullopt;
  }
  const std::size_t dash = code.find('-');
  if (dash < 6 || dash > 18 || code.size() != dash + 1 + kCheckDigits) return std::nullopt;
  const auto number = checked(code.substr(0, dash), code.substr(dash + 1));
  return number ? std::optional(Quoted{*number, false}) : std::nullopt;
}

}  // namespace

std::string receipt_of(const storage::Subject& subject) {
  char text[40];
  if (subject.receipt == 0) {
    const auto number = static_cast<std::int64_t>(subject.id);
    std::snprintf(text, sizeof text, "%06lld-%02d", static_cast<long long>(number), check_digits(number));
    return text;
  }
  const auto part = [&](std::int64_t unit) { return static_cast<int>(subject.receipt / unit % 10'000); };
  std::snprintf(text, sizeof text, "%04d-%04d-%04d-%02d", part(100'000'000), part(10'000), part(1),
                check_digits(subject.receipt));
  return text;
}

bool is_receipt(std::string_view code) { return read(code).has_value(); }

Result<storage::Subject> find_by_receipt(storage::Store& store, std::string_view code) {
  const Error none{Errc::NotFound, "this is nobody's code"};
  const auto quoted = read(code);
  if (!quoted) return none;
  if (quoted->drawn) {
    RELIEVO_TRY_ASSIGN(auto found, store.subjects({.limit = 1, .receipt = quoted->number}));
    return found.empty() ? Result<storage::Subject>(none)
                         : Result<storage::Subject>(std::move(found.front()));
  }
  // The numbers of records can be counted: they open only what has nothing better.
  RELIEVO_TRY_ASSIGN(storage::Subject subject, store.subject(storage::SubjectId{quoted->number}));
  if (subject.receipt != 0) return none;
  return subject;
}

}  // namespace relievo::firmware
