"""What tests of the real program share: how it is called, a folder of its own for every test, results that are made once.

PROGRAM and SOURCE are the script's first two arguments.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])


def environment(words):
    """In a sanitizer build every command counts its leaks, except the one that starts Open MPI: that leaves some behind."""
    return {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"} if words[:1] == ("run",) else dict(os.environ)


def call(*words, **more):
    more.setdefault("env", environment(words))
    more.setdefault("stdout", subprocess.PIPE)
    more.setdefault("timeout", 240)
    return subprocess.run([PROGRAM, *map(str, words)], stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True, check=False, **more)


class InFolder(unittest.TestCase):
    made = {}  # of a file's name: (its bytes, what --json printed)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)
        self.addCleanup(os.chdir, "/")

    def fetch_made(self, name, *words):
        """The file that a command writes in an empty folder, made once; its JSON."""
        if name not in InFolder.made:
            done = call(*words, "--json", "--quiet")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual([p.name for p in pathlib.Path(".").iterdir()], [name])
            InFolder.made[name] = pathlib.Path(name).read_bytes(), json.loads(done.stdout)
        pathlib.Path(name).write_bytes(InFolder.made[name][0])
        return InFolder.made[name][1]

    def refuse(self, code, *words, piece, **more):
        before = {p.name: p.read_bytes() for p in pathlib.Path(".").iterdir()}
        done = call(*words, **more)
        self.assertEqual(done.returncode, code, (words, done.stderr))
        self.assertEqual(done.stdout, "", words)
        self.assertIn(piece, done.stderr)
        self.assertEqual(before, {p.name: p.read_bytes() for p in pathlib.Path(".").iterdir()}, "a refused command writes nothing")
