"""The house rules that no compiler checks, read from the sources themselves.

usage: test_house.py SOURCE_FOLDER BUILD_FOLDER C_COMPILER

A new folder or a new permission is a line in MAY_INCLUDE, so that it is seen in review. Only the standard library.
"""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD, COMPILER = pathlib.Path(), pathlib.Path(), "cc"

CORE = {"base", "geometry", "physics"}
BELOW_STUDY = CORE | {"statistics", "world", "effects", "field", "abrasion", "kernel", "realisation"}

# Folder -> folders whose module headers ("folder/file.h") it may include; its own always.
MAY_INCLUDE = {
    "base": set(),
    "geometry": {"base"},
    "physics": {"base"},
    "statistics": {"base"},
    "world": CORE,
    "effects": CORE | {"world"},
    "field": CORE | {"world"},
    "abrasion": CORE | {"world"},
    "kernel": CORE | {"world", "effects", "abrasion"},
    "realisation": BELOW_STUDY - {"realisation"},
    "study": CORE | {"statistics", "realisation"},
    "campaign": {"base", "statistics"},
    "store": {"base", "statistics"},
    "cli": BELOW_STUDY | {"study", "campaign", "store"},
}

# Folder -> public headers (<floewear/file.h>) it may include. A plain-data header may be read by a floor below the one
# that implements it (an abrasion law's struct, a thickness mix); functions may be called downwards only, which the
# linker checks: the folder libraries name what they link.
PLAIN = {"status.h"}
SCENARIO = PLAIN | {"distribution.h", "scenario.h"}
RUN = SCENARIO | {"record.h", "records.h", "realisation.h"}
MAY_READ = {
    "base": PLAIN,
    "geometry": PLAIN,
    "physics": SCENARIO,
    "statistics": PLAIN | {"distribution.h"},
    "world": SCENARIO,
    "effects": SCENARIO,
    "field": SCENARIO,
    "abrasion": SCENARIO,
    "kernel": SCENARIO,
    "realisation": RUN,
    "study": RUN | {"campaign.h"},
    "campaign": RUN | {"campaign.h"},
    "store": RUN | {"campaign.h"},
    "cli": RUN | {"campaign.h"},
}

# System headers with one home. The public headers have none of them.
ONE_HOME = {"mpi.h": "campaign", "hdf5.h": "store", "hdf5_hl.h": "store", "yaml.h": "cli", "argp.h": "cli"}

TOP_LEVEL = {"CMakeLists.txt", "src", "include", "tests", "campaigns", "analysis", "README.md"}  # and dot files
LONGEST_FILE = 600  # lines; 100-400 is comfortable
WARNINGS = ["-std=c17", "-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Wconversion", "-Werror"]


def includes(path):
    """(line number, header, is it in quotes) of every #include of a file."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
        if found:
            yield number, found.group(2), found.group(1) == '"'


def c_files(*folders):
    return sorted(p for folder in folders for p in (SOURCE / folder).rglob("*.[ch]"))


def compile_commands():
    with open(BUILD / "compile_commands.json", encoding="utf-8") as file:
        return [(pathlib.Path(c["file"]).resolve(), shlex.split(c["command"])) for c in json.load(file)]


def violations(folder, name, text_of_includes):
    """The include table's complaints about one file of src/<folder>."""
    complaints = []
    for number, header, is_quoted in text_of_includes:
        at = f"{name}:{number}: {header}"
        owner, _, rest = header.partition("/")
        if owner == "floewear":
            if rest not in MAY_READ[folder]:
                complaints.append(f"{at}: {folder} may not read this public header")
        elif is_quoted:
            if owner not in MAY_INCLUDE and "/" in header:
                complaints.append(f"{at}: no such folder in the include table")
            elif "/" in header and owner != folder and owner not in MAY_INCLUDE[folder]:
                complaints.append(f"{at}: {folder} may not include {owner}")
        elif ONE_HOME.get(header, folder) != folder:
            complaints.append(f"{at}: only {ONE_HOME[header]} may include this")
    return complaints


