#!/usr/bin/env python3
"""How many runs a search needs to find a bug, beside random draws: tests/bench/search/search.py NEZUMI [--seeds 20]
[--most 300] [--only TEXT].

For each seeded bug (bugs.py) and each seed, runs its scenario with `search = N` and with `samples = N`, and counts the runs
until the first failure. Prints a row of docs/sweeps.md for each bug: the medians over the seeds. Without the bug, all runs of
the first seed must pass."""

import argparse
import csv
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

from bugs import BUGS

ROOT = pathlib.Path(__file__).resolve().parents[3]


def runs_until_failure(nezumi, scenario, behaviour, how, seed, most):
    """The number of runs up to the first failure; None without one."""
    with tempfile.TemporaryDirectory() as folder:
        project = pathlib.Path(folder)
        # The shipped systems too: else they would find the installed behaviour beside them.
        shutil.copytree(ROOT / "behaviors", project / "behaviors")
        (project / "tests").mkdir()
        (project / "behaviors" / behaviour[0]).write_text(behaviour[1])
        text = scenario.replace("SEARCH", "%s = %d" % (how, most))
        (project / "tests/it_test.lua").write_text(text)
        words = [nezumi, "test", "--seed", str(seed), "--quiet", "--measures", "it.csv"]
        done = subprocess.run(words, cwd=project, capture_output=True, text=True)
        if done.returncode == 2:
            sys.exit("could not run: " + done.stdout[-2000:] + done.stderr)
        with open(project / "it.csv", newline="") as file:
            for number, row in enumerate(csv.DictReader(file), 1):
                if row["passed"] == "false":
                    return number
    return None


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("nezumi", type=os.path.abspath)
    arguments.add_argument("--seeds", type=int, default=20)
    arguments.add_argument("--most", type=int, default=300)
    arguments.add_argument("--only", default="")
    options = arguments.parse_args()
    print("| bug | behaviour | search | random | ratio |\n|---|---|---|---|---|", flush=True)
    for name, file, original, bug, scenario in BUGS:
        if options.only not in name:
            continue
        text = (ROOT / "behaviors" / file).read_text()
        if text.count(original) != 1:
            sys.exit("%s: %s has changed" % (name, file))
        right = runs_until_failure(options.nezumi, scenario, (file, text), "search", 1, options.most)
        if right is not None:
            print("| %s | `%s` | fails without the bug, after %d runs |" % (name, file, right), flush=True)
            continue
        wrong = (file, text.replace(original, bug))
        medians = []
        for how in ("search", "samples"):
            found = [runs_until_failure(options.nezumi, scenario, wrong, how, seed, options.most)
                     for seed in range(1, options.seeds + 1)]
            missed = found.count(None)
            medians.append((statistics.median(options.most if each is None else each for each in found), missed))
        cells = ["%g%s" % (median, " (%d not found)" % missed if missed else "") for median, missed in medians]
        print("| %s | `%s` | %s | %s | %.2f |" % (name, file, *cells, medians[0][0] / medians[1][0]), flush=True)


if __name__ == "__main__":
    main()
