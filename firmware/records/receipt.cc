// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/records/receipt.h"

#include <string.h>

#include <cstdio>
#include <span>

#include "firmware/records/bundle_manifest.h"

namespace relievo::firmware {
namespace {

constexpr std::size_t kCodeDigits = 12 + 2;  // drawn, and to check them

int check_digits(std::int64_t number) { return int(98 - (number % 97 * 100) % 97); }

std::optional<std::int64_t> read(std::string_view code) {
  const auto between = [](char c) { return c == '-' || c == ' '; };
  if (code.empty() || between(code.front()) || between(code.back())) return std::nullopt;
  std::string digits;
  for (const char c : code)
    if (!between(c)) digits += c;
  if (digits.size() != kCodeDigits || digits.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  const std::int64_t all = std::stoll(digits), number = all / 100;
  return number > 0 && all % 100 == check_digits(number) ? std::optional(number) : std::nullopt;
}

}  // namespace

ShortWipedText<24> short_receipt_of(const storage::Subject& subject) {
  char text[40];
  const auto part = [&](std::int64_t unit) { return int(subject.receipt / unit % 10'000); };
  std::snprintf(text, sizeof text, "%04d-%04d-%04d-%02d", part(100'000'000), part(10'000), part(1),
                check_digits(subject.receipt));
  ShortWipedText<24> receipt;
  receipt = std::string_view(text);
  explicit_bzero(text, sizeof text);
  return receipt;
}

std::string receipt_of(const storage::Subject& subject) {
  return std::string(short_receipt_of(subject).view());
}

// A signature is a function that needs the store's secret key. A hash alone would be undone by trying all
// codes.
Result<std::string> link_number_of(storage::Store& store, const storage::Subject& subject) {
  constexpr std::size_t kDigits = 32;
  const std::string of = "link " + receipt_of(subject);
  RELIEVO_TRY_ASSIGN(const auto made, store.sign(std::as_bytes(std::span(of))));
  return text_of(storage::sha256(made.signature)).substr(0, kDigits);
}

bool is_receipt(std::string_view code) { return read(code).has_value(); }

Result<storage::Subject> find_by_receipt(storage::Store& store, std::string_view code) {
  const Error none{Errc::NotFound, "this is nobody's code"};
  const auto number = read(code);
  if (!number) return none;
  RELIEVO_TRY_ASSIGN(auto found, store.subjects({.limit = 1, .receipt = *number}));
  return found.empty() ? Result<storage::Subject>(none) : Result<storage::Subject>(std::move(found.front()));
}

}  // namespace relievo::firmware
