// Sends the output of `nezumi test` unchanged to the page, which reads it.
#include "bindings/web/scenario_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/web/edited_files.hpp"
#include "engine/base/find_files.hpp"
#include "engine/base/json_text.hpp"
#include "engine/base/list.hpp"
#include "engine/base/program.hpp"
#include "engine/base/thread.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

// The folder in which `nezumi test` keeps the files of failed scenarios.
constexpr std::string_view kept_runs = "nezumi-test/";

constexpr double longest_judgement = 120;                                      // [s]
constexpr std::size_t largest_plot = 4'000'000, largest_coverage = 2'000'000;  // [bytes]

// Half of the cores, so that the running system has the others.
std::string number_of_jobs() { return std::to_string(std::max(1U, std::thread::hardware_concurrency() / 2)); }

// Calls a function again and again in another thread, and once more in the destructor.
class Repeated {
public:
    explicit Repeated(std::function<void()> work) : work_(std::move(work)) {
        try {
            thread_ = start_thread([this] {
                while (!ends_) {
                    work_();
                    std::this_thread::sleep_for(std::chrono::milliseconds(50));
                }
            });
        } catch (const std::system_error&) {
            // Without a thread, the function is called only in the destructor.
        }
    }
    ~Repeated() {
        ends_ = true;
        if (thread_.joinable()) thread_.join();
        work_();
    }
    Repeated(const Repeated&) = delete;
    Repeated& operator=(const Repeated&) = delete;

private:
    std::function<void()> work_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// Runs a program, and calls `work` again and again while it runs.
Expected<ProgramEnd> run_watched(const ProgramRun& run, const std::function<void()>& work) {
    const Repeated repeated(work);
    return run_program(run);
}

// The address in "in a browser: ADDRESS"; "" while there is none.
std::string address_in(const std::string& said) {
    constexpr std::string_view before = "in a browser: ";
    const auto begin = said.find(before);
    const auto end = begin == std::string::npos ? begin : said.find('\n', begin);
    return end == std::string::npos ? "" : said.substr(begin + before.size(), end - begin - before.size());
}

// The plots of measures in a folder, by their names; empty without measures.
nlohmann::ordered_json plots_in(const std::filesystem::path& folder) {
    constexpr std::size_t most = 12;
    constexpr std::size_t longest = std::size_t{256} << 10;  // [bytes]
    auto plots = nlohmann::ordered_json::object();
    std::error_code problem;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
        const auto text = read_whole(file, file.string(), longest);
        if (text && file.extension() == ".svg" && plots.size() < most) plots[file.stem().string()] = *text;
    }
    return plots;
}

// True for the folder of a failed run, as the report of a run names it.
bool is_kept_run(std::string_view folder) {
    if (!folder.starts_with(kept_runs)) return false;
    folder.remove_prefix(kept_runs.size());
    return !folder.empty() && folder.find('/') == std::string_view::npos && folder.front() != '.';
}

Expected<void> check_file(const std::string& file) {
    if (auto ok = EditedFiles::check_name(file); !ok) return ok;
    if (file.front() == '-') return failure("'" + shown(file) + "' begins with '-': rename it");
    return {};
}

}  // namespace

Expected<std::vector<std::string>> words_of_page(const TestMessage& message, const std::filesystem::path& project) {
    if (message.what == TestMessage::What::open) {
        if (!is_kept_run(message.file))
            return failure("'" + shown(message.file) + "' is not the folder of a failed run");
        return std::vector<std::string>{"open", (project / message.file).string()};
    }
    if (auto ok = check_file(message.file); !ok) return Unexpected(ok.error());
    if (message.name.empty()) return failure("'name' must be the name of a scenario");
    return std::vector<std::string>{"test",   "--project", project.string(), "--filter=" + message.name,
                                    "--show", message.file};
}

ScenarioRuns::ScenarioRuns(std::filesystem::path project, std::string program, std::string listen, Send send)
    : project_(std::move(project)), program_(std::move(program)), listen_(std::move(listen)), send_(std::move(send)) {}