class IncludeTable(unittest.TestCase):
    def test_every_folder_is_in_the_table(self):
        folders = {p.name for p in (SOURCE / "src").iterdir() if p.is_dir()}
        self.assertEqual(folders - set(MAY_INCLUDE), set())
        self.assertEqual(set(MAY_INCLUDE), set(MAY_READ))

    def test_table_has_no_way_upwards(self):
        """No folder is reachable from itself: the floors are floors."""
        for start in MAY_INCLUDE:
            reached, front = set(), set(MAY_INCLUDE[start])
            while front:
                reached |= front
                front = set().union(*(MAY_INCLUDE[f] for f in front)) - reached
            self.assertNotIn(start, reached)

    def test_sources_keep_the_table(self):
        complaints = []
        for path in c_files("src"):
            folder = path.relative_to(SOURCE / "src").parts[0]
            complaints += violations(folder, path.relative_to(SOURCE), includes(path))
        self.assertEqual(complaints, [])

    def test_the_check_sees_a_breach(self):
        """Independent of today's sources: breaches written down here are found, and what is allowed is not."""
        def found(folder, header, is_quoted=True):
            return violations(folder, "x.c", [(1, header, is_quoted)])
        self.assertTrue(found("geometry", "physics/contact.h"))
        self.assertTrue(found("kernel", "mpi.h", False))
        self.assertTrue(found("cli", "hdf5.h", False))
        self.assertTrue(found("campaign", "store/journal.h"))
        self.assertTrue(found("base", "floewear/campaign.h"))
        self.assertTrue(found("world", "nowhere/file.h"))
        self.assertFalse(found("store", "hdf5.h", False))
        self.assertFalse(found("kernel", "world/world.h"))
        self.assertFalse(found("study", "floewear/campaign.h"))
        self.assertFalse(found("cli", "study/answer.h"))

    def test_public_headers_stand_on_public_headers_only(self):
        known = {p.name for p in (SOURCE / "include/floewear").glob("*.h")}
        for path in c_files("include"):
            for number, header, _ in includes(path):
                at = f"{path.relative_to(SOURCE)}:{number}: {header}"
                self.assertNotIn(header, ONE_HOME, at)
                if "/" in header and not header.startswith("sys/"):
                    owner, _, rest = header.partition("/")
                    self.assertEqual(owner, "floewear", at)
                    self.assertIn(rest, known, at)


class Headers(unittest.TestCase):
    def compile_alone(self, header, flags):
        with tempfile.NamedTemporaryFile("w", suffix=".c") as file:
            file.write(f'#include "{header}"\n#include "{header}" /* twice: the guard */\nint unused_;\n')
            file.flush()
            done = subprocess.run([COMPILER, "-fsyntax-only", *WARNINGS, *flags, file.name],
                                  capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, f"{header} does not compile on its own:\n{done.stderr}")

    def test_public_headers_compile_alone(self):
        """As an outside C17 program sees them: no feature macro, no other include path."""
        for path in c_files("include"):
            header = path.relative_to(SOURCE / "include")
            with self.subTest(header=str(header)):
                self.compile_alone(header, [f"-I{SOURCE}/include"])

    def test_module_headers_compile_alone(self):
        """With the include paths that their own folder is compiled with, and no others."""
        flags = {}
        for path, command in compile_commands():
            if path.is_relative_to(SOURCE / "src"):
                kept = [word for before, word in zip(command, command[1:])
                        if word.startswith(("-I", "-D", "-isystem")) or before == "-isystem"]
                flags.setdefault(path.relative_to(SOURCE / "src").parts[0], kept)
        for path in c_files("src"):
            header = path.relative_to(SOURCE / "src")
            if path.suffix == ".h" and header.parts[0] in flags:
                with self.subTest(header=str(header)):
                    self.compile_alone(header, flags[header.parts[0]])


class Build(unittest.TestCase):
    def test_every_source_is_built(self):
        built = {path for path, _ in compile_commands()}
        lost = [str(p.relative_to(SOURCE)) for p in c_files("src") if p.suffix == ".c" and p.resolve() not in built]
        self.assertEqual(lost, [], "in no CMakeLists.txt")
        lost = [str(p.relative_to(SOURCE)) for p in c_files("tests")
                if p.suffix == ".c" and p.name.startswith("test_") and p.resolve() not in built]
        self.assertEqual(lost, [], "in no CMakeLists.txt")

    def test_bits_are_kept(self):
        """Every file of ours is compiled without contraction and without value-changing optimisation."""
        for path, command in compile_commands():
            if path.is_relative_to(SOURCE / "src"):
                self.assertIn("-ffp-contract=off", command, path)
                for flag in ("-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-fassociative-math"):
                    self.assertNotIn(flag, command, path)

    def test_mpi_and_hdf5_stay_at_home(self):
        """Include paths of MPI and HDF5 reach the folder that owns them, no other (link targets are private)."""
        for path, command in compile_commands():
            if not path.is_relative_to(SOURCE / "src"):
                continue
            folder = path.relative_to(SOURCE / "src").parts[0]
            paths = " ".join(w for i, w in enumerate(command) if w.startswith("-I") or command[i - 1] == "-isystem")
            if folder != "campaign":
                self.assertNotIn("openmpi", paths, path)
            if folder != "store":
                self.assertNotIn("hdf5", paths, path)


