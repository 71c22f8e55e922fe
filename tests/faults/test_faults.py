"""A planted fault in every part of the machine is caught by a watch-dog: sources with one line changed, compiled and run.

usage: test_faults.py SOURCE_FOLDER BUILD_FOLDER LIBRARY

A fault is a line of a source and what it is changed to. A line that is no longer there, or there twice, fails the test: it has to be
chosen anew. The library is linked behind the changed source, whose functions are found first.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD, LIBRARY = (pathlib.Path(p).resolve() for p in sys.argv[1:4])
HERE = pathlib.Path(__file__).resolve().parent

# name: file, line, changed line, what runs, what the watch-dogs say (one of these)
FAULTS = {
    "wrong sign: a floe is pushed the way it pushes": (
        "kernel/stage.c", "    b->V[0] -= jx * b->inv_mass, b->V[1] -= jy * b->inv_mass, b->V[2] -= rub * b->turn;\n",
        "    b->V[0] += jx * b->inv_mass, b->V[1] += jy * b->inv_mass, b->V[2] -= rub * b->turn;\n", "window",
        ["momentum bookkeeping", "energy bookkeeping", "not finite", "whole radius"]),
    "lost impulse: a step's change of velocity is forgotten": (
        "kernel/cluster.c", "        for (int q = 0; q < 4; q++) m->y1[FW_VX + q] = m->k[last][q];\n",
        "        for (int q = 0; q < 4; q++) m->y1[FW_VX + q] = m->index % 7 ? m->k[last][q] : m->y0[FW_VX + q];\n", "window",
        ["energy bookkeeping", "momentum bookkeeping"]),
    "lost impulse: the other floe of a contact is not told": (
        "kernel/books.c", "        shove(b, -jx, -jy, rub);\n", "\n", "window", ["energy bookkeeping", "momentum bookkeeping"]),
    "leaked floe: one leaves the world unseen": (
        "world/world.c", "            w->ledger.floes_out++;\n", "\n", "window", ["floes that nobody can account for"]),
    "leaked energy: who leaves takes none along": (
        "world/world.c", "            w->ledger.outflow += kinetic(&w->bodies[i]);\n", "\n", "window", ["energy balance"]),
    "friction drives": (
        "kernel/stage.c", "    p->to_rub = -p->law.ct * n * inv;\n", "    p->to_rub = p->law.ct * n * inv;\n", "window",
        ["energy given by friction", "force evaluations"]),
    "friction of a lone floe drives": (
        "kernel/lone_keep.c", "friction -= weight * rub * y[j].slip;", "friction += weight * rub * y[j].slip;", "hit",
        ["energy given by friction"]),
    "drag does no work": (
        "kernel/books.c", "    l->drag_work += s->drag_work,", "    l->drag_work += 0,", "window", ["energy balance"]),
    "drag of a lone floe does no work": (
        "kernel/lone_keep.c", "    l->drag_work += mass * drag_work,", "    l->drag_work += 0,", "hit", ["energy balance"]),
    "a floe in free flight loses speed": (
        "kernel/events.c", "b->vx = at.vx, b->vy = at.vy, b->t = t;", "b->vx = 0.98 * at.vx, b->vy = at.vy, b->t = t;", "window",
        ["energy balance"]),
    "a spring that pulls": (
        "kernel/stage.c", "    double push = fw_larger(0, (p->alpha + p->beta * free) * p->to_push),",
        "    double push = fw_larger(-1e3, (p->alpha + p->beta * free) * p->to_push),", "window",
        ["tension, or friction"]),
    "friction has no cap": (
        "kernel/stage.c", "cap = p->mu * push;", "cap = 2 * p->mu * push;", "window", ["tension, or friction"]),
    "contacts are lost when a cluster falls apart": (
        "kernel/flock.c", "            if (find_root(k->root, p.a) != (int32_t)r) continue;\n",
        "            if (find_root(k->root, p.a) != (int32_t)r || (p.b != FW_WALL && p.a % 3 == 1)) continue;\n", "window",
        ["energy balance", "before they touched", "not finite", "force evaluations"]),
    "touches are missed": (
        "kernel/path.c", "                if (at <= until) return at;\n", "                if (at <= until && root > 0.3 * h) return at;\n", "window", ["before they touched", "whole radius"]),
    "wear falls beside the ring": (
        "abrasion/wear.c", "w->load[l][q][k] = cell[QUAD * l + q] * per_arc;\n", "w->load[l][q][k] = cell[QUAD * l + q] * per_arc * 0.999999;\n", "hit",
        ["wear load on the ring"]),
    "ice is crushed for nothing": (
        "kernel/crush_step.c", "*(crushed > 0 ? &to->crushed : &turned) += crushed;", "*(crushed > 0 ? &to->crushed : &turned) += 0;", "crush",
        ["energy balance"]),
    "a flat holds for nothing": (
        "kernel/crush_step.c", "rolling -= hb * M * r->turning[s];", "rolling -= 0;", "crush", ["energy balance"]),
    "a flat drives": (
        "kernel/crush_step.c", "rolling -= hb * M * r->turning[s];", "rolling += hb * M * r->turning[s];", "crush",
        ["energy given by friction", "energy balance"]),
    "a floe on its flat turns for nothing": (
        "kernel/crush_step.c", "        turned += per_way / n_flat * (way - (D1 - r->deepest[0]));\n", "        turned = 0;\n", "crush", ["energy balance"]),
    "a flat's moment has no cap": (
        "kernel/crush.c", "p->mu * push, hold, &rub, &roll);", "p->mu * push, 3 * hold, &rub, &roll);", "crush", ["tension, or friction"]),
    "half the wind is not told to the books": (
        "kernel/forces.c", "m->drag[s][0] += m->air_rate * (set->flow.wind_x - m->V[0])", "m->drag[s][0] += 0.5 * m->air_rate * (set->flow.wind_x - m->V[0])",
        "weather", ["energy bookkeeping", "momentum bookkeeping"]),
    "spin is braked more than it is told": (
        "kernel/forces.c", "m->gained[2] = slows, ", "m->gained[2] = 0.5 * slows, ", "weather", ["energy bookkeeping"]),
}


def command_of(file):
    for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8")):
        if entry["file"] == str(SOURCE / "src" / file):
            return shlex.split(entry["command"])
    raise KeyError(file)


def run(fault, folder):
    file, line, changed, what, _ = fault
    text = (SOURCE / "src" / file).read_text(encoding="utf-8")
    if text.count(line) != 1:
        return f"src/{file}: {line!r} is there {text.count(line)} times, wanted once"
    mutated = folder / pathlib.Path(file).name
    mutated.write_text(text.replace(line, changed), encoding="utf-8")
    command, flags = command_of(file), []
    skip = False
    for word in command[1:]:
        if skip or word in ("-c", str(SOURCE / "src" / file)):
            skip = False
        elif word in ("-o", "-MF", "-MT"):
            skip = True
        elif word != "-MD":
            flags.append(word)
    program = folder / "faulty"
    build = [command[0], *flags, "-Wno-error", "-w", str(HERE / "driver.c"), str(mutated), str(LIBRARY), "-lgsl", "-lgslcblas", "-lm", "-o", str(program)]
    done = subprocess.run(build, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return done.stderr
    done = subprocess.run([str(program), what], capture_output=True, text=True, check=False, timeout=120)
    return done.stdout + done.stderr


class Faults(unittest.TestCase):
    def test_all(self):
        with tempfile.TemporaryDirectory() as place, concurrent.futures.ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
            folders = {}
            for i, name in enumerate(FAULTS):
                folders[name] = pathlib.Path(place) / str(i)
                folders[name].mkdir()
            said = dict(zip(FAULTS, pool.map(lambda name: run(FAULTS[name], folders[name]), FAULTS)))
        for name, answer in said.items():
            print(f"{name}: {answer.strip()}")
            with self.subTest(name):
                self.assertRegex(answer, "^FW_E_(NUMERIC|LIMIT) ")
                self.assertTrue(any(piece in answer for piece in FAULTS[name][4]), answer)

    def test_without_a_fault(self):
        with tempfile.TemporaryDirectory() as place:
            for what in ("hit", "window", "crush", "weather"):
                fault = ("kernel/watch.c", '#include "kernel/watch.h"\n', '#include "kernel/watch.h"\n\n', what, [])
                self.assertEqual(run(fault, pathlib.Path(place)), "FW_OK \n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