ScenarioRuns::~ScenarioRuns() {
    ends_ = true;
    stops_ = true;
}

Expected<void> ScenarioRuns::start(ClientId client, std::int64_t id, const TestMessage& message) {
    if (message.what == TestMessage::What::stop) {
        stops_ = true;
        answer(client, id, true, "");
        return {};
    }
    if (project_.empty()) return failure("this is not a project: there is no folder behaviors/");
    if (program_.empty())
        return failure("this program can't run scenarios: use `nezumi test`, or the page of `nezumi run`");
    const Unexpected busy = failure("too many requests wait: try again");
    if (message.what == TestMessage::What::list) {
        if (!lists_.put([this, client, id] { list(client, id); })) return busy;
        return {};
    }
    if (message.what == TestMessage::What::recordings) {
        const auto tell = [this, client, id] {
            answer(client, id, true, "", nlohmann::ordered_json(recordings()).dump());
        };
        if (!lists_.put(tell)) return busy;
        return {};
    }
    if (message.what == TestMessage::What::judge) {
        const auto job = [this, client, id, message] { judge(client, id, message.file, message.name); };
        if (!lists_.put(job)) return busy;
        return {};
    }
    if (message.what == TestMessage::What::open || message.what == TestMessage::What::watch) {
        const auto words = words_of_page(message, project_);
        if (!words) return Unexpected(words.error());
        for (OpenRun& page : pages_) {
            if (page.is_used.exchange(true)) continue;
            const auto job = [this, client, id, words = *words, &page] {
                open(client, id, words);
                page.is_used = false;
            };
            if (page.thread.put(job)) return {};
            page.is_used = false;
        }
        return failure(fmt::format("{} runs are open already: close their pages first", most_open));
    }
    if (!message.file.empty()) {
        if (auto ok = check_file(message.file); !ok) return ok;
    }
    if (is_running_.exchange(true)) return failure("scenarios are running already: stop them first");
    stops_ = ends_.load();
    if (!runs_.put([this, client, message] { run(client, message); })) {
        is_running_ = false;
        return busy;
    }
    answer(client, id, true, "");
    return {};
}

void ScenarioRuns::list(ClientId client, std::int64_t id) const {
    const UnnamedFile errors;
    const auto end = run_program({.words = {program_, "test", "--project", project_.string(), "--list"},
                                  .errors = errors.file(),
                                  .keeps_output = true,
                                  .give_up = &ends_});
    const bool ok = end && end->status == 0;
    const std::string said(trimmed(errors.text()));
    answer(client, id, ok, ok ? "" : said.empty() ? problem_of(end) : said, end ? end->out : "");
}

void ScenarioRuns::run(ClientId client, const TestMessage& message) {
    std::vector<std::string> words{
        "nice", "-n", "10", program_, "test", "--project", project_.string(), "--tap", "--jobs", number_of_jobs()};
    // The names begin with a dot, so that they differ from the folders of failed runs.
    const std::filesystem::path plots = project_ / kept_runs / ".plots", covered = project_ / kept_runs / ".coverage";
    std::error_code ignored;
    for (const auto& folder : {plots, covered}) std::filesystem::remove_all(folder, ignored);
    words.insert(words.end(), {"--plots", plots.string(), "--coverage", covered.string()});
    if (!message.name.empty()) words.push_back("--filter=" + message.name);
    if (!message.file.empty()) words.push_back(message.file);
    const UnnamedFile output;
    const UnnamedFile errors;
    std::size_t sent = 0;
    const auto tell = [&] {
        std::string text = output.text();
        text.erase(0, sent);
        text.resize(text.rfind('\n') + 1);  // sends only whole lines
        if (text.empty()) return;
        sent += text.size();
        send_(client, json_text(Json{{"is", "tests"}, {"text", text}}));
    };
    const auto end = run_watched({.words = std::move(words),
                                  .output = output.file(),
                                  .errors = errors.file(),
                                  .longest = longest_run,
                                  .give_up = &stops_},
                                 tell);
    std::string problem;
    if (!end || end->status > 1) {
        problem = trimmed(errors.text());
        if (problem.empty()) problem = stops_ ? "stopped" : problem_of(end);
    }
    const auto drawn = plots_in(plots);
    const std::string coverage = read_whole(covered / "lcov.info", "the coverage", largest_coverage).value_or("");
    for (const auto& folder : {plots, covered}) std::filesystem::remove_all(folder, ignored);
    std::filesystem::remove(plots.parent_path(), ignored);  // if nothing else is in it
    is_running_ = false;
    send_(client,
          json_text(
              Json{{"is", "tests"}, {"done", true}, {"problem", problem}, {"plots", drawn}, {"coverage", coverage}}));
}

