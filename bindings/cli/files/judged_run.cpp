// The run comes from a journal, or from the topics of a recording.
#include "bindings/cli/files/judged_run.hpp"

#include <fmt/format.h>

#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

// A replay can't be of real robots, and another program's recording has no journal.
bool can_be_repeated(const record::McapFile& recording, const std::string& name) {
    const auto journal = record::journal_of(recording, name);
    return journal && Replay::of_text(*journal, name, version());
}

Expected<TopicsOfPorts> topics_in(const std::map<std::string, std::string>& map, std::string& component) {
    TopicsOfPorts topics;
    for (const auto& [topic, port] : map) {
        const std::size_t dot = port.find('.');
        if (topic.empty() || dot == port.npos || dot + 1 == port.size())
            return failure(fmt::format("--map: expected TOPIC=COMPONENT.PORT, as in /scan=keeper.rays, got '{}={}'",
                                       shown(topic), shown(port)));
        const std::string of = port.substr(0, dot);
        if (!component.empty() && component != of)
            return failure(fmt::format("--map: '{}' is not a port of {}", shown(port), component));
        component = of;
        topics[port.substr(dot + 1)] = topic;
    }
    return topics;
}

// The behaviours of a run with this file, by their names.
std::vector<std::string> users_of(const RunningSystem& live, const fs::path& behavior) {
    std::vector<std::string> names;
    for (const BehaviorEntry* each : entries_of<BehaviorEntry>(live.spec())) {
        if (fs::path(each->path).filename() == behavior.filename()) names.push_back(each->name);
    }
    return names;
}

}  // namespace

Expected<JudgedRun> JudgedRun::from_journal(const std::string& text, const JudgeRequest& request, fs::path behavior) {
    auto replay = Replay::of_text(text, request.run, version());
    if (!replay) return Unexpected(replay.error());
    LiveOptions options = simulated_systems();
    options.build.log = [](const LogLine&) {};
    auto live = (*replay)->load(std::move(options));
    if (!live) return Unexpected(live.error());
    std::string component = request.component;
    if (component.empty()) {
        const std::vector<std::string> users = users_of(**live, behavior);
        if (users.size() != 1) {
            return failure(fmt::format("--component: {} in the recorded system {} {}: give --component NAME",
                                       users.empty() ? "no behaviour" : "several behaviours",
                                       users.empty() ? "has the file" : "have the file", behavior.filename().string()));
        }
        component = users.front();
    }
    auto drive = drive_of(**replay, **live, component);
    if (!drive) return Unexpected(drive.error());
    drive->entry.script = drive->entry.path = behavior.string();
    JudgedRun run;
    run.replay_ = std::move(*replay);
    run.then_ = std::move(*live);
    run.drive_ = std::move(*drive);
    run.behavior_ = std::move(behavior);
    return run;
}

Expected<JudgedRun> JudgedRun::from_topics(const record::McapFile& recording, const JudgeRequest& request,
                                           const fs::path& behavior) {
    std::string component = request.component;
    const auto topics = topics_in(request.map, component);
    if (!topics) return Unexpected(topics.error());
    if (component.empty()) component = behavior.stem().string();
    JudgedRun run;
    run.behavior_ = behavior;
    run.drive_.entry.name = component;
    run.drive_.entry.script = run.drive_.entry.path = behavior.string();
    SystemSpec alone;
    alone.entries.emplace_back(run.drive_.entry);
    LiveOptions options = simulated_systems();
    options.build.log = [](const LogLine&) {};
    auto live = RunningSystem::make(std::move(alone), Project::of(behavior, installed_folders()), std::move(options));
    if (!live) return Unexpected(live.error());
    const Component& its = *std::as_const(**live).system().find(component);
    if (auto read = read_drive(run.drive_, recording, request.run, its, *topics); !read)
        return Unexpected(read.error());
    return run;
}

Expected<JudgedRun> JudgedRun::read(const JudgeRequest& request) {
    const auto files = find_lua_files(request.behavior);
    if (!files) return Unexpected(files.error());
    const fs::path behavior = files->front();
    auto bytes = read_whole(request.run, request.run, Replay::largest);
    if (!bytes) return Unexpected(bytes.error());
    if (!record::is_mcap(*bytes)) {
        if (!request.map.empty()) return failure("--map: a journal has no topics: leave it out");
        return from_journal(*bytes, request, behavior);
    }
    const auto recording = record::read_mcap(*bytes, request.run);
    if (!recording) return Unexpected(recording.error());
    if (request.map.empty() && can_be_repeated(*recording, request.run))
        return from_journal(*record::journal_of(*recording, request.run), request, behavior);
    return from_topics(*recording, request, behavior);
}

Expected<Judgement> JudgedRun::judge(double tolerance, LogSink log, JudgedCurves* curves) const {
    LiveOptions options = simulated_systems();
    options.installed = installed_folders();
    options.build.log = std::move(log);
    options.budget = headless_budget;
    return nezumi::judge(drive_, Project::of(behavior_, installed_folders()), options, tolerance, curves);
}

void JudgedRun::add_lines(std::vector<std::string>& lines, const Judgement& judged) const {
    const std::string& name = drive_.entry.name;
    if (then_ != nullptr) {
        const auto then = traced_lines(*then_, {.start = then_->when().start, .tick = judged.first_tick}, name);
        if (then && !then->empty()) {
            const auto differing = differing_lines(*then, judged.lines);
            if (!differing.empty())
                lines.push_back(fmt::format("{} executed these lines differently (- then, + now):", name));
            for (const DifferingLine& line : differing)
                lines.push_back(fmt::format("  {} {}", line.of_first ? '-' : '+', line.text));
            return;
        }
    }
    if (!judged.lines.empty()) lines.push_back(fmt::format("{} executes these lines now:", name));
    for (const std::string& line : judged.lines) lines.push_back("  " + line);
}

std::vector<std::string> JudgedRun::text_of(const Judgement& judged) const {
    constexpr std::size_t most = 20;
    std::vector<std::string> lines;
    for (const std::string& note : judged.notes) lines.push_back(visible(note));
    if (judged.different == 0) {
        lines.push_back(fmt::format("equal: what {} writes in {:g} s, {} ticks", drive_.entry.name,
                                    static_cast<double>(judged.ticks) / drive_.rate, judged.ticks));
        return lines;
    }
    lines.push_back(fmt::format("different in {} of {} ticks; first in tick {}, {:g} s", judged.different, judged.ticks,
                                judged.first_tick, judged.first_at));
    for (std::size_t i = 0; i < judged.first.size() && i < most; ++i) {
        const DifferingValue& value = judged.first[i];
        lines.push_back(fmt::format("  {}: {} then, {} now{}", value.name, value.first, value.second,
                                    value.by ? fmt::format(", a difference of {:.6g}", *value.by) : ""));
    }
    add_lines(lines, judged);
    lines.emplace_back("in all:");
    for (const JudgedField& field : judged.fields) {
        lines.push_back(fmt::format(
            "  {}: {} ticks{}", field.name, field.ticks,
            field.largest > 0 ? fmt::format(", largest difference {:.6g} at {:g} s", field.largest, field.largest_at)
                              : ""));
    }
    return lines;
}

}  // namespace nezumi::cli
