// A recording with a journal is replayed. Otherwise each component is a device that plays its recorded messages.
#include "bindings/cli/files/recorded_system.hpp"

#include <utility>

#include "bindings/cli/base/version.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

SystemSpec system_of(const RecordedPorts& ports, const std::string& file) {
    SystemSpec spec;
    spec.file = file;
    spec.rate = recorded_rate;
    for (const auto& [name, of] : ports) {
        ComponentEntry entry;
        entry.name = name;
        entry.type = RecordedDevice::type_name;
        entry.place = {file, 1};
        spec.entries.emplace_back(std::move(entry));
    }
    return spec;
}

// Fails if this version of nezumi can't repeat the run to its end, which is tried for a run of another version. Then
// the messages of the recording are used instead.
Expected<void> check_repeats(std::string_view journal, const std::filesystem::path& file, LiveOptions options) {
    const auto replay = Replay::of_text(journal, file, version());
    if (!replay) return Unexpected(replay.error());
    if ((*replay)->other_version().empty()) return {};
    options.build.log = {};
    options.print = {};
    const auto live = (*replay)->load(std::move(options));
    if (!live) return Unexpected(live.error());
    (*live)->activate();
    for (;;) {
        const auto more = (*replay)->before_tick(**live);
        if (!more) return Unexpected(more.error());
        if (!*more) return {};
        (*live)->tick();
    }
}

}  // namespace

Expected<std::unique_ptr<RecordedSystem>> RecordedSystem::open(const std::filesystem::path& file,
                                                               const std::map<std::string, std::string>& names,
                                                               LiveOptions options) {
    const std::string name = file.string();
    auto bytes = read_whole(file, name, Replay::largest);
    if (!bytes) return Unexpected(bytes.error());
    auto made = std::make_unique<RecordedSystem>();
    const auto replay = [&](std::string_view journal) -> Expected<void> {
        auto read = Replay::of_text(journal, file, version());
        if (!read) return Unexpected(read.error());
        made->replay_ = std::move(*read);
        return {};
    };
    if (!record::is_mcap(*bytes)) {
        if (!names.empty()) return failure("a journal has no topics", {name});
        if (auto read = replay(*bytes); !read) return Unexpected(read.error());
    }
    if (made->replay_ == nullptr) {
        const auto recording = record::read_mcap(*bytes, name);
        if (!recording) return Unexpected(recording.error());
        // A run of real robots has a journal too, which can't be repeated.
        if (const auto journal = record::journal_of(*recording, name); journal && names.empty()) {
            auto repeats = check_repeats(*journal, file, options);
            if (repeats) repeats = replay(*journal);
            if (!repeats) made->notes_.push_back(describe(repeats.error()));
        }
        if (made->replay_ == nullptr) {
            auto ports = read_topics(*recording, name, recorded_rate, names, made->notes_);
            if (!ports) return Unexpected(ports.error());
            made->ports_ = std::move(*ports);
            made->ticks_ = TopicReader(*recording, name, recorded_rate).ticks();
        }
    }
    if (made->replay_ != nullptr) {
        made->ticks_ = made->replay_->ticks();
        auto live = made->replay_->load(std::move(options));
        if (!live) return Unexpected(live.error());
        made->live_ = std::move(*live);
        return made;
    }
    options.components[std::string(RecordedDevice::type_name)][std::string(simulated)] =
        [ports = &made->ports_](const ComponentEntry& entry, System&) -> Expected<std::unique_ptr<Component>> {
        auto device = std::make_unique<RecordedDevice>(entry.name);
        for (const auto& [port, recorded] : ports->at(entry.name)) device->add(port, recorded);
        return device;
    };
    made->given_ = std::make_unique<GivenSystem>(*options.scripts, system_of(made->ports_, name));
    options.scripts = made->given_.get();
    options.watch = false;
    auto live = RunningSystem::load(file, std::move(options));
    if (!live) return Unexpected(live.error());
    made->live_ = std::move(*live);
    return made;
}

Expected<bool> RecordedSystem::before_tick(RunningSystem& live) {
    if (replay_ != nullptr) return replay_->before_tick(live);
    return live.when().tick < ticks_;
}

}  // namespace nezumi::cli
