#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plants one violation of every include rule into a small tree and expects each to be found."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "toolchain"))
import check_includes  # noqa: E402

FORM = "using Matcher = std::function<int()>;\n"
CONCRETE = '#include "pipeline/match/matcher.h"\nstruct ZmnccMatcher {\n  int match() const;\n};\n'
FLOORS = "# a room\n\n## Floors\n\n| folders |\n| --- |\n{}\n\n## Others\n"


def floors(*rows):
    return FLOORS.format("\n".join("| " + " ".join(f"`{f}`" for f in row.split()) + " |" for row in rows))


GOOD = {
    "hal/README.md": floors("sim", ".", "base"),
    "pipeline/README.md": floors("algorithms", "match", "model"),
    "storage/README.md": floors("sqlite", "."),
    "ui/README.md": floors("view"),
    "firmware/README.md": floors(".", "command", "kiosk staff"),
    "firmware/kiosk/kiosk.h": "",
    "firmware/staff/staff.h": "",
    "hal/base/result.h": "#include <variant>\n#include <string.h>\n",
    "hal/camera.h": '#include "hal/base/result.h"\n',
    "hal/clock.h": "#include <chrono>\n",
    "hal/sim/embree_scene.cc": "#include <embree3/rtcore.h>\n",
    "pipeline/model/match_set.h": '#include "hal/base/result.h"\n',
    "pipeline/match/matcher.h": FORM,
    "pipeline/match/zmncc_matcher.h": CONCRETE,
    "pipeline/match/zmncc_matcher.cc": '#include "pipeline/match/zmncc_matcher.h"\n#include <Eigen/Core>\n',
    "pipeline/match/sgbm_matcher.h": CONCRETE.replace("Zmncc", "Sgbm"),
    "pipeline/match/opencv_sgbm_matcher.cc": '#include "pipeline/match/sgbm_matcher.h"\n#include <opencv2/calib3d.hpp>\n',
    "pipeline/algorithms/match_algorithms.cc":
        '#include "pipeline/match/zmncc_matcher.h"\nalgorithm<&ZmnccMatcher::match>\nalgorithm<&SgbmMatcher::match>\n',
    "storage/store.h": '#include "hal/clock.h"\n#include "pipeline/model/match_set.h"\n',
    "storage/sqlite/sqlite_store.cc": "#include <sqlite3.h>\n",
    "ui/view/view_state.h": '#include "pipeline/model/match_set.h"\n',
    "firmware/main.cc": '#include "hal/sim/device.h"\n#include "storage/sqlite/open.h"\n',
    "firmware/command/cli11_parser.cc": "#include <CLI/CLI.hpp>\n#include <sys/stat.h>\n",
    "tests/pipeline/zmncc_matcher_test.cc": '#include "pipeline/match/zmncc_matcher.h"\n#include <gtest/gtest.h>\n',
}
# file, the line planted at its end, what the finding must say
PLANTED = [
    ("hal/base/result.h", '#include "hal/camera.h"', "hal/base/ may not include"),
    ("storage/store.h", '#include "storage/sqlite/open.h"', ". may not include sqlite"),
    ("firmware/kiosk/kiosk.h", '#include "firmware/staff/staff.h"', "kiosk may not include staff"),
    ("pipeline/match/matcher.h", '#include "pipeline/algorithms/table.h"', "match may not include algorithms"),
    ("hal/camera.h", '#include "pipeline/model/match_set.h"', "hal/ may not include"),
    ("pipeline/model/match_set.h", '#include "pipeline/match/matcher.h"', "pipeline/model/ may not include"),
    ("pipeline/match/zmncc_matcher.cc", '#include "hal/camera.h"', "pipeline/ may not include"),
    ("pipeline/match/zmncc_matcher.cc", '#include "storage/store.h"', "pipeline/ may not include"),
    ("storage/store.h", '#include "hal/camera.h"', "storage/ may not include"),
    ("storage/store.h", '#include "pipeline/match/matcher.h"', "storage/ may not include"),
    ("storage/store.h", '#include "ui/view/view_state.h"', "storage/ may not include"),
    ("ui/view/view_state.h", '#include "firmware/machine/machine.h"', "ui/ may not include"),
    ("ui/view/view_state.h", '#include "storage/store.h"', "ui/ may not include"),
    ("firmware/main.cc", '#include "tests/support/scene.h"', "firmware/ may not include"),
    ("hal/camera.h", '#include "base/result.h"', "repository root"),
    ("hal/camera.h", '#include "../hal/base/result.h"', "repository root"),
    ("firmware/command/cli11_parser.cc", '#include "hal/sim/device.h"', "only firmware/main.cc may choose"),
    ("firmware/command/cli11_parser.cc", '#include "storage/sqlite/open.h"', "only firmware/main.cc may choose"),
    ("firmware/command/cli11_parser.cc", '#include "hal/linux/device.h"', "only firmware/main.cc may choose"),
    ("firmware/command/cli11_parser.cc", '#include "ui/platform/window.h"', "only firmware/main.cc may choose"),
    ("firmware/main.cc", '#include "pipeline/match/zmncc_matcher.h"', "only pipeline/algorithms/ may choose"),
    ("pipeline/match/matcher.h", '#include "pipeline/match/zmncc_matcher.h"', "only pipeline/algorithms/"),
    ("firmware/main.cc", '#include "pipeline/match/sgbm_matcher.h"', "only pipeline/algorithms/ may choose"),
    ("pipeline/model/match_set.h", "#include <Eigen/Core>", "Eigen stays inside"),
    ("storage/store.h", "#include <Eigen/Core>", "Eigen stays inside"),
    ("firmware/main.cc", "#include <gtest/gtest.h>", "only in tests/"),
    ("firmware/main.cc", "#include <benchmark/benchmark.h>", "only in tests/"),
    ("firmware/main.cc", "#include <unheard_of/library.h>", "no library"),
    ("tests/pipeline/zmncc_matcher_test.cc", "#include <gmock/gmock.h>", "no library"),
]
LIBRARY_HEADERS = [
    "yaml.h", "yaml-cpp/yaml.h",
    "opencv2/core.hpp", "CGAL/Point_set_3.h", "boost/graph/graph.hpp", "embree3/rtcore.h", "sqlite3.h", "sodium.h", "ZXing/ReadBarcode.h",
    "gpiod.h", "linux/videodev2.h", "libudev.h", "systemd/sd-daemon.h", "png.h", "jpeglib.h", "zip.h", "SDL2/SDL.h",
    "SDL.h", "GLES3/gl3.h", "EGL/egl.h", "ft2build.h", "hb.h", "cairo.h", "cairo-pdf.h", "CLI/CLI.hpp", "toml++/toml.h", "nlohmann/json.hpp",
    "tiny_gltf.h", "mimalloc.h", "assimp/scene.h",
]


