#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails when a file includes what its folder may not, or when a README or a comment names a file that is not there.

    check_includes.py [ROOT]

The rules, each with one line here and one planted violation in tests/toolchain/check_includes_test.py:
  - a room includes only the rooms in MAY (the table "Who may include whom");
  - a folder includes only folders of lower floors of its room (the table "Floors" in the room's README.md, the
    highest first), so that there is no circle of folders; every folder stands in that table;
  - a library's header appears only in .cc files named after the library (LIBRARIES);
  - a library that has no line here may not be used at all;
  - the folders in CHOSEN_BY are named only by the one file that chooses the implementation;
  - a concrete algorithm's header is included only by pipeline/algorithms/, by .cc files beside it and by tests;
  - a source file that a README or a comment of C++ names, with or without its folders, is there.
"""
import pathlib
import re
import sys

MAY = {  # folder: the folders it may include besides itself; the longest prefix wins
    "hal/base": [],
    "hal": ["hal/base"],
    "pipeline/model": ["hal/base"],
    "pipeline": ["hal/base", "pipeline/model"],
    "storage": ["hal/base", "hal/clock.h", "hal/picture_file.h", "pipeline/model"],
    "ui": ["hal/base", "hal/clock.h", "pipeline/model"],
    "firmware": ["hal", "pipeline", "storage", "ui"],
    "tests": ["hal", "pipeline", "storage", "ui", "firmware"],
}
# A library's header: the prefix of the .cc files that may include it.
LIBRARIES = {
    r"opencv2/": "opencv_",
    r"CGAL/|boost/": "cgal_",
    r"embree3/|embree4/": "embree_",
    r"sqlite3\.h$": "sqlite_",
    r"sodium(\.h$|/)": "sodium_",
    r"argon2\.h$": "argon2_",
    r"tss2/": "tss2_",
    r"gpiod(\.h|\.hpp)$": "gpiod_",
    r"linux/videodev2\.h$": "v4l2_",
    r"libudev\.h$": "udev_",
    r"systemd/": "systemd_",
    r"png\.h$": "png_",
    r"j(peglib|error)\.h$|turbojpeg\.h$": "jpeg_",
    r"zip\.h$": "zip_",
    r"archive(_entry)?\.h$": "archive_",
    r"ZXing/": "zxing_",
    r"cups/": "cups_",
    r"SDL2?/|SDL.*\.h$": "sdl_",
    r"espeak-ng/": "espeak_",
    r"GLES[23]?/|EGL/|KHR/": "gles_",
    r"ft2build\.h$|freetype": "freetype_",
    r"hb.*\.h$|harfbuzz/": "harfbuzz_",
    r"cairo(-[a-z]+)?\.h$": "cairo_",
    r"CLI/": "cli11_",
    r"pango/": "pango_",
    r"libintl\.h$": "gettext_",
    r"toml\+\+/|toml\.hpp$": "toml_",
    r"nlohmann/": "json_",
    r"tiny_gltf\.h$|stb_": "gltf_",
    r"yaml\.h$|yaml-cpp/": "yaml_",
    r"mimalloc": "mimalloc_",
    r"assimp/": "assimp_",
}
TESTS_ONLY = r"gtest/|benchmark/"
# The system's own headers: C's, POSIX's and Linux's. Everything else in angle brackets is a library.
SYSTEM = re.compile(
    r"^[a-z0-9_]+$"                                    # C++: <vector>
    r"|^(errno|fcntl|poll|pthread|sched|signal|spawn|stdint|stdio|stdlib|string|strings|termios|time|unistd"
    r"|dirent|limits|math|glob|fenv|getopt|malloc|pty|ucontext|execinfo)\.h$"
    r"|^sys/[a-z0-9_]+\.h$|^linux/(dma-buf|dma-heap|fs|magic|input|media|uinput|watchdog)\.h$"
    r"|^(imm|x86|arm_neon|xmm|emm|nmm|smm|tmm|pmm|cpuid)[a-z]*\.h$")
# An implementation may be named only by the one file that chooses it (and by tests).
CHOSEN_BY = {
    "hal/linux/": "firmware/main.cc",
    "hal/sim/": "firmware/main.cc",
    "hal/sound/": "firmware/main.cc",
    "storage/sqlite/": "firmware/main.cc",
    "ui/platform/": "firmware/main.cc",
    "firmware/command/": "firmware/main.cc",
    "firmware/demo/": "firmware/main.cc",
}
ALGORITHMS = "pipeline/algorithms/"
ROOMS = ("hal", "pipeline", "storage", "ui", "firmware", "tests")

INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')
CHOSEN = re.compile(r"\balgorithm<&(\w+)::")
STRUCT = re.compile(r"\bstruct\s+(\w+)\s*\{")
NAMED = re.compile(r"(?<![\w./-])((?:[\w-]+/)*[a-z]\w*\.(?:h|cc|py|sql))\b")


def folder_of(path):
    return max((f for f in MAY if path == f or path.startswith(f + "/")), key=len, default=None)


def sources(root):
    for room in ROOMS:
        for path in sorted((root / room).rglob("*")):
            if path.suffix in (".h", ".cc"):
                yield path.relative_to(root).as_posix(), path.read_text(errors="replace")


def concrete_algorithms(files):
    """Headers below pipeline/ that define an algorithm of a table in pipeline/algorithms/."""
    chosen = {name for path, text in files.items() if path.startswith(ALGORITHMS) for name in CHOSEN.findall(text)}
    return {path for path, text in files.items()
            if path.startswith("pipeline/") and path.endswith(".h") and chosen & set(STRUCT.findall(text))}


def library_problem(here, target):
    name, suffix = here.rsplit("/", 1)[-1], here.rsplit(".", 1)[-1]
    if target.startswith("Eigen/"):
        if folder_of(here) == "pipeline" or here.startswith("tests/"):
            return None
        return "Eigen stays inside pipeline/ and out of pipeline/model/"
    if re.match(TESTS_ONLY, target):
        return None if here.startswith("tests/") else f"{target} only in tests/"
    for pattern, prefix in LIBRARIES.items():
        if re.match(pattern, target):
            if name.startswith(prefix) and suffix == "cc":
                return None
            return f"{target} only in {prefix}*.cc files"
    if not SYSTEM.match(target):
        return f"{target} belongs to no library that toolchain/check_includes.py knows"
    return None


def room_problem(here, target):
    home, to = folder_of(here), folder_of(target)
    if to is None or target.startswith("."):
        return f"{target}: include from the repository root"
    if to != home and not any(target == m or target.startswith(m + "/") for m in MAY[home]):
        return f"{home}/ may not include {target}"
    return None


def floors_of(readme):
    """Folder of a room ("." is the room itself): its floor, 0 the highest, as the table "Floors" has them."""
    _, _, section = readme.partition("\n## Floors\n")
    rows = [line for line in section.partition("\n## ")[0].splitlines() if line.startswith("| `")]
    return {folder: floor for floor, row in enumerate(rows) for folder in re.findall(r"`([^`]+)`", row.split("|")[1])}


def floor_problems(root, files):
    for room in ("hal", "pipeline", "storage", "ui", "firmware"):
        readme = root / room / "README.md"
        floors = floors_of(readme.read_text()) if readme.exists() else {}
        within = lambda path: path.rpartition("/")[0][len(room) + 1:] or "."
        folders = {within(path) for path in files if path.startswith(room + "/")}
        yield from (f"{room}/README.md: {folder} stands on no floor of the table Floors" for folder in sorted(folders - set(floors)))
        yield from (f"{room}/README.md: the table Floors has {folder}, which is not there" for folder in sorted(set(floors) - folders))
        for here, text in files.items():
            if not here.startswith(room + "/"):
                continue
            for number, line in enumerate(text.splitlines(), 1):
                found = INCLUDE.match(line)
                if not found or found[1] != '"' or not found[2].startswith(room + "/"):
                    continue
                home, to = within(here), within(found[2])
                if home != to and home in floors and to in floors and floors[home] >= floors[to]:
                    yield f"{here}:{number}: {home} may not include {to}: it does not lie below it (README.md, Floors)"


def name_problems(root, files):
    readmes = {path.relative_to(root).as_posix(): path.read_text() for folder in (*ROOMS, "toolchain", "")
               for path in (root / folder).glob("**/*.md" if folder else "*.md")}
    there = {"/".join(path.parts[i:]) for folder in (*ROOMS, "toolchain")
             for path in (root / folder).rglob("*.*") for i in range(len(path.parts))}
    for here, text in (files | readmes).items():
        for number, line in enumerate(text.splitlines(), 1):
            said = line if here in readmes else line.partition("//")[2]
            yield from (f"{here}:{number}: {name} is not there" for name in NAMED.findall(said) if name not in there)


def problems(root):
    files = dict(sources(root))
    yield from floor_problems(root, files)
    yield from name_problems(root, files)
    concrete = concrete_algorithms(files)
    for here, text in files.items():
        for number, line in enumerate(text.splitlines(), 1):
            found = INCLUDE.match(line)
            if not found:
                continue
            quote, target = found.groups()
            said = [room_problem(here, target) if quote == '"' else library_problem(here, target)]
            for inside, chooser in CHOSEN_BY.items():
                if target.startswith(inside) and not here.startswith((inside, "tests/")) and here != chooser:
                    said.append(f"only {chooser} may choose {target}")
            own = here.endswith(".cc") and here.rpartition("/")[0] == target.rpartition("/")[0]
            if target in concrete and not own and not here.startswith((ALGORITHMS, "tests/")):
                said.append(f"only {ALGORITHMS} may choose {target}")
            yield from (f"{here}:{number}: {what}" for what in said if what)


if __name__ == "__main__":
    found = list(problems(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "includes: all in order")
    sys.exit(bool(found))
