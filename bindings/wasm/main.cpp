// The program of the web build: functions that the page's worker calls, and `run FILE`, which compares hashes in node.
#include <emscripten.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/embed/simulation.hpp"
#include "bindings/wasm/page_run.hpp"
#include "bindings/wasm/to_page.hpp"

using namespace nezumi;

namespace {

std::unique_ptr<web::PageRun>& page_run() {
    static std::unique_ptr<web::PageRun> the;
    return the;
}

void send(const web::Outgoing& message) {
    if (message.binary) {
        send_bytes(message.bytes);
    } else {
        send_text(message.bytes);
    }
}

int take(Expected<std::unique_ptr<web::PageRun>> run) {
    if (!run) return refuse(run.error());
    page_run() = std::move(*run);
    return 0;
}

// Performs `run FILE ... --duration SECONDS ...`, as tests/hashes calls it.
int run_headless(int count, char** words) {
    double seconds = 0;
    for (int i = 3; i + 1 < count; ++i) {
        if (std::strcmp(words[i], "--duration") == 0) seconds = std::atof(words[i + 1]);
    }
    LiveOptions options = simulated_systems({installed_files});
    options.budget = headless_budget;
    options.build.seed = web::usual_seed;
    auto simulation = Simulation::load_with(words[2], std::move(options));
    if (!simulation) return refuse(simulation.error());
    simulation->run(seconds);
    std::printf("trace hash %016llx\n", static_cast<unsigned long long>(simulation->running().trace_hash()));
    return 0;
}

}  // namespace

extern "C" {

/// Opens the run of a page. Returns 0, or 2 with the reason on standard error.
EMSCRIPTEN_KEEPALIVE int nezumi_open(const char* file) {
    page_run().reset();
    return take(web::PageRun::open(file, {installed_files}, send));
}

/// Opens the run of a journal. Returns 0, or 2 with the reason on standard error.
EMSCRIPTEN_KEEPALIVE int nezumi_open_run(const char* journal) {
    page_run().reset();
    return take(web::PageRun::open_run(journal, {installed_files}, send));
}

/// Handles a message of the page.
EMSCRIPTEN_KEEPALIVE void nezumi_receive(const char* text) {
    if (page_run()) page_run()->receive(text);
}

/// Runs for about `seconds`. Returns the time until the next tick is due [s]; negative: the run has ended.
EMSCRIPTEN_KEEPALIVE double nezumi_go_on(double seconds) { return page_run() ? page_run()->go_on(seconds) : -1; }

}  // extern "C"

int main(int count, char** words) {
    if (count >= 3 && std::string_view(words[1]) == "run") return run_headless(count, words);
    return 0;
}
