// Runs scenarios and checks in the second and third worker of the page. Outside of a page they run in other processes.
#include <emscripten.h>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "bindings/dds/network_maker.hpp"
#include "bindings/embed/simulation.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_session.hpp"
#include "bindings/wasm/to_page.hpp"
#include "engine/base/json_text.hpp"
#include "engine/base/visible.hpp"

namespace nezumi {

// A web page has no connection to other hosts.
namespace dds {
NetworkMaker make_checked_networks() { return {}; }
}  // namespace dds

namespace cli {
std::vector<std::filesystem::path> installed_folders() { return {installed_files}; }
const PeerWords& peer_words() {
    static const PeerWords none;
    return none;
}
}  // namespace cli

namespace {

TestSessionOptions session_options() {
    TestSessionOptions options;
    options.installed = cli::installed_folders();
    options.systems = [] { return simulated_systems(cli::installed_folders()); };
    options.coverage = true;
    return options;
}

Expected<TestPlan> plan_of(const TestSessionOptions& options, const char* file, const char* filter) {
    std::vector<std::filesystem::path> paths;
    if (*file != '\0') paths.emplace_back(file);
    return plan_tests({.paths = paths, .filter = filter, .seed = options.seed, .installed = options.installed});
}

}  // namespace
}  // namespace nezumi

using namespace nezumi;

extern "C" {

/// Sends the names and locations of the scenarios in the working folder. Returns 2 if a file can't be read.
EMSCRIPTEN_KEEPALIVE int nezumi_list_scenarios() {
    const TestSessionOptions options = session_options();
    const auto plan = plan_of(options, "", "");
    if (!plan) return refuse(plan.error());
    int status = 0;
    for (const PlannedFile& file : plan->files) {
        for (const Error& error : file.errors) status = refuse(error);
    }
    for (const PlannedRun& run : plan->runs) {
        const Place& place = plan->files[run.file].scenarios[run.scenario].place;
        send_text(fmt::format("{}  {}:{}\n", run.name, place.file, place.line));
    }
    return status;
}

/// Runs the scenarios of a file, all scenarios, or those that the filter chooses. Sends the report as TAP, piece by
/// piece, and then the coverage. Returns the exit code of `nezumi test`.
EMSCRIPTEN_KEEPALIVE int nezumi_run_scenarios(const char* file, const char* filter) {
    const TestSessionOptions options = session_options();
    const auto plan = plan_of(options, file, filter);
    if (!plan) return refuse(plan.error());
    const auto reporter = tap_reporter([](std::string_view text) { send_text(text); });
    const SessionEnd end = run_tests(*plan, options, *reporter);
    send_text("# coverage\n" + end.coverage.lcov());
    return end.status();
}

/// Sends the errors of a text in the form of `nezumi check --json`.
EMSCRIPTEN_KEEPALIVE void nezumi_check(const char* file, const char* text) {
    auto findings = nlohmann::ordered_json::array();
    for (const Error& error : cli::check_text(text, file, simulated_systems(cli::installed_folders()))) {
        nlohmann::ordered_json finding{{"file", error.place.file}};
        if (error.place.line > 0) finding["line"] = error.place.line;
        if (error.place.column > 0) finding["column"] = error.place.column;
        finding["message"] = error.message;
        findings.push_back(std::move(finding));
    }
    send_text(json_text(findings));
}

}  // extern "C"
