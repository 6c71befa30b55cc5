// Sends requests to other hosts, and answers theirs. Each request has a number, so a repeated request is distinguished
// from a new one.
#include "bindings/dds/host_requests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "bindings/dds/wire.hpp"
#include "engine/base/visible.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::dds {
namespace {

// Limits of the work for other hosts between two ticks, so that no tick is late.
constexpr std::size_t most_request_bytes = std::size_t{1} << 20;
constexpr std::size_t most_at_once = 16;
// Kept answers of each run: a host repeats a request before it has sent this many others.
constexpr std::size_t most_kept = 64;
// The largest numbers of other hosts' runs and of writers. Above them, the oldest that are no longer needed are
// removed.
constexpr std::size_t most_askers = 1024, most_writers = 64;

Octets reply_to(const RemoteRequest& request, const Expected<PlainData>& answer) {
    Reply reply{.to = request.from, .number = request.number, .well = answer.has_value()};
    if (answer) {
        reply.values = *answer;
    } else {
        reply.problem = describe(answer.error());
    }
    Octets bytes;
    write_cdr(bytes, on_the_wire, reply);
    return bytes;
}

}  // namespace

Writer* HostRequests::writer_for(const Topic& topic) {
    auto& writer = writers_[topic.name];
    if (writer == nullptr) writer = transport_.write(topic);
    return writer.get();
}

Expected<std::uint64_t> HostRequests::ask(const Question& question, const HostTable& hosts, double now) {
    if (question.host == host_)
        return failure(fmt::format("{0} is this host: write the component's name without '{0}/'", host_));
    const Announcement* host = hosts.find(question.host);
    if (host == nullptr) {
        const auto name_of = [](const Announcement* host) -> std::string_view { return host->head.host; };
        return failure(fmt::format("there is no host '{}'{}", shown(question.host),
                                   did_you_mean(question.host, hosts.all(), name_of)));
    }
    RemoteRequest request{.from = run_,
                          .to = host->run,
                          .number = ++last_,
                          .what = static_cast<std::uint8_t>(question.what),
                          .component = question.component,
                          .name = question.name,
                          .values = question.values};
    Asked& asked = asked_[request.number];
    asked.host = question.host;
    asked.began = now;
    write_cdr(asked.bytes, on_the_wire, request);
    if (asked.bytes.size() > most_request_bytes) {
        asked_.erase(request.number);
        return failure(fmt::format("{}: the message is larger than 1 MiB", shown(question.name)));
    }
    Writer* writer = writer_for(request_topic(question.host));
    if (writer == nullptr) {
        asked_.erase(request.number);
        return failure(transport_.problem());
    }
    asked.sent = now;
    static_cast<void>(writer->write(asked.bytes));
    return request.number;
}

std::optional<Expected<PlainData>> HostRequests::answer(std::uint64_t number, double now) {
    const auto found = asked_.find(number);
    if (found == asked_.end()) return Expected<PlainData>(failure("nothing was asked"));
    Asked& asked = found->second;
    if (!asked.answer && now - asked.began < patience) return std::nullopt;
    Expected<PlainData> got =
        asked.answer
            ? std::move(*asked.answer)
            : failure(fmt::format("host {} has not answered for {} s: the result is unknown", asked.host, patience));
    asked_.erase(found);
    return got;
}

void HostRequests::serve(const HostTable& hosts, const Answer& answer, double now) {
    if (requests_ == nullptr) {
        requests_ = transport_.read(request_topic(host_));
        replies_ = transport_.read(reply_topic(host_));
        if (requests_ == nullptr || replies_ == nullptr) return;
    }
    take_requests(hosts, answer);
    take_replies();
    for (auto each = asked_.begin(); each != asked_.end();) {
        Asked& asked = each->second;
        if (now - asked.began > 2 * patience) {  // the answer is no longer needed
            each = asked_.erase(each);
            continue;
        }
        if (!asked.answer && now - asked.began < patience && now - asked.sent >= repetition) {
            asked.sent = now;
            if (Writer* writer = writer_for(request_topic(asked.host))) static_cast<void>(writer->write(asked.bytes));
        }
        ++each;
    }
}

void HostRequests::take_requests(const HostTable& hosts, const Answer& answer) {
    std::vector<TopicSample> samples = requests_->take();
    if (samples.empty()) return;
    std::map<std::uint64_t, std::string> names;  // by run
    for (const Announcement* host : hosts.all()) names.emplace(host->run, host->head.host);
    for (auto& [run, asker] : askers_) {
        if (names.contains(run)) continue;
        asker.replies.clear();
        asker.over = asker.newest;
    }
    if (askers_.size() > most_askers)
        std::erase_if(askers_, [&](const auto& each) { return !names.contains(each.first); });
    if (writers_.size() > most_writers) {
        std::set<std::string> used;
        for (const auto& [run, name] : names) {
            used.insert(request_topic(name).name);
            used.insert(reply_topic(name).name);
        }
        std::erase_if(writers_, [&](const auto& each) { return !used.contains(each.first); });
    }
    std::size_t done = 0;
    for (const TopicSample& sample : samples) {
        RemoteRequest request;
        if (sample.bytes.size() > most_request_bytes || !read_cdr(sample.bytes, on_the_wire, request)) continue;
        // A host that is not known here does not know this run either: it asks again.
        const auto from = names.find(request.from);
        if (request.to != run_ || from == names.end()) continue;
        Asker& asker = askers_[request.from];
        auto& replies = asker.replies;
        const bool is_old =
            request.number <= asker.over || (replies.size() >= most_kept && request.number < replies.begin()->first);
        if (is_old) continue;
        Writer* writer = writer_for(reply_topic(from->second));
        auto known = replies.find(request.number);
        if (known == replies.end()) {
            if (++done > most_at_once) continue;  // the other host repeats the request
            const auto answered = [&]() -> Expected<PlainData> {
                if (!is_sound(request.values)) return failure("malformed plain data");
                return answer({.host = host_,
                               .component = request.component,
                               .what = static_cast<Question::What>(request.what),
                               .name = request.name,
                               .values = std::move(request.values)},
                              {Actor::Kind::network, from->second});
            }();
            known = replies.emplace(request.number, reply_to(request, answered)).first;
            asker.newest = std::max(asker.newest, request.number);
            if (replies.size() > most_kept) replies.erase(replies.begin());
        }
        if (writer != nullptr) static_cast<void>(writer->write(known->second));
    }
}

void HostRequests::take_replies() {
    for (const TopicSample& sample : replies_->take()) {
        Reply reply;
        if (!read_cdr(sample.bytes, on_the_wire, reply) || reply.to != run_) continue;
        const auto asked = asked_.find(reply.number);
        if (asked == asked_.end() || asked->second.answer) continue;
        auto& answer = asked->second.answer.emplace(std::move(reply.values));
        if (!reply.well) answer = failure(fmt::format("host {}: {}", asked->second.host, visible(reply.problem)));
        if (answer && !is_sound(*answer)) answer = failure("malformed plain data");
    }
}

}  // namespace nezumi::dds
