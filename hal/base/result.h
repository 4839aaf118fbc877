// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Result<T>: a value, or the reason there is none.
//
// A subset of C++23's std::expected under the same names, so that a later compiler can replace it
// with an alias. Unlike std::expected, the type itself is [[nodiscard]]: dropping a Result on the
// floor does not compile.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>

namespace relievo {

// What went wrong, as far as anyone can act on it.
enum class Errc : std::uint8_t {
  InvalidInput,  // a file, a picture, a number or a name that cannot be used
  NotFound,      // it is not there
  Timeout,
  Disconnected,
  NotCalibrated,
  NoFace,
  TooFewMatches,
  PoorGeometry,
  LibraryFailed,
  OutOfMemory,
  MediaMissing,
  MediaFull,
  StoreCorrupt,
  StoreNewer,
  IoFailed,
  Cancelled,
  InvalidState,
  Unsupported,
  Count
};

// A message that is certainly a literal, so an Error never owns memory.
class Literal {
 public:
  consteval Literal(const char* text) : text_(text) {}  // NOLINT(google-explicit-constructor)
  constexpr std::string_view view() const { return text_; }

 private:
  std::string_view text_;
};

// `what` says what happened and what to do; `where` (a path, a name, a number; cut to fit, held
// inline) says to what. One line for people: "where: what".
struct Error {
  Errc code;
  Literal what;
  int sys_errno = 0;
  std::array<char, 192> where_text{};

  std::string_view where() const { return {where_text.data()}; }
  // Keeps the end of an overlong text: of a path, the end tells more.
  Error at(std::string_view place) const {
    Error copy = *this;
    const std::size_t room = copy.where_text.size() - 1;
    if (place.size() > room) place.remove_prefix(place.size() - room);
    place.copy(copy.where_text.data(), place.size());
    copy.where_text[place.size()] = '\0';
    return copy;
  }
};
constexpr Error invalid(Literal what) { return {Errc::InvalidInput, what}; }

template <typename T>
class [[nodiscard]] Result {
 public:
  // Implicit on purpose, as std::expected: `return value;` and `return Error{…};`.
  Result(T value)  // NOLINT(google-explicit-constructor)
      : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, error) {}  // NOLINT(google-explicit-constructor)

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  T& operator*() & { return *std::get_if<0>(&state_); }
  const T& operator*() const& { return *std::get_if<0>(&state_); }
  T&& operator*() && { return std::move(*std::get_if<0>(&state_)); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }

  const Error& error() const { return *std::get_if<1>(&state_); }
  // Its error, if it is one, at this place.
  Result at(std::string_view place) && { return has_value() ? std::move(*this) : error().at(place); }

 private:
  std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() : state_(std::in_place_index<0>) {}
  Result(Error error) : state_(std::in_place_index<1>, error) {}  // NOLINT(google-explicit-constructor)

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  const Error& error() const { return *std::get_if<1>(&state_); }
  Result at(std::string_view place) && { return has_value() ? std::move(*this) : error().at(place); }

 private:
  std::variant<std::monostate, Error> state_;
};

}  // namespace relievo

// The two macros of the code base: hand the error to the caller, unchanged.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define RELIEVO_TRY(expression)                                                             \
  do {                                                                                      \
    if (auto relievo_result = (expression); !relievo_result) return relievo_result.error(); \
  } while (false)

#define RELIEVO_JOIN_(a, b) a##b
#define RELIEVO_JOIN(a, b) RELIEVO_JOIN_(a, b)
#define RELIEVO_TRY_ASSIGN(declaration, expression) \
  RELIEVO_TRY_ASSIGN_(RELIEVO_JOIN(relievo_result_, __LINE__), declaration, expression)
#define RELIEVO_TRY_ASSIGN_(result, declaration, expression) \
  auto result = (expression);                                \
  if (!result) return result.error();                        \
  declaration = *std::move(result)
// NOLINTEND(bugprone-macro-parentheses)
