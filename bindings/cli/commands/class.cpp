// `nezumi class`: a classroom on the teacher's computer; pupils need only a browser.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/cli/run/hardware.hpp"
#include "bindings/cli/run/options.hpp"
#include "bindings/cli/run/web.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/web/classroom/check_work.hpp"
#include "bindings/web/classroom/classroom.hpp"
#include "bindings/web/qr_code.hpp"
#include "engine/base/module.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/visible.hpp"
#include "engine/devices/wired_device.hpp"
#include "engine/project/folders.hpp"
#include "engine/project/near_path.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

struct ClassWords {
    std::string folder;
    std::string collect;
    RunWords web;
    bool trust = false;
    std::string shared;
    std::string quota;
};

// The options of the shared system. Its robots are real only if the teacher gave --hw.
Expected<web::SharedOptions> shared_of(const ClassWords& words, const std::optional<Hardware>& hardware) {
    web::SharedOptions shared;
    if (words.shared.empty() && hardware)
        return failure("--hw: pupils' own systems are simulated: give --shared SYSTEM as well");
    if (words.shared.empty()) return shared;
    const auto file = find_system_file(words.shared);
    if (!file) return Unexpected(file.error());
    shared.file = *file;
    const auto system = read_system_file(*file, Project::of(*file, installed_folders()), {.peer_words = peer_words()});
    if (!system) return Unexpected(system.error());
    if (!hardware) return shared;
    // The limits of a robot apply before its driver: a pupil's copy of a driver script could exceed them.
    const auto has_script = [](const auto& model) { return !model.second.hardware.script.empty(); };
    const auto is_wire = [](const ComponentEntry* entry) { return find_device_kind(entry->type) != nullptr; };
    const auto components = entries_of<ComponentEntry>(*system);
    if (std::any_of(system->models.begin(), system->models.end(), has_script) ||
        std::any_of(components.begin(), components.end(), is_wire))
        return failure(
            "--hw: a class can't share a robot whose driver is a script, or a device such as a serial line: pupils "
            "could replace the driver");
    shared.hardware.push_back(words.web.hw.text == "true" ? "--hw" : "--hw=" + words.web.hw.text);
    for (const auto& [option, folder] :
         {std::pair{"--dev-root", hardware->dev_root}, {"--sys-root", hardware->sys_root}}) {
        shared.hardware.insert(shared.hardware.end(), {option, folder});
        shared.devices.emplace_back(folder);
    }
    return shared;
}

int run_class(const ClassWords& words) {
    RunWords of_run = words.web;
    of_run.file = words.folder;
    const auto read = read_run_options(of_run);
    if (!read) return refuse(read.error());
    std::error_code problem;
    if (!words.collect.empty() && !std::filesystem::is_directory(words.folder, problem))
        return refuse(Error{"there is no such class folder" + did_you_mean_path(words.folder), {words.folder}});
    std::filesystem::create_directories(words.folder, problem);
    const std::filesystem::path folder = std::filesystem::canonical(words.folder, problem);
    if (problem) return refuse({"can't be made: " + problem.message(), {words.folder}});
    web::ClassOptions options{.folder = folder, .program = own_program(), .trust = words.trust};
    for (const std::filesystem::path& installed : installed_folders()) {
        options.exercises.push_back(installed / exercises_folder);
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
    if (!words.quota.empty()) {
        const auto megabytes = number_in<std::uintmax_t>(words.quota);
        if (!megabytes || *megabytes < 1 || *megabytes > 1000)
            return refuse("--quota must be a whole number of megabytes from 1 to 1000, not " + visible(words.quota));
        options.quota.bytes = *megabytes << 20U;
    }
    auto shared = shared_of(words, read->hardware);
    if (!shared) return refuse(shared.error());
    options.shared = std::move(*shared);
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
    options.push_back({"--shared", &words->shared,
                       "also run this system, by path or name: pupils queue, and drive it one after the other",
                       "SYSTEM"});
    constexpr std::string_view same[] = {"--listen", "--port", "--hw", "--dev-root", "--sys-root"};
    for (Option& each : run_options(words->web)) {
        if (std::find(std::begin(same), std::end(same), each.name) != std::end(same))
            options.push_back(std::move(each));
    }
    options.push_back(
        {"--collect", &words->collect,
         "instead: copy all work into this folder, check it, and write results.csv and results.xml (JUnit)", "FOLDER"});
    options.push_back(
        {"--quota", &words->quota, "megabytes that the files of a pupil's exercise may have (default 20)", "MB"});
    options.push_back({"--trust", &words->trust,
                       "run on a kernel without Landlock: pupils' programs could then read all your files"});
    return {.name = "class",
            .help = "Serve a class: pupils work in their browsers, the teacher sees how they do",
            .options = std::move(options),
            .run = [words] { return run_class(*words); },
            .footer =
                "Each pupil gets a copy of the exercise and a system of their own, which can't access anything else. "
                "Ctrl-C ends the class;\nthe work stays in DIR, and pupils come back with their codes. See "
                "docs/classroom.md."};
}

}  // namespace nezumi::cli
