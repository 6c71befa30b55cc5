// `nezumi class`: a classroom on the teacher's computer; pupils need only a browser.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/run/options.hpp"
#include "bindings/cli/run/web.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/web/classroom/check_work.hpp"
#include "bindings/web/classroom/classroom.hpp"
#include "bindings/web/qr_code.hpp"
#include "engine/base/own_program.hpp"
#include "engine/base/visible.hpp"

namespace nezumi::cli {
namespace {

struct ClassWords {
    std::string folder;
    std::string collect;
    RunWords web;
    bool trust = false;
};

int run_class(const ClassWords& words) {
    RunWords of_run = words.web;
    of_run.file = words.folder;
    const auto read = read_run_options(of_run);
    if (!read) return refuse(read.error());
    std::error_code problem;
    std::filesystem::create_directories(words.folder, problem);
    const std::filesystem::path folder = std::filesystem::canonical(words.folder, problem);
    if (problem) return refuse({"can't be made: " + problem.message(), {words.folder}});
    web::ClassOptions options{.folder = folder, .program = own_program(), .trust = words.trust};
    for (const std::filesystem::path& installed : installed_folders()) {
        options.exercises.push_back(installed / "behaviors/exercises");
        options.page = installed / "bindings/web/page";
    }
    if (!words.collect.empty()) {
        const auto done =
            web::collect_class(folder, web::exercises_of(options), words.collect, options.program, words.trust);
        return done ? exit_done : refuse(done.error());
    }
    auto sockets = sockets_of(*read->web);
    if (!sockets) return refuse(sockets.error());
    options.sockets = std::move(sockets->options);
    StopSignals signals;
    const auto classroom = web::Classroom::open(std::move(options));
    if (!classroom) return refuse(classroom.error());
    std::string said =
        fmt::format("pupils open:  {}\nteacher opens: {}\n", (*classroom)->url(), (*classroom)->teacher_url());
    if (!sockets->fingerprint.empty()) {
        said += about_certificate(sockets->fingerprint) + "\n";
        const auto code = isatty(STDERR_FILENO) != 0 ? web::qr_code((*classroom)->url()) : Expected<std::string>("");
        said += code ? *code : code.error().message + "\n";
    }
    put_text(stderr, visible(said));
    (*classroom)->run([&] { return signals.received() != 0; });
    return exit_done;
}

}  // namespace

SubCommand class_command() {
    auto words = std::make_shared<ClassWords>();
    std::vector<Option> options{{"DIR", &words->folder, "the folder of the class: pupils' work, exercises, results"}};
    for (Option& each : run_options(words->web)) {
        if (each.name == "--listen" || each.name == "--port") options.push_back(std::move(each));
    }
    options.push_back(
        {"--collect", &words->collect,
         "instead: copy all work into this folder, check it, and write results.csv and results.xml (JUnit)", "FOLDER"});
    options.push_back({"--trust", &words->trust,
                       "run on a kernel without Landlock: pupils' programs could then read all files of yours"});
    return {.name = "class",
            .help = "Serve a class: pupils work in their browsers, the teacher sees how they do",
            .options = std::move(options),
            .run = [words] { return run_class(*words); },
            .footer =
                "Each pupil gets a copy of the exercise and a system of their own, which can reach nothing else. "
                "Ctrl-C ends the class;\nthe work stays in DIR, and pupils come back with their codes. See "
                "docs/classroom.md."};
}

}  // namespace nezumi::cli