void ScenarioRuns::open(ClientId client, std::int64_t id, const std::vector<std::string>& what) {
    std::vector<std::string> words{"nice", "-n", "10", program_};
    words.insert(words.end(), what.begin(), what.end());
    if (!listen_.empty()) words.insert(words.end(), {"--listen", listen_});
    const UnnamedFile output;
    bool is_answered = false;
    const auto look = [&] {
        const std::string address = is_answered ? "" : address_in(output.text());
        if (address.empty()) return;
        is_answered = true;
        answer(client, id, true, "", address);
    };
    const auto end = run_watched({.words = std::move(words),
                                  .output = output.file(),
                                  .errors = output.file(),
                                  .longest = longest_run,
                                  .give_up = &ends_},
                                 look);
    const std::string said(trimmed(output.text()));
    if (!is_answered) answer(client, id, false, said.empty() ? problem_of(end) : said);
}

std::vector<std::string> ScenarioRuns::recordings() const {
    std::vector<std::string> names;
    for (const std::string_view ending : {".mcap", ".journal"}) {
        for (const auto& file : find_files(project_, ending).files) {
            if (std::error_code problem; !std::filesystem::is_symlink(file, problem))
                names.push_back(file.lexically_relative(project_).generic_string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

void ScenarioRuns::judge(ClientId client, std::int64_t id, const std::string& recording, const std::string& behavior) {
    // Accepts only files that were found in the project, so no name leads out of it.
    if (!contains(recordings(), recording))
        return answer(client, id, false, "'" + shown(recording) + "' is not a recording of this project");
    if (!behavior.ends_with(".lua") || !contains(EditedFiles(project_).names(), behavior))
        return answer(client, id, false, "'" + shown(behavior) + "' is not a behaviour of this project");
    const std::filesystem::path plot = project_ / kept_runs / ".judged.svg";
    std::error_code ignored;
    std::filesystem::create_directories(plot.parent_path(), ignored);
    std::filesystem::remove(plot, ignored);
    const UnnamedFile errors;
    const auto end = run_program({.words = {"nice", "-n", "10", program_, "judge", (project_ / recording).string(),
                                            "--behavior", (project_ / behavior).string(), "--plot", plot.string()},
                                  .errors = errors.file(),
                                  .keeps_output = true,
                                  .longest = longest_judgement,
                                  .give_up = &ends_});
    const bool ok = end && end->status <= 1;
    const std::string said(trimmed(errors.text()));
    const auto picture = read_whole(plot, plot.string(), largest_plot);
    std::filesystem::remove(plot, ignored);
    std::filesystem::remove(plot.parent_path(), ignored);  // if nothing else is in it
    answer(client, id, ok, ok ? end->out : said.empty() ? problem_of(end) : said, ok && picture ? *picture : "");
}

void ScenarioRuns::answer(ClientId client, std::int64_t id, bool ok, const std::string& text,
                          const std::string& content) const {
    send_(client, json_text(Json{{"is", "answer"}, {"id", id}, {"ok", ok}, {"text", text}, {"content", content}}));
}

}  // namespace nezumi::web
