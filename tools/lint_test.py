#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/lint finds what it promises to find, and nothing in a clean file."""
import importlib.machinery
import importlib.util
import pathlib
import shutil
import sys
import tempfile
import unittest

import header_lines

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent


def load(name):
    loader = importlib.machinery.SourceFileLoader(name, str(HERE / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


lint = load("lint")

TABLE = """
| level | folder | answers | only here |
|---|---|---|---|
| 0 | include/oriel | headers | |
| 0 | src/base | basics | |
| 2 | src/image | pixels | OpenImageIO, png |
| 3 | src/geom | hits | embree3 |
| 5 | src/shaders | shaders | |
| 5 | src/transport | light | |
"""
HEAD = "// " + lint.SPDX + "\n#pragma once\n"


def messages(path, text, known=()):
    house = lint.House(TABLE)
    return [finding.message for finding in lint.check(path, text, house, set(known).__contains__)]


class Levels(unittest.TestCase):
    def test_downward_include_is_clean(self):
        self.assertEqual([], messages("src/geom/a.h", HEAD + '#include "base/vec.h"\n'))

    def test_include_within_a_folder_is_clean(self):
        self.assertEqual([], messages("src/shaders/architectural/a.h",
                                      HEAD + '#include "shaders/base/b.h"\n'))

    def test_upward_include_is_found(self):
        found = messages("src/base/a.h", HEAD + '#include "geom/mesh.h"\n')
        self.assertEqual(1, len(found))
        self.assertIn("downward only", found[0])

    def test_folders_of_one_level_do_not_see_each_other(self):
        self.assertEqual(1, len(messages("src/shaders/a.h", HEAD + '#include "transport/b.h"\n')))

    def test_angle_brackets_are_seen_through(self):
        self.assertEqual(1, len(messages("src/base/a.h", HEAD + "# include <geom/mesh.h>\n")))

    def test_installed_headers_are_on_the_ground(self):
        self.assertEqual([], messages("src/geom/a.h", HEAD + "#include <oriel/shader.h>\n"))
        self.assertEqual(1, len(messages("include/oriel/a.h", HEAD + '#include "geom/mesh.h"\n')))

    def test_tests_may_use_everything(self):
        text = "// " + lint.SPDX + '\n#include "transport/b.h"\n#include <embree3/rtcore.h>\n'
        self.assertEqual([], messages("tests/render/a_test.cpp", text))

    def test_a_library_stays_in_its_folder(self):
        self.assertEqual([], messages("src/geom/a.cpp", HEAD + "#include <embree3/rtcore.h>\n"))
        self.assertEqual(1, len(messages("src/transport/a.cpp",
                                         HEAD + "#include <embree3/rtcore.h>\n")))
        self.assertEqual(1, len(messages("src/base/a.h", HEAD + "#include <png.h>\n")))

    def test_a_page_without_a_table_is_an_error(self):
        with self.assertRaises(ValueError):
            lint.House("# Architecture\n")

    def test_the_project_has_a_level_for_every_folder_of_src(self):
        house = lint.House((HERE.parent / "docs/dev/architecture.md").read_text(encoding="utf-8"))
        for folder in (HERE.parent / "src").iterdir():
            if folder.is_dir():
                self.assertIn(f"src/{folder.name}", house.levels)


class Files(unittest.TestCase):
    def test_missing_spdx_line_is_found(self):
        self.assertEqual(["no SPDX line at the top"], messages("src/base/a.h", "#pragma once\n"))

    def test_scripts_need_the_spdx_line_too(self):
        self.assertEqual(1, len(messages("tools/run", "#!/bin/sh\n")))
        self.assertEqual(1, len(messages("src/CMakeLists.txt", "add_subdirectory(base)\n")))

    def test_text_and_scenes_are_left_alone(self):
        self.assertEqual([], messages("docs/page.md", "# Page\n"))
        self.assertEqual([], messages("scenes/a.mi", "verbose on\n"))

    def test_500_lines_pass_and_501_do_not(self):
        def source(lines):
            return "// " + lint.SPDX + "\n" + "int a();\n" * (lines - 1)
        self.assertEqual([], messages("src/base/a.cpp", source(500)))
        self.assertEqual(1, len(messages("src/base/a.cpp", source(501))))
        self.assertEqual([], messages("src/base/albedo_table.cpp", source(501)))

    def test_words_that_promise_are_found(self):
        for word in ("TO" "DO", "FIX" "ME", "XX" "X"):
            self.assertEqual(1, len(messages("src/base/a.h", HEAD + f"// {word} later\n")))
        self.assertEqual([], messages("src/base/a.h", HEAD + 'const char* t = "/tmp/XXXXXX";\n'))


    def test_functions_of_the_c_library_that_depend_on_the_processor_are_found(self):
        text = HEAD + "float f(float x) { return std::%s(x); }\n"
        for function in ("sin", "atan2", "pow", "exp2", "log1p", "acos"):
            self.assertEqual(1, len(messages("src/sky/a.h", text % function)), function)
            self.assertEqual([], messages("src/sky/a_test.cpp", text % function))
        for function in ("sqrt", "floor", "abs", "logical_not<>{}"):
            self.assertEqual([], messages("src/sky/a.h", text % function), function)


class Headers(unittest.TestCase):
    def test_heavy_includes_are_found_in_headers_only(self):
        for header in ("regex", "iostream", "nlohmann/json.hpp", "x86intrin.h"):
            text = HEAD + f"#include <{header}>\n"
            self.assertEqual(1, len(messages("src/sky/a.h", text)), header)
            self.assertEqual([], messages("src/sky/b.cpp", text))
        self.assertEqual([], messages("src/sky/a.h", HEAD + "#include <nlohmann/json_fwd.hpp>\n"))

    @unittest.skipUnless(shutil.which("g++"), "no compiler")
    def test_lines_that_a_header_reads_are_counted_once(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder, "src/base")
            source.mkdir(parents=True)
            (source / "a.h").write_text("#pragma once\n#include <vector>\n")
            (source / "b.h").write_text('#pragma once\n#include <vector>\n#include "base/a.h"\n')
            (source / "c.h").write_text("#pragma once\nint c();\n")
            costs = header_lines.measure(folder)
        self.assertEqual(costs["src/base/c.h"], 2)
        self.assertGreater(costs["src/base/a.h"], 5000)
        self.assertEqual(costs["src/base/b.h"], costs["src/base/a.h"] + 3)

    def test_headers_past_the_budget_are_found(self):
        most = lint.MAX_LINES_READ
        found = list(lint.check_lines_read({"src/sky/a.h": most + 1, "src/sky/b.h": most,
                                            "src/models/read_model.h": most + 1}))
        self.assertEqual([f.path for f in found], ["src/sky/a.h"])

    def test_header_without_guard_is_found(self):
        found = messages("src/base/a.h", "// " + lint.SPDX + "\nint a();\n")
        self.assertEqual(["header without #pragma once"], found)

    def test_c_guard_is_a_guard(self):
        text = "/* " + lint.SPDX + " */\n#ifndef ORIEL_SHADER_H\n#define ORIEL_SHADER_H\n#endif\n"
        self.assertEqual([], messages("include/oriel/shader.h", text))

    def test_using_namespace_is_found_at_the_margin_only(self):
        self.assertEqual(1, len(messages("src/base/a.h", HEAD + "using namespace std;\n")))
        inside = HEAD + "inline void f() {\n  using namespace std;\n}\n"
        self.assertEqual([], messages("src/base/a.h", inside))

    def test_own_header_comes_first(self):
        late = "// " + lint.SPDX + '\n#include <vector>\n\n#include "base/a.h"\n'
        self.assertEqual(1, len(messages("src/base/a.cpp", late, ["src/base/a.h"])))
        self.assertEqual(1, len(messages("src/base/a_test.cpp", late, ["src/base/a.h"])))
        first = "// " + lint.SPDX + '\n#include "base/a.h"\n\n#include <vector>\n'
        self.assertEqual([], messages("src/base/a.cpp", first, ["src/base/a.h"]))
        self.assertEqual([], messages("src/base/main.cpp", late, ["src/base/a.h"]))


class Phrases(unittest.TestCase):
    def phrases(self, path, text):
        return [message for message in messages(path, text) if "is unclear" in message]

    def test_unclear_phrases_are_found_in_every_kind_of_text(self):
        self.assertEqual(1, len(self.phrases("src/base/a.h", HEAD + "// 16 unless said\n")))
        self.assertEqual(1, len(self.phrases("src/base/a.cpp", HEAD + 'auto a = "told of it";\n')))
        self.assertEqual(1, len(self.phrases("tools/run", "#!/bin/sh\n# a fault gone round\n")))
        self.assertEqual(1, len(self.phrases("docs/page.md", "# Page\nOptions nobody here knows\n")))
        self.assertEqual(1, len(self.phrases("scenes/a.mi", "# filtered as pictures have it\n")))

    def test_each_phrase_is_found_in_any_case(self):
        for phrase in ("Gone round", "goes round", "unless told", "is told", "are told", "nobody knows",
                       "comes to stand", "coming to stand", "What becomes of", "asked without",
                       "knows nothing", "says so", "as they stand", "gives way", "stand in for"):
            self.assertEqual(1, len(self.phrases("a.md", f"It {phrase} here.\n")), phrase)

    def test_words_that_contain_a_phrase_are_clean(self):
        for text in ("this told", "stands information", "becomes often", "goes rounder", "ToldOf"):
            self.assertEqual([], self.phrases("a.md", text + "\n"), text)

    def test_phrases_across_lines_are_found_at_their_first_line(self):
        house = lint.House(TABLE)
        text = HEAD + "// A message that is\n/// told later.\n"
        found = [f for f in lint.check("src/base/a.h", text, house, set().__contains__)]
        self.assertEqual([("src/base/a.h", 3)], [(f.path, f.line) for f in found])

    def test_phrases_of_pages_are_found_in_pages_only(self):
        self.assertEqual(1, len(self.phrases("docs/page.md", "A glowing mesh\n")))
        self.assertEqual([], self.phrases("src/base/a.h", HEAD + "// A glowing mesh\n"))

    def test_texts_of_the_program_in_pages_are_left_to_the_code(self):
        table = "<!-- table mia_material -->\nWhatever it is\n<!-- end -->\n"
        self.assertEqual([], self.phrases("docs/shaders/a.md", table))
        self.assertEqual(1, len(self.phrases("docs/shaders/a.md", table + "Whatever it is\n")))
        self.assertEqual([], self.phrases("docs/guide/a.md", "```text\nWhatever it is\n```\n"))
        self.assertEqual([], self.phrases("docs/reference/a.md", "Whatever it is\n"))

    def test_licences_and_foreign_scenes_are_left_alone(self):
        self.assertEqual([], self.phrases("LICENSE", "as they stand\n"))
        self.assertEqual([], self.phrases("scenes/nine-tiles/a.mi", "# as they stand\n"))


class Checked(unittest.TestCase):
    FILES = ("src/base/ggx_test.cpp", "tests/cli/ray_test.cpp")
    TESTS = lint.tests_of(["TEST(Ggx, IsOne) {\n  TEST_F(Ray, Runs)\n", "TEST_P(Ray, MayFail) {\n"])

    def findings(self, comment):
        return [f.message for f in lint.check_tests_exist("src/base/a.h", comment, self.TESTS,
                                                          self.FILES)]

    def test_tests_of_every_macro_are_known(self):
        self.assertEqual({"Ggx": {"IsOne"}, "Ray": {"Runs", "MayFail"}}, self.TESTS)

    def test_existing_tests_and_files_are_clean(self):
        for named in ("Ggx.IsOne", "Ggx.*, Ray.May*.", "Ray.Runs in tests/cli/ray_test.cpp",
                      "ggx_test.cpp", "tests/cli (crops)", "Ray.*, and the contract suite"):
            self.assertEqual([], self.findings(f"/// Checked: {named}\nint a();\n"), named)

    def test_missing_tests_and_files_are_found(self):
        for named in ("Ggx.IsTwo", "Ggx.Has*", "Phong.*", "phong_test.cpp", "tests/phong"):
            self.assertEqual(1, len(self.findings(f"/// Checked: {named}\nint a();\n")), named)

    def test_continued_lines_belong_to_the_list(self):
        self.assertEqual(1, len(self.findings("/// Checked: Ggx.IsOne,\n///   Ggx.IsTwo\n")))
        self.assertEqual(1, len(self.findings("// Ends here. Checked:\n// Ggx.IsTwo, Ggx.IsOne.\n")))
        self.assertEqual([], self.findings("/// Checked: Ggx.IsOne\n/// See Phong.Exponent.\n"))
        self.assertEqual([], self.findings("/// Checked: Ggx.IsOne,\n/// Source: Phong.Lobe\n"))

    def test_code_is_no_comment(self):
        self.assertEqual([], self.findings('print("Checked: Ggx.IsTwo");\n'))


if __name__ == "__main__":
    unittest.main()
