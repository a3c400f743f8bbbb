#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A check that cannot fail is no check: small trees that break each rule of scripts/check_layers.py once."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import check_layers  # noqa: E402

SPDX = "// SPDX-License-Identifier: Apache-2.0\n"
TABLE = """# Architecture
```layers
core  :                 std only: check, error
gpu   : core            buffers
sweep : core gpu   the plane sweep: problem in, result out
app   : everything      commands
```
"""
GOOD_TREE = {
    "docs/architecture.md": TABLE,
    "src/core/vec.h": SPDX + "#include <cmath>\nstruct Vec { double x = std::sqrt(4.0); };\n",
    "src/core/check.cpp": SPDX + "#include <cstdio>\nvoid f() { std::fprintf(stderr, \"bug\"); }\n",
    "src/gpu/buffer.h": SPDX + '#include "core/vec.h"\nstruct Buffer { Vec size; };\n',
    "src/gpu/gl/context.h": SPDX + "struct Context {};\n",
    "src/gpu/buffer.cpp": SPDX + '#include <GL/gl.h>\n#include "gpu/gl/context.h"\n',
    "src/sweep/sweep.cpp": SPDX + '#include "core/vec.h"\n#include "gpu/buffer.h"\nint n = 1\'000;\n',
    "src/app/main.cpp": SPDX + '#include <iostream>\n#include "sweep/sweep.h"\nint main() { std::cout << 1; }\n',
    "src/sweep/sweep.h": SPDX + "int sweep();\n",
    "tests/gpu/context_test.cpp": SPDX + '#include <gtest/gtest.h>\n#include "gpu/gl/context.h"\n',
    "cmake/Module.cmake": "# SPDX-License-Identifier: Apache-2.0\n",
}


class CheckLayersTest(unittest.TestCase):
    def check(self, changes, compile_headers=False):
        """The violations of the good tree with `changes` laid over it."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for name, text in {**GOOD_TREE, **changes}.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return list(check_layers.violations(root, compile_headers))

    def expect_one(self, changes, sentence):
        self.assertEqual(self.check(changes), [sentence])

    def test_a_good_tree_has_no_violations(self):
        self.assertEqual(self.check({}, compile_headers=True), [])

    def test_a_lower_module_may_not_include_a_higher_one(self):
        self.expect_one({"src/core/up.cpp": SPDX + '#include "sweep/sweep.h"\n'},
                        'src/core/up.cpp:2: core may not include "sweep/sweep.h"; see docs/architecture.md')

    def test_what_a_module_uses_is_not_inherited(self):
        table = TABLE.replace("sweep : core gpu", "sweep : gpu")
        self.expect_one({"docs/architecture.md": table},
                        'src/sweep/sweep.cpp:2: sweep may not include "core/vec.h"; see docs/architecture.md')

    def test_nothing_includes_app(self):
        self.expect_one({"src/sweep/a.cpp": SPDX + '\n#  include "app/commands.h"\n'},
                        'src/sweep/a.cpp:3: includes "app/commands.h", but nothing includes app')

    def test_includes_name_their_module(self):
        self.expect_one({"src/gpu/a.cpp": SPDX + '#include "buffer.h"\n'},
                        'src/gpu/a.cpp:2: "buffer.h" must be written as "module/file.h"')

    def test_a_commented_include_is_none(self):
        self.assertEqual(self.check({"src/core/a.cpp": SPDX + '// x\n/*\n#include "app/a.h"\n*/\n'}), [])

    def test_a_module_without_a_row_is_found(self):
        self.expect_one({"src/extra/a.cpp": SPDX}, "src/extra: has no row in docs/architecture.md")

    def test_a_subfolder_is_private_to_its_module(self):
        self.expect_one({"src/sweep/a.cpp": SPDX + '#include "gpu/gl/context.h"\n'},
                        'src/sweep/a.cpp:2: "gpu/gl/context.h" is private to gpu')

    def test_a_subfolder_is_private_to_its_modules_tests(self):
        self.expect_one({"tests/sweep/a_test.cpp": SPDX + '#include "gpu/gl/context.h"\n'},
                        'tests/sweep/a_test.cpp:2: "gpu/gl/context.h" is private to gpu')

    def test_public_headers_include_no_third_party(self):
        self.expect_one({"src/gpu/image.h": SPDX + "#include <opencv2/core.hpp>\n"},
                        "src/gpu/image.h:2: a public header may not include <opencv2/core.hpp>; "
                        "hide the library in a .cpp")

    def test_private_headers_may_include_third_party(self):
        self.assertEqual(self.check({"src/gpu/gl/image.h": SPDX + "#include <opencv2/core.hpp>\n"}), [])

    def test_only_app_prints(self):
        for code, name in (("std::cerr << 1;", "std::cerr"), ('std::printf("x");', "printf"),
                           ('fprintf(stderr, "x");', "stderr"), ('puts("x");', "puts")):
            self.expect_one({"src/gpu/a.cpp": SPDX + f"void f() {{ {code} }}\n"},
                            f"src/gpu/a.cpp:2: only app prints ({name})")
        self.expect_one({"src/gpu/a.cpp": SPDX + "#include <iostream>\n"}, "src/gpu/a.cpp:2: only app prints (<iostream>)")

    def test_formatting_and_speaking_of_printing_are_allowed(self):
        self.assertEqual(self.check({"src/gpu/a.cpp": SPDX + 'void f() { snprintf(b, 3, "std::cout"); }  // printf()\n'}), [])

    def test_every_source_names_its_licence(self):
        for name in ("src/gpu/a.cpp", "src/gpu/gl/a.h", "tests/gpu/a_test.cpp", "cmake/A.cmake", "scripts/a.sh", ".ci/run"):
            self.expect_one({name: "\n"}, f"{name}:1: no SPDX-License-Identifier line at the top")

    def test_a_header_that_leans_on_its_includer_is_found(self):
        found = self.check({"src/gpu/leaning.h": SPDX + "inline std::string name();\n"}, compile_headers=True)
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("src/gpu/leaning.h:1: does not compile by itself: "), found[0])

    def test_a_header_is_compiled_again_when_what_it_includes_changes(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for name, text in GOOD_TREE.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            self.assertEqual(list(check_layers.violations(root)), [])
            (root / "src/core/vec.h").write_text(SPDX + "struct Vector {};\n", encoding="utf-8")
            found = list(check_layers.violations(root))
            self.assertEqual([v.split(":")[0] for v in found], ["src/gpu/buffer.h"])

    def test_rows_use_rows_above_them_only(self):
        table = TABLE.replace("core  :     ", "core  : gpu ")
        with self.assertRaisesRegex(ValueError, "architecture.md:3: core uses gpu, which is not a row above it"):
            self.check({"docs/architecture.md": table})

    def test_an_unreadable_table_is_named(self):
        with self.assertRaisesRegex(ValueError, "no block that begins with ```layers"):
            self.check({"docs/architecture.md": "# Architecture\n"})
        with self.assertRaisesRegex(ValueError, "architecture.md:4: not a row"):
            self.check({"docs/architecture.md": TABLE.replace("gpu   : core", "gpu and core")})


if __name__ == "__main__":
    unittest.main()
