"""campaigns/ci.yaml gives the numbers of ci_numbers.json, whatever the number of ranks.

usage: test_ci_numbers.py FLOEWEAR SOURCE_FOLDER WORK_FOLDER [--update]

The numbers are floewear's own, kept so that a change of results is seen and said. Bits are promised on one machine type
only: six digits on x86-64 (builds with -O1 and -O3 -march=native agree to nine), three elsewhere. A commit that changes
them on purpose raises FW_RECORD_GENERATION (include/floewear/record.h), so that no campaign mixes records of both, runs this with
--update and says why.
"""
import json
import os
import pathlib
import platform
import re
import subprocess
import sys

DIGITS = 5e-7 if platform.machine() == "x86_64" else 5e-4
KEYS = {"percentiles": ("point", "bearing_deg", "percentile", "depth_mm", "low_mm", "high_mm"),
        "points": ("point", "bearing_deg", "mean_mm", "path_km", "impact_share")}


def numbers(floewear, campaign, stem, ranks):
    # A few hundred milliseconds per rank: more ranks than cores do no harm here.
    mpirun = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    command = [*mpirun, floewear, "run", campaign, "-o", stem, "--fresh", "--quiet", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, env=os.environ)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nexit code {done.returncode}\n{done.stderr}")
    answer = json.loads(done.stdout)
    return {"n": answer["n"], "failed": answer["failed"],
            **{table: [{key: row[key] for key in keys} for row in answer[table]] for table, keys in KEYS.items()}}


def differences(table, found, wanted):
    """Every value that is not within DIGITS of the wanted one, or of a millionth of its column's largest."""
    for key in KEYS[table]:
        scale = max((abs(row[key]) for row in wanted if row[key] is not None), default=0.0)
        for i, (one, other) in enumerate(zip(found, wanted)):
            a, b = one[key], other[key]
            if (a is None) != (b is None) or (a is not None and abs(a - b) > DIGITS * max(abs(b), 1e-6 * scale)):
                yield f"{table} row {i + 1} {key}: {a!r}, wanted {b!r}"


def main():
    floewear, source, work = (pathlib.Path(a).resolve() for a in sys.argv[1:4])
    work.mkdir(parents=True, exist_ok=True)
    kept = source / "tests/house/ci_numbers.json"
    header = (source / "include/floewear/record.h").read_text(encoding="utf-8")
    generation = int(re.search(r"FW_RECORD_GENERATION = (\d+)", header)[1])
    wanted = json.loads(kept.read_text(encoding="utf-8"))
    one = numbers(floewear, source / "campaigns/ci.yaml", work / "one", 1)
    if sys.argv[4:] == ["--update"]:
        tables = ",\n".join(f' "{t}": [\n  ' + ",\n  ".join(json.dumps(row) for row in one[t]) + "\n ]" for t in KEYS)
        has_changed = any(True for t in KEYS for _ in differences(t, one[t], wanted[t]))
        if has_changed and wanted.get("generation") == generation:
            sys.exit(f"other numbers, but still generation {generation}: raise FW_RECORD_GENERATION in {source}/include/floewear/record.h")
        kept.write_text(f'{{"generation": {generation}, "n": {one["n"]}, "failed": {one["failed"]},\n{tables}}}\n', encoding="utf-8")
        return
    complaints = []
    two = numbers(floewear, source / "campaigns/ci.yaml", work / "two", 2)
    if one != two:
        complaints.append("one rank and two ranks give different bits")
    if wanted.get("generation") != generation:
        complaints.append(f"numbers of generation {wanted.get('generation')}, records of generation {generation}: run with --update")
    if (one["n"], one["failed"]) != (wanted["n"], wanted["failed"]):
        complaints.append(f"{one['n']} realisations, {one['failed']} failed; wanted {wanted['n']}, {wanted['failed']}")
    for table in KEYS:
        if len(one[table]) != len(wanted[table]):
            complaints.append(f"{table}: {len(one[table])} rows, wanted {len(wanted[table])}")
        complaints += differences(table, one[table], wanted[table])
    print("\n".join(complaints[:20]) or f"{one['n']} realisations, all numbers within {DIGITS:g}")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
