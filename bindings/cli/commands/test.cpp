// `nezumi test`: scenarios, each run in a process of its own.
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/test/test.hpp"
#include "bindings/scenario/sweep.hpp"

namespace nezumi::cli {

SubCommand test_command() {
    auto options = std::make_shared<TestOptions>();
    return {
        .name = "test",
        .help = "Run scenarios: files *_test.lua",
        .options =
            {{"[PATHS]", &options->paths, "scenario files, and folders that are searched for *_test.lua"},
             {"--project", &options->project,
              "test this project: PATHS and -o are relative to its folder (default: the project here)", "DIR"},
             {"--filter", &options->filter, "only runs whose name contains this; a complete name selects only this run",
              "TEXT"},
             {"--list", &options->list, "show the names of the runs and where they are, and run nothing"},
             {"--seed", &options->seed,
              "the seed of all random numbers: each run's own seed is made from it and the run's name (default 124)",
              "N", whole_number(0, std::numeric_limits<std::uint64_t>::max(), "2^64 - 1")},
             {"--seeds", &options->seeds,
              "run each combination with each of these seeds, instead of the seeds of its scenario", "A..B"},
             {"--paired", &options->paired,
              "runs that differ only in this key of their sweep have the same seed; shows the differences between them",
              "NAME"},
             {"--search", &options->search,
              "for each scenario that draws values (a range in its sweep, or s:any): choose this many runs one after "
              "the other, where margins are small or new lines are executed",
              "N", whole_number(1, most_runs, "100000")},
             {"--repeat", &options->repeat,
              "repeat each run this many times (default 1); all must have the same trace hash", "N",
              whole_number(1, 1'000'000, "1000000")},
             {"--jobs", &options->jobs,
              "number of parallel processes (default: the number of cores); the results do not depend on it", "N",
              whole_number(1, 1024, "1024")},
             {"--shard", &options->shard,
              "run only part K of N of the runs, and keep their results in -o DIR; --merge puts the parts together",
              "K/N"},
             {"--resume", &options->resume, "resume: runs with results in -o DIR from the same files are not repeated"},
             {"--merge", &options->merge,
              "merge the results of parts (--shard) into one report; PATHS are the folders of the parts"},
             {"--watch", &options->watch,
              "after each save, run the scenarios that have read the saved file, failed ones first, until Ctrl-C"},
             {"--open", &options->open,
              "open the first failed run in the page and the console, paused where it failed, as nezumi open does"},
             {"--show", &options->show,
              "show one run in a page while it runs, at the speed of the clock; the page can pause it and change "
              "its "
              "speed"},
             {"--port", &options->page.port, "with --show: serve the page on this port, or the next free one", "N"},
             {"--listen", &options->page.listen,
              "with --show: serve the page to other computers, too, at this address of this computer", "ADDRESS"},
             {"--page-on-input", &options->page.page_on_input,
              "with --show: serve the page over the socket that is standard input, for `nezumi class`"},
             {"--hw", &options->hw,
              "drive the real robots, at real time, one run at a time; scenarios that read the truth, disturb or "
              "teleport need --rig"},
             {"--rig", &options->rig,
              "with --hw: the sockets of the test rigs that observe the robots and move them back before each run",
              "NAME=SOCKET,..."},
             {"--dev-root", &options->dev_root, "with --hw: the folder of the device files (default /dev)", "DIR"},
             {"--sys-root", &options->sys_root, "with --hw: the folder of the kernel's devices (default /sys)", "DIR"},
             {"--junit",
              &options->junit,
              "write the results to this file, as JUnit's XML",
              "FILE",
              {},
              FileUse::result},
             {"--measures",
              &options->measures,
              "write the measures of s:measure to this file, as CSV: a row for each run",
              "FILE.csv",
              {},
              FileUse::result},
             {"--margins",
              &options->margins,
              "write how near each condition came to failing to this file, as CSV: a row for each run and condition",
              "FILE.csv",
              {},
              FileUse::result},
             {"--plots", &options->plots,
              "draw each measure over each swept parameter into this folder, as SVG: medians and quartiles", "DIR"},
             {"--coverage", &options->coverage,
              "note which lines and branches of behaviours and modules run; writes coverage.txt and lcov.info into "
              "this "
              "folder",
              "DIR"},
             {"--mutate",
              &options->mutate,
              "change one place of this behaviour or module at a time, and show the changes that no scenario notices",
              "FILE.lua",
              {},
              FileUse::source},
             {"--tap", &options->tap, "print the results as TAP"},
             {"--quiet", &options->quiet, "report only runs that do not pass, and the summary"},
             {"--update-goldens", &options->update_goldens, "write the traces of s:golden instead of comparing"},
             {"-o,--output", &options->folder, "the folder for traces and pictures of failures", "DIR"}},
        .run = [options] { return test(std::move(*options)); },
        .footer =
            "Without PATHS: the scenarios in tests/ and behaviors/ of the project, but not in behaviors/exercises/.\n"
            "Exit status: 0 all passed, 1 a scenario failed, 2 something could not be run."};
}

}  // namespace nezumi::cli
