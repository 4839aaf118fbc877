# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds for arm64 on another machine: toolchain/arm64 fills the root with Debian's packages and calls cmake with this.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_SYSROOT ${RELIEVO_ARM64_ROOT})
set(CMAKE_FIND_ROOT_PATH ${RELIEVO_ARM64_ROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES RELIEVO_ARM64_ROOT)
# Debian's choice among several BLAS is made when packages are configured, which nobody does in this root.
set(lib ${RELIEVO_ARM64_ROOT}/usr/lib/aarch64-linux-gnu)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-rpath-link,${lib}:${lib}/blas:${lib}/lapack")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static;-L;${RELIEVO_ARM64_ROOT};-E;LD_LIBRARY_PATH=/usr/lib/aarch64-linux-gnu/blas:/usr/lib/aarch64-linux-gnu/lapack)