def findings(files):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return list(check_includes.problems(root))


class CheckIncludes(unittest.TestCase):
    def test_a_tree_in_order_has_no_findings(self):
        self.assertEqual(findings(GOOD), [])

    def test_every_planted_violation_is_found_where_it_is(self):
        for file, line, said in PLANTED:
            with self.subTest(file=file, line=line):
                files = dict(GOOD)
                files[file] += line + "\n"
                found = findings(files)
                self.assertTrue(all(one.startswith(f"{file}:{files[file].count(chr(10))}:") for one in found), found)
                self.assertTrue(any(said in one for one in found), found)

    def test_a_folder_without_a_floor_and_a_floor_without_a_folder_are_found(self):
        found = findings(GOOD | {"ui/tree/node.h": ""})
        self.assertEqual(len(found), 1, found)
        self.assertIn("tree stands on no floor", found[0])
        found = findings(GOOD | {"ui/README.md": floors("view", "tree")})
        self.assertEqual(len(found), 1, found)
        self.assertIn("tree, which is not there", found[0])

    def test_a_file_that_is_named_is_there(self):
        files = GOOD | {"README.md": "`hal/camera.h`, `camera.h`\n`gone.cc`\n",
                        "ui/tree.h": "// As camera.h says, and hal/lost.h did.\nint gone = 0;\n"}
        self.assertEqual([one for one in findings(files) if "is not there" in one],
                         ["ui/tree.h:1: hal/lost.h is not there", "README.md:2: gone.cc is not there"])

    def test_only_main_includes_a_command(self):
        found = findings(GOOD | {"firmware/staff/staff.h": '#include "firmware/command/parser.h"\n'})
        self.assertTrue(any("only firmware/main.cc may choose" in one for one in found), found)

    def test_every_library_is_kept_to_its_own_sources(self):
        for header in LIBRARY_HEADERS:
            for file in ("pipeline/match/zmncc_matcher.cc", "hal/camera.h", "tests/pipeline/zmncc_matcher_test.cc"):
                with self.subTest(header=header, file=file):
                    files = dict(GOOD)
                    files[file] += f"#include <{header}>\n"
                    found = findings(files)
                    self.assertEqual(len(found), 1, found)
                    self.assertIn("only in", found[0])

    def test_a_shared_header_named_after_the_library_is_no_excuse(self):
        found = findings(GOOD | {"hal/opencv_tools.h": "#include <opencv2/core.hpp>\n"})
        self.assertEqual(len(found), 1, found)


if __name__ == "__main__":
    unittest.main()