# Where ending is the job itself: the second Ctrl-C must work although the program hangs.
MAY_END = {"src/campaign/signals.c:_exit"}


class Files(unittest.TestCase):
    def test_sizes(self):
        complaints = []
        for path in c_files("include", "src", "tests"):
            lines = path.read_text(encoding="utf-8").splitlines()
            name = path.relative_to(SOURCE)
            if len(lines) > LONGEST_FILE:
                complaints.append(f"{name}: {len(lines)} lines, at most {LONGEST_FILE}: one idea per file")
            for number, line in enumerate(lines, 1):
                if "\t" in line or line != line.rstrip():
                    complaints.append(f"{name}:{number}: tab or blanks at the end")
        self.assertEqual(complaints, [])

    def test_no_printing_or_exit_below_cli(self):
        complaints = []
        words = re.compile(r"\b(printf|puts|putchar|fprintf|perror|exit|_exit|abort)\s*\(")
        for path in c_files("src"):
            if path.relative_to(SOURCE / "src").parts[0] == "cli":
                continue
            text = re.sub(r"/\*.*?\*/|//[^\n]*", lambda c: "\n" * c.group().count("\n"),
                          path.read_text(encoding="utf-8"), flags=re.S)
            for number, line in enumerate(text.splitlines(), 1):
                found = words.search(line)
                if found and f"{path.relative_to(SOURCE)}:{found.group(1)}" not in MAY_END:
                    complaints.append(f"{path.relative_to(SOURCE)}:{number}: {found.group(1)}")
        self.assertEqual(complaints, [])


class Commands(unittest.TestCase):
    """The two ready commands as far as they go without installing or building anything."""

    def run_closed(self, *command):
        """From another folder, with stdin closed."""
        words = " ".join(shlex.quote(str(w)) for w in command)
        return subprocess.run(["sh", "-c", f"exec {words} <&-"], cwd="/", capture_output=True, text=True, check=False,
                              timeout=60)

    def test_help(self):
        for command, word in (("tests/run", "--sanitize"), ("campaigns/run", "raahe"), (".ci/run", "--sanitize")):
            done = self.run_closed(SOURCE / command, "--help")
            self.assertEqual((done.returncode, done.stderr), (0, ""), command)
            self.assertIn(word, done.stdout)

    def test_wrong_usage(self):
        done = self.run_closed(SOURCE / "tests/run", "--no-such-option")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--no-such-option", done.stderr)
        done = self.run_closed(SOURCE / "campaigns/run", "no-such-campaign")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no-such-campaign", done.stderr)

    def test_shellcheck(self):
        if not shutil.which("shellcheck"):
            self.skipTest("shellcheck is not installed")
        files = [p for folder in ("campaigns", "tests", ".ci") for p in sorted((SOURCE / folder).rglob("*")) if p.is_file()]
        scripts = [p for p in files if p.suffix == ".sh" or re.match(rb"#!.*\b(ba)?sh\b", p.read_bytes()[:64])]
        self.assertGreaterEqual(len(scripts), 5)
        done = subprocess.run(["shellcheck", "-x", "--severity=warning", *scripts], cwd=SOURCE, capture_output=True, text=True, check=False)
        self.assertEqual(done.stdout, "")

    def test_top_level(self):
        """What is tracked, or would be: build folders and results are ignored by .gitignore."""
        listed = subprocess.run(["git", "-C", SOURCE, "ls-files", "-co", "--exclude-standard"], capture_output=True,
                                text=True, check=False) if shutil.which("git") else None
        if not listed or listed.returncode != 0:
            self.skipTest("not a git checkout")
        top = {line.split("/")[0] for line in listed.stdout.splitlines()}
        self.assertEqual({name for name in top if not name.startswith(".")} - TOP_LEVEL, set())


if __name__ == "__main__":
    SOURCE, BUILD, COMPILER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
    unittest.TestCase.maxDiff = None  # every complaint at once, not the first few
    unittest.main(argv=sys.argv[:1], verbosity=2)
