# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
# What every room is built with.

set(RELIEVO_SANITIZE "" CACHE STRING "address,undefined or thread; empty for none")
set(RELIEVO_COVERAGE "" CACHE STRING "the rooms' folders whose lines gcov counts, hal;storage; empty for none")

add_library(relievo_options INTERFACE)
target_include_directories(relievo_options INTERFACE ${CMAKE_SOURCE_DIR})
# What the packages of SDL and Pango ask for who includes them: all alike can share precompiled headers.
target_compile_definitions(relievo_options INTERFACE _REENTRANT)
target_compile_options(relievo_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-pthread>)
target_compile_options(relievo_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wswitch-enum -Werror
  # g++ 12 sees overlapping copies in "a" + std::string that are not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # The inner loops are written to vectorise; none of them asks for errno or traps.
  -fno-math-errno -fno-trapping-math)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Products are rounded before they are added, as on x86-64: the same results (toolchain/arm64). And g++ 12 tells of
  # every function whose arguments g++ 9 passed in another way.
  target_compile_options(relievo_options INTERFACE -ffp-contract=off -Wno-psabi)
endif()
if(RELIEVO_SANITIZE)
  target_compile_options(relievo_options INTERFACE -fsanitize=${RELIEVO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  # What these find address finds, too, when the memory is touched; they are a third of the time to build and to run.
  target_compile_options(relievo_options INTERFACE -fno-sanitize=null,vptr,object-size
    # These two only where bytes are read as numbers: in Eigen's and CGAL's templates they are half of the code.
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:RELIEVO_READS_BYTES>>>:-fno-sanitize=alignment,pointer-overflow>)
  target_link_options(relievo_options INTERFACE -fsanitize=${RELIEVO_SANITIZE})
  target_compile_definitions(relievo_options INTERFACE RELIEVO_SANITIZED=1)
endif()
if(RELIEVO_COVERAGE)
  # -O1: lines stay apart, and the rooms that are not counted are what ships.
  target_compile_options(relievo_options INTERFACE $<$<BOOL:$<TARGET_PROPERTY:RELIEVO_COUNTED>>:--coverage;-O1>)
  target_link_options(relievo_options INTERFACE --coverage)
endif()

# relievo_precompile(TARGET OWNER [HEADERS...]): parsing library headers is most of what a small file costs. OWNER, a target,
# reads the standard library's and HEADERS once; others are given its result. Where lines are counted, they are compiled
# in different ways: each reads its own. The preset tidy does without: there a file that forgets an include is found.
option(RELIEVO_PRECOMPILE "read library headers once for many targets" ON)
function(relievo_precompile target owner)
  if(NOT RELIEVO_PRECOMPILE)
    return()
  endif()
  if(target STREQUAL owner OR RELIEVO_COVERAGE)
    target_precompile_headers(${target} PRIVATE ${CMAKE_SOURCE_DIR}/toolchain/cmake/standard_headers.h ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
  # g++ 12 warns of std::string in a precompiled header what it does not where the same header is read as text (as -Wno-restrict above).
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overread;-Wno-stringop-overflow>)
endfunction()

# relievo_together(TARGET SOURCES... [ALONE regexes...]): up to eight files of one folder are compiled as one: half of what
# a small file costs is reading headers, and an edit still compiles a few seconds' worth. So the files of a folder may not
# have private names in common; of tests all that lies in tests/ROOM/FOLDER is one folder. ALONE: files that are compiled
# by themselves: those that take seconds, and those that have private names in common with another file of their folder.
# The preset tidy does without: it finds a file that forgets an include.
option(RELIEVO_UNITY "compile the files of a folder together" OFF)
function(relievo_together target)
  if(NOT RELIEVO_UNITY)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ALONE")
  set(sources ${arg_UNPARSED_ARGUMENTS})
  foreach(pattern ${arg_ALONE})
    list(FILTER sources EXCLUDE REGEX ${pattern})
  endforeach()
  set(parts)
  foreach(source ${sources})
    cmake_path(NORMAL_PATH source)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
    cmake_path(GET source PARENT_PATH folder)
    string(REGEX REPLACE "^(tests/[^/]+/[^/]+)/.*" "\\1" folder ${folder})
    string(MAKE_C_IDENTIFIER ${folder} folder)
    list(APPEND in_${folder} ${source})
    list(LENGTH in_${folder} count)
    math(EXPR part "(${count} - 1) / 8")
    list(APPEND parts ${folder}_${part})
    string(APPEND text_of_${folder}_${part} "#include \"${source}\"\n")
  endforeach()
  list(REMOVE_DUPLICATES parts)
  foreach(part ${parts})
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/together/${part}.cc CONTENT "${text_of_${part}}" @ONLY)
    target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/together/${part}.cc)
  endforeach()
  set_source_files_properties(${sources} PROPERTIES HEADER_FILE_ONLY ON)
  # g++ 12 warns of a class that has a private one in it unless it stands in the file that is compiled.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# relievo_room(NAME [READS_BYTES] [DIRS sub/folders...] [LIBS private libraries...] [ROOMS rooms it may use...]
