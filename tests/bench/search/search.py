#!/usr/bin/env python3
"""How many runs a search needs to find a bug, beside random draws: tests/bench/search/search.py BENCH_SEARCH
[--seeds 20] [--most 300] [--only TEXT] [--how search,samples] [--first SEED].

For each seeded bug (bugs.py) and each seed, bench_search counts the runs until the first failure: of a search, and of
random draws. Prints a row for each bug: the medians over the seeds, and how often nothing was found. Without the bug, all
runs of the first seed must pass."""

import argparse
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

from bugs import BUGS

ROOT = pathlib.Path(__file__).resolve().parents[3]


def runs_until_failure(bench, scenario, behaviour, how, seeds, most):
    """For each seed the number of runs up to the first failure; None without one."""
    with tempfile.TemporaryDirectory() as folder:
        project = pathlib.Path(folder)
        # The shipped systems too: else they would find the installed behaviour beside them.
        shutil.copytree(ROOT / "behaviors", project / "behaviors")
        (project / "tests").mkdir()
        (project / "behaviors" / behaviour[0]).write_text(behaviour[1])
        # All values are chosen by bench_search.
        (project / "tests/it_test.lua").write_text(scenario.replace("SEARCH", "samples = 1"))
        words = [bench, how, str(most), str(seeds[0]), str(seeds[-1]), "tests/it_test.lua"]
        done = subprocess.run(words, cwd=project, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit("could not run: " + done.stdout[-2000:] + done.stderr)
        return [int(line) or None for line in done.stdout.split()]


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("bench", type=os.path.abspath)
    arguments.add_argument("--seeds", type=int, default=20)
    arguments.add_argument("--most", type=int, default=300)
    arguments.add_argument("--only", default="")
    arguments.add_argument("--how", default="search,samples")
    arguments.add_argument("--first", type=int, default=1)
    arguments.add_argument("--bugs-only", action="store_true", help="leaves out the runs without the bug")
    options = arguments.parse_args()
    ways = options.how.split(",")
    print("| bug | behaviour | %s |\n|---|---|%s" % (" | ".join(ways), "---|" * len(ways)), flush=True)
    for name, file, original, bug, scenario in BUGS:
        if options.only not in name:
            continue
        text = (ROOT / "behaviors" / file).read_text()
        if text.count(original) != 1:
            sys.exit("%s: %s has changed" % (name, file))
        if not options.bugs_only:
            right = runs_until_failure(options.bench, scenario, (file, text), "search", [options.first], options.most)[0]
            if right is not None:
                print("| %s | `%s` | fails without the bug, after %d runs |" % (name, file, right), flush=True)
                continue
        wrong = (file, text.replace(original, bug))
        seeds = range(options.first, options.first + options.seeds)
        cells = []
        for how in ways:
            found = runs_until_failure(options.bench, scenario, wrong, how, seeds, options.most)
            missed = found.count(None)
            median = statistics.median(options.most if each is None else each for each in found)
            cells.append("%g%s" % (median, " (%d of %d not found)" % (missed, options.seeds) if missed else ""))
            print(how, name, sorted(found, key=lambda each: each or options.most), file=sys.stderr, flush=True)
        print("| %s | `%s` | %s |" % (name, file, " | ".join(cells)), flush=True)


if __name__ == "__main__":
    main()
