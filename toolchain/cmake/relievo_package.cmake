# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
# pipeline/ as a library for others: `cmake --install BUILD --component library --prefix DIR`, then
# find_package(relievo) and relievo::pipeline. Headers keep their names: #include "pipeline/pipeline.h".
include(CMakePackageConfigHelpers)

set(package_dir lib/cmake/relievo)
set_target_properties(relievo_base PROPERTIES EXPORT_NAME base)
set_target_properties(relievo_pipeline PROPERTIES EXPORT_NAME pipeline)
install(TARGETS relievo_base relievo_pipeline EXPORT relievo ARCHIVE DESTINATION lib COMPONENT library)
install(EXPORT relievo NAMESPACE relievo:: FILE relievoTargets.cmake DESTINATION ${package_dir} COMPONENT library)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/hal/base DESTINATION include/relievo/hal COMPONENT library FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/pipeline DESTINATION include/relievo COMPONENT library
  FILES_MATCHING PATTERN "*.h" PATTERN examples EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSES/GPL-3.0-or-later.txt DESTINATION share/doc/relievo COMPONENT library)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/relievoConfig.cmake.in ${PROJECT_BINARY_DIR}/relievoConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/relievoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/relievoConfig.cmake ${PROJECT_BINARY_DIR}/relievoConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT library)
