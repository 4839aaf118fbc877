// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/file/number_table.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace relievo::pipeline {
namespace {

constexpr std::size_t kBytesPerRow = 128;  // more on the average is no table of numbers

constexpr std::string_view kBetween = ",; \t\r";

std::string line_of(const std::string& path, std::uint32_t line) {
  return path + ", line " + std::to_string(line);
}

// The next number of the line, taken off its front; false where there is none.
bool take_number(std::string_view& line, double& value) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return false;
  line.remove_prefix(begin);
  if (line.front() == '+') line.remove_prefix(1);
  const auto read = std::from_chars(line.data(), line.data() + line.size(), value);
  if (read.ec != std::errc{} || !std::isfinite(value)) return false;
  line.remove_prefix(static_cast<std::size_t>(read.ptr - line.data()));
  if (!line.empty() && kBetween.find(line.front()) == std::string_view::npos) return false;
  const std::size_t blank = line.find_first_not_of(" \t\r");
  line.remove_prefix(blank == std::string_view::npos ? line.size() : blank);
  if (!line.empty() && (line.front() == ',' || line.front() == ';')) line.remove_prefix(1);
  return true;
}

bool is_title(std::string_view line) {
  return std::all_of(line.begin(), line.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           kBetween.find(static_cast<char>(c)) != std::string_view::npos;
  });
}

struct File {
  int descriptor;
  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

Error failed(Literal what, const std::string& path) {
  Error error{errno == ENOENT ? Errc::NotFound : Errc::IoFailed, what};
  error.sys_errno = errno;
  return error.at(path);
}

}  // namespace

std::string NumberTable::place(std::size_t row) const { return line_of(path_, lines_[row]); }

Result<NumberTable> parse_number_table(std::string_view text, std::string path, std::size_t columns,
                                       std::size_t most_rows, std::pmr::memory_resource* memory) {
  NumberTable table(std::move(path), columns, memory);
  const auto most_lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  const std::size_t room = std::min(most_lines, most_rows);
  table.lines_.reserve(room);
  table.values_.reserve(room * columns);
  std::uint32_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end + 1));
    ++number;
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    if (table.lines_.empty() && is_title(line)) continue;
    if (table.rows() == most_rows)
      return Error{Errc::InvalidInput, "there are more lines than can be used; give fewer"}.at(
          line_of(table.path_, number));
    for (std::size_t k = 0; k < columns; ++k) {
      double value = 0;
      if (!take_number(line, value))
        return Error{Errc::InvalidInput, "is not a line of numbers with commas or blanks between them"}.at(
            line_of(table.path_, number));
      table.values_.push_back(value);
    }
    table.lines_.push_back(number);
  }
  if (table.rows() == 0) return Error{Errc::InvalidInput, "holds no line of numbers"}.at(table.path_);
  return table;
}

Result<NumberTable> read_number_table(const std::string& path, std::size_t columns, std::size_t most_rows,
                                      Arena& memory) {
  const File in{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (in.descriptor < 0) return failed("cannot be opened; check the name", path);
  struct stat status {};
  if (::fstat(in.descriptor, &status) != 0) return failed("cannot be read", path);
  if (!S_ISREG(status.st_mode))
    return Error{Errc::InvalidInput, "is no file; give a text file of numbers"}.at(path);
  if (static_cast<std::size_t>(status.st_size) > most_rows * kBytesPerRow)
    return Error{Errc::InvalidInput, "is too large for a table of numbers"}.at(path);
  std::pmr::vector<char> text(static_cast<std::size_t>(status.st_size), &memory);
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t got = ::read(in.descriptor, text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return failed("cannot be read", path);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  return parse_number_table({text.data(), size}, path, columns, most_rows, &memory);
}

}  // namespace relievo::pipeline
