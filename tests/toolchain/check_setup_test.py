#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a small program, leaves one package after the other out of what would be installed, and expects its file to be named."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "toolchain"))
import check_setup  # noqa: E402

MAIN = "#include <gtest/gtest.h>\n#include <sqlite3.h>\nint main() { return sqlite3_libversion_number() == 0; }\n"
BUILD = """
rule compile
  command = g++ -MD -MF $out.d -c $in -o $out
  depfile = $out.d
  deps = gcc
rule link
  command = g++ $in -o $out -lsqlite3 %s
build tests/CMakeFiles/test_small.dir/main.cc.o: compile main.cc
build test_small: link tests/CMakeFiles/test_small.dir/main.cc.o
build all benches: phony test_small
"""
SCRIPT = """#!/usr/bin/env bash
# xgettext would be called here, were this no comment; msgcat
msgmerge() { echo "ninja; ls here"; }
msgfmt=(msgcat "$1")   # a list
sed 's/;xgettext /x/' <<END
msgcat is only read here
END
if ! msgmerge; then LANG=C cmake --version | ninja; fi
case "$1" in
  all) msgconv x ;;
  msgattrib) "$1" ;;
  *) files="$(pkg-config --libs "$(nproc)")" ;;
esac
"""


class CheckSetup(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.build = pathlib.Path(cls.folder.name)
        cls.archive = subprocess.run(["g++", "-print-file-name=libgtest.a"], capture_output=True, text=True).stdout.strip()
        (cls.build / "main.cc").write_text(MAIN)
        (cls.build / "build.ninja").write_text(BUILD % cls.archive)
        subprocess.run(["ninja", "-C", cls.build], check=True, capture_output=True)
        cls.lines = check_setup.commands(cls.build)
        listed = check_setup.output(ROOT / "toolchain/setup", "list").split()
        cls.lacking = check_setup.would_install([package for package in listed if package != "libgtest-dev"])
        cls.whole = cls.lacking | {"libgtest-dev"}

    def assert_lacks(self, package, used, *said):
        """What is used is in order, and without the package there is one finding."""
        self.assertEqual(list(check_setup.problems(used, self.whole, "toolchain/setup")), [])
        found = list(check_setup.problems(used, self.whole - {package}, "toolchain/setup"))
        self.assertEqual(len(found), 1, found)
        for words in (*said, f"belongs to {package}, which toolchain/setup does not install: add {package} to toolchain/setup"):
            self.assertIn(words, found[0])

    def test_a_package_that_was_left_out_would_not_be_installed(self):
        self.assertNotIn("libgtest-dev", self.lacking)
        self.assertLess({"libsqlite3-dev", "libsqlite3-0", "libc6", "git", "bash"}, self.lacking)

    def test_a_header(self):
        used = dict(check_setup.headers(self.build))
        self.assert_lacks("libgtest-dev", used, "/usr/include/gtest/", "included by tests/main.cc")
        self.assert_lacks("libsqlite3-dev", used, "(included by tests/main.cc)")

    def test_a_library_that_is_linked(self):
        used = dict(check_setup.named(self.lines))
        self.assert_lacks("libgtest-dev", used, f"{self.archive} (to make test_small)")
        self.assert_lacks("libsqlite3-dev", used, "/libsqlite3.so (to make test_small)")

    def test_a_library_that_is_loaded(self):
        self.assert_lacks("libsqlite3-0", dict(check_setup.loaded(self.build, self.lines)), "/libsqlite3.so.0 (loaded by test_small)")

    def test_what_the_tests_open_and_run(self):
        record = self.build / "small.opened"
        files = ["/usr/bin/msgfmt", "/usr/share/fonts/opentype/inter/Inter-Regular.otf"]
        record.write_text("\n".join([*files, "/usr/share/gone", "/usr/share", ""]))
        used = dict(check_setup.opened(record))
        self.assertEqual([*used], files)
        self.assert_lacks("gettext", used, "/usr/bin/msgfmt (opened or run by a test)")
        self.assert_lacks("fonts-inter", used, "Inter-Regular.otf (opened or run by a test)")

    def test_a_program_that_a_script_calls(self):
        used = dict(check_setup.called("toolchain/script", SCRIPT))
        self.assertEqual(sorted(pathlib.Path(path).name for path in used), ["cmake", "echo", "msgconv", "ninja", "nproc", "pkg-config", "sed"])
        self.assert_lacks("ninja-build", used, "/usr/bin/ninja (called by toolchain/script)")

    def test_what_no_package_brought_counts_where_machines_have_their_own(self):
        used = {path: "loaded by test_small" for path in ("/usr/local/lib/libx.so", "/opt/x/libx.so", "/home/somebody/libx.so")}
        found = list(check_setup.problems(used, set(), "toolchain/setup"))
        self.assertEqual([line.split()[0] for line in found], ["/usr/local/lib/libx.so", "/opt/x/libx.so"])

    def test_what_the_machine_chose_is_in_order_and_so_is_what_that_needs(self):
        libc = check_setup.output("g++", "-print-file-name=libc.so.6").strip()
        for path in ("/usr/bin/awk", "/etc/debian_version", "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"):
            self.assertEqual(list(check_setup.problems({path: ""}, set(), "")), [])
        self.assertEqual(len(list(check_setup.problems({libc: ""}, set(), ""))), 1)
        self.assertEqual(list(check_setup.problems({libc: "", "/usr/bin/awk": ""}, set(), "")), [])


if __name__ == "__main__":
    unittest.main()
