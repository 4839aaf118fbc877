// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/core_dumps.h"

#include <sys/prctl.h>
#include <sys/resource.h>

#include <cerrno>

namespace relievo::firmware {

Result<void> forbid_core_dumps(bool measures_itself) {
  const rlimit none{0, 0};
  if (setrlimit(RLIMIT_CORE, &none) != 0 || (!measures_itself && prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0))
    return Error{Errc::IoFailed, "core dumps cannot be switched off: faces and keys would be in them", errno};
  return {};
}

}  // namespace relievo::firmware
