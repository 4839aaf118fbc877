#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails when a file includes what its folder may not (README.md, "Who may include whom")."""
import pathlib, re, sys

MAY = {  # folder: the folders it may include besides itself; the longest prefix wins
    "hal/base": [],
    "hal": ["hal/base"],
    "pipeline/model": ["hal/base"],
    "pipeline": ["hal/base", "pipeline/model"],
    "storage": ["hal/base", "hal/clock.h", "pipeline/model"],
    "ui": ["hal/base", "hal/clock.h", "pipeline/model"],
    "firmware": ["hal", "pipeline", "storage", "ui"],
    "tests": ["hal", "pipeline", "storage", "ui", "firmware"],
}
# A library's header may be included only by a file named after the library.
OWNED = {r"opencv2/": "opencv_", r"CGAL/": "cgal_", r"sqlite3\.h": "sqlite_", r"gpiod": "gpiod_",
         r"linux/videodev2\.h": "v4l2_", r"libudev\.h": "udev_", r"systemd/": "systemd_",
         r"png\.h": "png_", r"SDL": "sdl_", r"GLES": "gles_"}
# An implementation may be named only by the one file that chooses it (and by tests).
CHOSEN_BY = {"hal/linux/": "firmware/main.cc", "hal/sim/": "firmware/main.cc",
             "storage/sqlite/": "firmware/main.cc", "ui/platform/": "firmware/main.cc"}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')

def folder_of(path):
    return max((f for f in MAY if path == f or path.startswith(f + "/")), key=len, default=None)

def problems(root):
    for file in sorted(p for t in ("hal", "pipeline", "storage", "ui", "firmware", "tests")
                       for p in (root / t).rglob("*") if p.suffix in (".h", ".cc")):
        here = file.relative_to(root).as_posix()
        home = folder_of(here)
        for number, line in enumerate(file.read_text().splitlines(), 1):
            found = INCLUDE.match(line)
            if not found:
                continue
            quote, target = found.groups()
            if quote == '"':
                to = folder_of(target)
                if to is None or target.startswith("."):
                    yield f"{here}:{number}: {target}: include from the repository root"
                elif to != home and not any(target == m or target.startswith(m + "/") for m in MAY[home]):
                    yield f"{here}:{number}: {home}/ may not include {target}"
            for inside, chooser in CHOSEN_BY.items():
                if target.startswith(inside) and not here.startswith((inside, "tests/")) and here != chooser:
                    yield f"{here}:{number}: only {chooser} may choose {target}"
            for pattern, prefix in OWNED.items():
                if re.match(pattern, target) and not (file.name.startswith(prefix) and file.suffix == ".cc"):
                    yield f"{here}:{number}: {target} only in {prefix}*.cc files"
            if target.startswith("Eigen/") and not (home == "pipeline"):
                yield f"{here}:{number}: Eigen stays inside pipeline/ and out of pipeline/model/"

if __name__ == "__main__":
    found = list(problems(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "includes: all in order")
    sys.exit(bool(found))
