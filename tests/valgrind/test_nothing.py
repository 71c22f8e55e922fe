"""Nothing for nothing: windows without optional effects take the same instructions in a program that has them as in one built without their code.

usage: test_nothing.py SOURCE_FOLDER WORK_FOLDER CMAKE GENERATOR C_COMPILER

Two trees of the library, with and without (FLOEWEAR_OPTIONAL_EFFECTS), no AVX-512, which valgrind does not know; instructions counted by callgrind.
"""
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE, WORK, CMAKE, GENERATOR, COMPILER = (pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), *sys.argv[3:6])
HERE = pathlib.Path(__file__).resolve().parent
MOST = 0.01  # more instructions than without, relative


def call(*words):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, check=False, timeout=600)
    if done.returncode != 0:
        sys.exit(f"{words}\n{done.stdout}{done.stderr}")
    return done


def program(name, effects):
    """The trees are kept: the next run builds what has changed."""
    tree = WORK / name
    call(CMAKE, "-S", SOURCE, "-B", tree, "-G", GENERATOR, f"-DCMAKE_C_COMPILER={COMPILER}", "-DCMAKE_BUILD_TYPE=Release",
         "-DFLOEWEAR_NATIVE=OFF", "-DFLOEWEAR_TESTS=OFF", f"-DFLOEWEAR_OPTIONAL_EFFECTS={effects}")
    call(CMAKE, "--build", tree, "--target", "libfloewear")
    call(COMPILER, "-std=gnu17", "-O2", f"-I{SOURCE}/include", HERE / "nothing.c", tree / "libfloewear.a", "-lgsl", "-lgslcblas", "-lm",
         "-o", tree / "nothing")
    return tree / "nothing"


def count(path, n):
    done = call("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", path, n)
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1)), done.stdout


class Nothing(unittest.TestCase):
    def test_windows(self):
        counts, said = {}, {}
        for name, effects in (("with", "ON"), ("without", "OFF")):
            path = program(name, effects)
            (one, _), (two, said[name]) = count(path, 1), count(path, 2)
            counts[name] = two - one
        more = counts["with"] / counts["without"] - 1
        print(f"instructions: {counts['with']} with the optional effects' code, {counts['without']} without: {100 * more:+.3f} %")
        self.assertEqual(said["with"], said["without"])
        self.assertLess(abs(more), MOST)

    def test_is_refused(self):
        """The tree without is one without."""
        path = WORK / "without" / "asks"
        source = WORK / "asks.c"
        source.write_text('''#include <stdio.h>
#include "floewear/realisation.h"
int main(void)
{
    fw_model m;
    fw_msg   msg = {""};
    fw_model_defaults(&m);
    m.effects |= FW_EFFECT_ADDED_MASS;
    printf("%d %s\\n", fw_model_check(&m, &msg) == FW_E_UNSUPPORTED, msg.text);
}
''', encoding="utf-8")
        program("without", "OFF")
        call(COMPILER, "-std=gnu17", f"-I{SOURCE}/include", source, WORK / "without" / "libfloewear.a", "-lgsl", "-lgslcblas", "-lm", "-o", path)
        self.assertRegex(call(path).stdout, "^1 .*without the optional effects")


if __name__ == "__main__":
    WORK.mkdir(parents=True, exist_ok=True)
    sys.argv = sys.argv[:1]
    unittest.main(verbosity=2)
