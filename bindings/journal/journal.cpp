// A separate thread writes complete lines: if the process is killed, the journal has only complete lines, and a slow
// disk delays no tick.
#include "bindings/journal/journal.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bindings/journal/act_json.hpp"
#include "bindings/journal/files_json.hpp"
#include "bindings/journal/value_json.hpp"
#include "engine/base/json_text.hpp"

namespace nezumi {
namespace {

using Json = nlohmann::ordered_json;

Json at(const ActTime& when) { return Json::array({when.start, when.tick, when.sequence}); }

std::string line(const Json& json) { return json_text(json) + "\n"; }

std::string_view name_of(RunEnd how) {
    constexpr std::string_view names[] = {"duration", "stopped", "error"};
    return names[static_cast<std::size_t>(how)];
}

}  // namespace

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

Expected<std::unique_ptr<Journal>> Journal::create(const std::filesystem::path& file) {
    auto opened = ResultFile::open(file);
    if (!opened) return Unexpected(opened.error());
    std::unique_ptr<Journal> journal(new Journal);
    journal->own_.emplace(file.string(), std::move(*opened));
    return journal;
}

std::unique_ptr<Journal> Journal::of_sink(JournalSink sink) {
    std::unique_ptr<Journal> journal(new Journal);
    journal->sink_ = std::move(sink);
    return journal;
}

Journal::~Journal() {
    if (ended_ || !own_) return;
    own_->writer.close();
    own_->file.discard();
}

void Journal::begin(RunningSystem& live, const std::string& version, bool hardware) {
    live_ = &live;
    Json installed = Json::array();
    for (const auto& folder : live.options().installed) installed.push_back(text_to_json(folder.string()));
    Json set = Json::array();
    for (const std::string& each : live.options().values.set) set.push_back(text_to_json(each));
    Json first{{"journal", journal_format},
               {"version", version},
               {"hardware", hardware},
               {"system", text_to_json(live.file().string())},
               {"working_folder", text_to_json(live.project().files().working_folder().string())},
               {"installed", std::move(installed)},
               {"seed", live.options().build.seed},
               {"seed_wins", live.options().build.seed_wins},
               {"params", text_to_json(live.options().values.file)},
               {"set", std::move(set)},
               {"files", files_to_json(known(live.history().files()))}};
    add([first = std::move(first)] { return line(first); });
    live.observe_acts(this);
    flush();
    marked_ = Clock::now();
}

void Journal::serve() {
    if (Clock::now() - marked_ < period) return;
    mark();
    flush();
}

void Journal::mark() {
    marked_ = Clock::now();
    if (live_ == nullptr || live_->when() == last_mark_) return;
    last_mark_ = live_->when();
    add([when = last_mark_, hash = live_->trace_hash()] {
        return line({{"at", at(when)}, {"hash", hash_text(hash)}});
    });
}

void Journal::end(RunEnd how, const std::string& message, const ActTime& when, std::uint64_t hash) {
    if (live_ != nullptr) live_->observe_acts(nullptr);
    live_ = nullptr;
    Json last{{"at", at(when)}, {"end", name_of(how)}, {"hash", hash_text(hash)}};
    if (!message.empty()) last["message"] = text_to_json(message);
    add([last = std::move(last)] { return line(last); });
    flush();
    ended_ = true;
    if (!own_) return;
    fail_with(own_->writer.close());
    if (!error_) {
        own_->file.replace_older();
    } else {
        error_->message += ": the complete lines are kept" + own_->file.told_of_older();
    }
}

FilesSeen Journal::known(FilesSeen files) {
    std::erase_if(files, [this](const auto& found) {
        if (!found.second.what.empty()) known_.insert(found.first);
        return !known_.contains(found.first);
    });
    return files;
}

void Journal::acted(const ActTime& when, std::shared_ptr<const PastAct> act, const Expected<ActResult>& result) {
    if (!is_of_history(act->act, result.has_value())) return;
    FilesSeen files = known(act->files);
    add([when, act = std::move(act), &scripts = *live_->options().scripts, files = std::move(files)] {
        Json json{{"at", at(when)},
                  {"who", text_to_json(to_text(act->who))},
                  {"do", nezumi::name_of(act->act)},
                  {"with", to_json(act->act, scripts)}};
        if (act->failed) json["failed"] = true;
        if (!files.empty()) json["files"] = files_to_json(files);
        return line(json);
    });
}

void Journal::ran_out_of_time(const ActTime& when, const std::string& component, const Component::OutOfTime& call) {
    add([when, component, call] {
        Json ended{{"component", component},
                   {"call", call.call},
                   {"message", text_to_json(call.error.message)},
                   {"file", text_to_json(call.error.place.file)},
                   {"line", call.error.place.line}};
        if (call.left.data) ended["state"] = value_to_json(*call.left.data);
        if (!call.left.lost.empty()) ended["lost"] = text_to_json(call.left.lost);
        return line({{"at", at(when)}, {"out_of_time", std::move(ended)}});
    });
}

void Journal::fail_with(int problem) {
    if (problem == 0 || error_) return;
    error_ = Error{fmt::format("the journal can't be written: {}", why_not_written(problem)), {own_->name}};
}

void Journal::flush() {
    constexpr std::size_t usual_line = 200;  // bytes
    if (!waiting_.empty()) {
        const std::size_t bytes = usual_line * waiting_.size();
        const auto lines = std::make_shared<const std::vector<Line>>(std::exchange(waiting_, {}));
        const auto make = [lines] {
            std::string text;
            for (const Line& each : *lines) text += each();
            return text;
        };
        if (own_) own_->writer.put(bytes, make);
        if (sink_) sink_(bytes, make);
    }
    if (own_) fail_with(own_->writer.problem());
}

}  // namespace nezumi
