# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSCHEMA=file -DMIGRATIONS=file;file;... -DOUTPUT=file -P embed_sql.cmake
# Writes the .sql files into one .cc, each as a raw string.
set(number 0)
set(list "")
foreach(file ${MIGRATIONS})
  math(EXPR number "${number} + 1")
  get_filename_component(name ${file} NAME)
  string(REGEX MATCH "^[0-9]+" prefix ${name})
  math(EXPR found "1${prefix} - 10000")
  if(NOT prefix MATCHES "^[0-9][0-9][0-9][0-9]$" OR NOT found EQUAL number)
    message(FATAL_ERROR "${name}: migrations are numbered 0001, 0002, ... without a gap")
  endif()
  file(READ ${file} text)
  string(APPEND list "    R\"sql(${text})sql\",\n")
endforeach()
file(READ ${SCHEMA} schema)
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
// Made from storage/schema/*.sql: do not edit.
#include "storage/schema/embedded_sql.h"

namespace relievo::storage {
namespace {
constexpr std::string_view kSchema = R"sql(@schema@)sql";
constexpr std::string_view kMigrations[] = {
@list@};
}  // namespace
std::string_view schema_sql() { return kSchema; }
std::span<const std::string_view> migrations() { return kMigrations; }
}  // namespace relievo::storage
]])