#              [PRECOMPILE target, headers of libraries...] [ALONE regexes...])
# One static library from every .cc below the folders named (default: all of the current folder). READS_BYTES: it takes
# numbers out of bytes that come from outside, and is sanitized for alignment, too. PRECOMPILE: relievo_precompile's
# arguments (default: relievo_base, whose headers are the standard library's).
function(relievo_room name)
  cmake_parse_arguments(arg "READS_BYTES" "" "DIRS;EXCLUDE;LIBS;ROOMS;PRECOMPILE;ALONE" ${ARGN})
  if(NOT arg_DIRS)
    set(arg_DIRS .)
  endif()
  if(NOT arg_PRECOMPILE)
    set(arg_PRECOMPILE relievo_base)
  endif()
  set(sources)
  foreach(dir ${arg_DIRS})
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${dir}/*.cc)
    list(APPEND sources ${found})
  endforeach()
  foreach(pattern ${arg_EXCLUDE})
    list(FILTER sources EXCLUDE REGEX ${pattern})
  endforeach()
  add_library(relievo_${name} STATIC ${sources})
  relievo_together(relievo_${name} ${sources} ALONE ${arg_ALONE})
  set_target_properties(relievo_${name} PROPERTIES LINKER_LANGUAGE CXX RELIEVO_READS_BYTES "${arg_READS_BYTES}")
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME folder)
  if(folder IN_LIST RELIEVO_COVERAGE)
    set_target_properties(relievo_${name} PROPERTIES RELIEVO_COUNTED ON)
  endif()
  # Who uses an installed room gets its headers, not our warnings.
  target_link_libraries(relievo_${name} PUBLIC $<BUILD_INTERFACE:relievo_options> ${arg_ROOMS} PRIVATE ${arg_LIBS})
  relievo_precompile(relievo_${name} ${arg_PRECOMPILE})
  target_include_directories(relievo_${name} INTERFACE $<INSTALL_INTERFACE:include/relievo>)
  target_compile_features(relievo_${name} PUBLIC cxx_std_20)
endfunction()

# relievo_test_options(TARGET): how what only tests is compiled.
function(relievo_test_options target)
  # What is measured lies in the rooms; a test itself is compiled in half the time.
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  relievo_precompile(${target} test_support <gtest/gtest.h>)
  if(RELIEVO_SANITIZE)
    # g++ 12 warns of sanitized std::string what it does not of the build that ships, where these hold. What a sanitizer
    # finds lies in the rooms: a fifth of the time to build a test is the lines of its own that a report would name, a
    # quarter is looking at its own temporaries after their end, and checks that are written out where a call does.
    target_compile_options(${target} PRIVATE -g0 $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-maybe-uninitialized>)
    if(RELIEVO_SANITIZE MATCHES address)
      target_compile_options(${target} PRIVATE -fno-sanitize-address-use-after-scope
        $<$<CXX_COMPILER_ID:GNU>:SHELL:--param asan-instrumentation-with-call-threshold=0>)
    endif()
  endif()
endfunction()

# relievo_tests(NAME LIBS... [ALONE regexes...]): one GoogleTest program from every *_test.cc below the current folder.
function(relievo_tests name)
  cmake_parse_arguments(arg "" "" "ALONE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cc)
  add_executable(test_${name} ${sources})
  relievo_together(test_${name} ${sources} ALONE ${arg_ALONE})
  target_link_libraries(test_${name} PRIVATE relievo_options ${arg_UNPARSED_ARGUMENTS} GTest::gtest_main)
  if(name IN_LIST RELIEVO_COVERAGE)  # what a header has in it is compiled here
    set_target_properties(test_${name} PROPERTIES RELIEVO_COUNTED ON)
  endif()
  relievo_test_options(test_${name})
  relievo_discover(test_${name} ${name})
endfunction()

# relievo_discover(TARGET ROOM): the tests of a program, for ctest. Starting it costs more than most tests do: it is started
# sixteen times (ROOM.0 to ROOM.15), and runs every sixteenth of its tests each time. The address sanitizer's are without
# those of tests/not_sanitized.txt.
set(not_sanitized ${CMAKE_SOURCE_DIR}/tests/not_sanitized.txt)
function(relievo_discover target room)
  set(filter "*-")
  set(timeout 1800)
  if(RELIEVO_SANITIZE MATCHES address)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${not_sanitized})
    file(STRINGS ${not_sanitized} lines REGEX "^${room} ")
    list(TRANSFORM lines REPLACE "^${room} " "")
    list(JOIN lines ":" lines)
    string(APPEND filter ${lines})
  elseif(RELIEVO_SANITIZE)
    set(timeout 7200)
  endif()
  foreach(shard RANGE 15)
    add_test(NAME ${room}.${shard} COMMAND ${target} --gtest_filter=${filter})
    set_tests_properties(${room}.${shard} PROPERTIES TIMEOUT ${timeout}
      ENVIRONMENT "GTEST_TOTAL_SHARDS=16;GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()
