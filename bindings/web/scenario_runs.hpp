// The scenarios and recordings of the page: lists them, and runs and judges them in other processes, while ticks
// go on.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bindings/web/job_thread.hpp"
#include "bindings/web/messages.hpp"
#include "bindings/web/site.hpp"

namespace nezumi::web {

/// The arguments of nezumi that show a run in a page of its own: a failed run (`open`), or a new run of a scenario
/// (`watch`). Returns an error if the message names something else.
Expected<std::vector<std::string>> words_of_page(const TestMessage& message, const std::filesystem::path& project);

class ScenarioRuns {
public:
    /// Sends a message to a browser, a JSON object; called in any thread.
    using Send = std::function<void(ClientId client, std::string message)>;

    /// `project` is the folder of the project; empty: there are no scenarios. `program` is nezumi; "": nothing runs.
    /// `listen` is the address for the pages of runs; "": only this computer reaches them.
    ScenarioRuns(std::filesystem::path project, std::string program, std::string listen, Send send);
    /// Ends all running programs.
    ~ScenarioRuns();
    ScenarioRuns(const ScenarioRuns&) = delete;
    ScenarioRuns& operator=(const ScenarioRuns&) = delete;

    /// The answer may come after this returns. During a run the browser also gets {"is":"tests","text":...} with what
    /// `nezumi test --tap` has written since the last of these, and at the end
    /// {"is":"tests","done":true,"problem":...}.
    Expected<void> start(ClientId client, std::int64_t id, const TestMessage& message);

    /// [s] A run of scenarios that takes longer is ended, and so is the page of a run.
    static constexpr double longest_run = 3600;
    /// The most pages of runs that may be open at a time.
    static constexpr std::size_t most_open = 4;

private:
    void list(ClientId client, std::int64_t id) const;
    void run(ClientId client, const TestMessage& message);
    void open(ClientId client, std::int64_t id, const std::vector<std::string>& what);
    // The project's recordings and journals, sorted.
    std::vector<std::string> recordings() const;
    void judge(ClientId client, std::int64_t id, const std::string& recording, const std::string& behavior);
    void answer(ClientId client, std::int64_t id, bool ok, const std::string& text,
                const std::string& content = "") const;

    const std::filesystem::path project_;
    const std::string program_;
    const std::string listen_;
    const Send send_;
    std::atomic<bool> ends_ = false;
    std::atomic<bool> stops_ = false;
    std::atomic<bool> is_running_ = false;
    JobThread lists_;
    JobThread runs_;
    struct OpenRun {
        std::atomic<bool> is_used = false;
        JobThread thread{};
    };
    std::array<OpenRun, most_open> pages_;
};

}  // namespace nezumi::web
