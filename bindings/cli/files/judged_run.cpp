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

// True if the run can be replayed: it has a journal (recordings of other programs have none), no real robots, and was
// made by this version (another version may behave differently).
bool can_be_repeated(const record::McapFile& recording, const std::string& name) {
    const auto journal = record::journal_of(recording, name);
    if (!journal) return false;
    const auto replay = Replay::of_text(*journal, name, version());
    return replay && (*replay)->other_version().empty();
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

// The component of a recorded system whose behaviour has this file.
Expected<std::string> user_of(const SystemSpec& spec, const fs::path& behavior) {
    std::vector<std::string> users;
    for (const BehaviorEntry* each : entries_of<BehaviorEntry>(spec)) {
        if (fs::path(each->path).filename() == behavior.filename()) users.push_back(each->name);
    }
    if (users.size() == 1) return users.front();
    return failure(fmt::format("--component: {} in the recorded system {} {}: give --component NAME",
                               users.empty() ? "no behaviour" : "several behaviours",
                               users.empty() ? "has the file" : "have the file", behavior.filename().string()));
}

// The drive without its messages, from the journal in a recording of nezumi. std::nullopt if `--map` names ports of a
// component that is not in the recorded system: then only messages are taken from the recording.
Expected<std::optional<RecordedDrive>> drive_without_messages(Replay& record, std::string component,
                                                              const JudgeRequest& request, const fs::path& behavior) {
    const auto spec = record.spec(simulated_systems());
    if (!spec) return Unexpected(spec.error());
    if (!request.map.empty() && find_entry<BehaviorEntry>(*spec, component) == nullptr) return std::nullopt;
    if (component.empty()) {
        auto user = user_of(*spec, behavior);
        if (!user) return Unexpected(user.error());
        component = std::move(*user);
    }
    const auto entry = recorded_behavior(*spec, component);
    if (!entry) return Unexpected(entry.error());
    auto acts = record.acts_on(component);
    if (!acts) return Unexpected(acts.error());
    RecordedDrive drive{
        .entry = **entry, .rate = spec->rate, .physics_step = spec->physics_step, .seed = record.seed_of(*spec)};
    drive.acts = std::move(*acts);
    return drive;
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
        auto user = user_of((*live)->spec(), behavior);
        if (!user) return Unexpected(user.error());
        component = std::move(*user);
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
    JudgedRun run;
    run.behavior_ = behavior;
    const auto journal = record::journal_of(recording, request.run);
    const auto record = journal ? Replay::of_record(*journal, request.run, version()) : Unexpected(journal.error());
    bool is_own = false;
    if (record) {
        auto drive = drive_without_messages(**record, component, request, behavior);
        if (!drive) return Unexpected(drive.error());
        is_own = drive->has_value();
        if (is_own) run.drive_ = std::move(**drive);
    }
    if (is_own) component = run.drive_.entry.name;
    if (component.empty()) component = behavior.stem().string();
    run.drive_.entry.name = component;
    run.drive_.entry.script = run.drive_.entry.path = behavior.string();
    SystemSpec alone;
    alone.entries.emplace_back(run.drive_.entry);
    LiveOptions options = simulated_systems();
    options.build.log = [](const LogLine&) {};
    auto live = RunningSystem::make(std::move(alone), Project::of(behavior, installed_folders()), std::move(options));
    if (!live) return Unexpected(live.error());
    const Component& its = *std::as_const(**live).system().find(component);
    const double rate = run.drive_.rate;
    const TopicReader reader = is_own && (*record)->is_of_hardware()
                                   ? TopicReader::of_same_ticks(recording, request.run, rate, (*record)->end_tick())
                                   : TopicReader(recording, request.run, rate);
    if (auto read = read_drive(run.drive_, recording, reader, request.run, its, *topics); !read)
        return Unexpected(read.error());
    if (!is_own) read_parameters(run.drive_, recording, reader, its);
    return run;
}

Expected<JudgedRun> JudgedRun::read(const JudgeRequest& request) {
    const auto found = find_behavior_file(request.behavior);
    if (!found) return Unexpected(found.error());
    const fs::path& behavior = *found;
    auto bytes = read_whole(request.run, request.run, Replay::largest);
    if (!bytes) return Unexpected(bytes.error());
    if (!record::is_mcap(*bytes)) {
        if (!request.map.empty()) return failure("a journal has no topics: leave out --map");
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
