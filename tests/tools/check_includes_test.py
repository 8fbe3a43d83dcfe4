"""tools/check_includes finds each kind of fault, and only those."""
import pathlib
import tempfile
import unittest

from helpers import tool

FAULTS = [  # file, content, part of the message
    ("core/a.hpp", '#pragma once\n#include "io/b.hpp"\n', "core/a.hpp:2: error: core/ must not include io/"),
    ("io/a.cpp", '#include "solvers/b.hpp"\n', "io/ must not include solvers/"),
    ("contact/a.cpp", '# include "solvers/b.hpp"\n', "contact/ must not include solvers/"),
    ("scenarios/a.cpp", '#include "solvers/b.hpp"\n', "scenarios/ must not include solvers/"),
    ("solvers/a.cpp", '#include <app/b.hpp>\n', "solvers/ must not include app/"),
    ("core/a.cpp", '#include "../io/b.hpp"\n', "without '..'"),
    ("core/a.cpp", '#include "b.hpp"\n', '"core/b.hpp"'),
    ("core/a.hpp", "int x;\n", "no #pragma once"),
    ("core/a.cpp", "#include <yaml-cpp/yaml.h>\n", "belongs to io/ only"),
    ("app/a.cpp", "#include <hdf5.h>\n", "belongs to io/ only"),
    ("io/a.cpp", "#include <CGAL/hull.h>\n", "belongs to scenarios/ only"),
]
GOOD = {
    "core/a.hpp": '#pragma once\n#include <vector>\n#include "core/b.hpp"\n',
    "contact/walls/a.cpp": '#include "contact/walls/b.hpp"\n#include "core/a.hpp"\n',
    "solvers/a.cpp": '#include "contact/a.hpp"\n',
    "io/heavy.hpp": "#pragma once\n#include <hdf5.h>\n",
    "io/a.cpp": '#include "io/heavy.hpp"\n',
    "scenarios/a.cpp": '#include "io/a.hpp"\n#include "contact/a.hpp"\n',
    "app/a.cpp": '#include "solvers/a.hpp"\n#include <CLI/CLI.hpp>\n',
    "tests/core/a_test.cpp": '#include "app/a.hpp"\n#include "beside.hpp"\n',
    "tests/core/beside.hpp": "#pragma once\n",
}


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, files):
        for name, content in files.items():
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content)

    def test_good_tree(self):
        self.write(GOOD)
        code, out, err = tool("check_includes", self.root)
        self.assertEqual((code, err), (0, ""))
        self.assertIn(f"{len(GOOD)} files, 0 faults", out)

    def test_each_fault(self):
        for name, content, message in FAULTS:
            with self.subTest(file=name, content=content):
                self.write({name: content})
                code, _, err = tool("check_includes", self.root)
                self.assertEqual(code, 1)
                self.assertIn(message, err)
                self.assertEqual(len(err.splitlines()), 1)
                (self.root / name).unlink()

    def test_a_heavy_header_stays_in_its_folder(self):
        self.write({**GOOD, "app/a.cpp": '#include "io/heavy.hpp"\n',
                    "io/light.hpp": '#pragma once\n#include "io/heavy.hpp"\n'})
        code, _, err = tool("check_includes", self.root)
        self.assertEqual(code, 1)
        self.assertIn("app/a.cpp:1", err)
        self.assertIn("io/light.hpp:2", err)

    def test_nothing_to_check_is_an_error(self):
        self.assertEqual(tool("check_includes", self.root)[0], 2)


if __name__ == "__main__":
    unittest.main()
