// The words `network` and `ros`: what a system sends to other hosts, and receives from them.
#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/read_record.hpp"
#include "bindings/lua/files/system_words.hpp"
#include "engine/base/names.hpp"
#include "engine/system/system_fields.hpp"

namespace nezumi {
namespace {

// The error if this is not a topic name of ROS, or "" (ROS 2 design, "Topic and Service name mapping to DDS").
std::string problem_of_topic(std::string_view topic) {
    if (topic.size() < 2 || topic.front() != '/') return "expected a whole name as \"/odom\"";
    bool begins = false;  // a token of the name begins
    for (const char c : topic) {
        const bool digit = c >= '0' && c <= '9';
        const bool fits = digit || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (c == '/' ? begins : !fits || (begins && digit))
            return "expected tokens of letters, digits and _ between slashes, none beginning with a digit";
        begins = c == '/';
    }
    return begins ? "expected no slash at the end" : "";
}

// Whether a text has the form of an address or a host name, perhaps with a port. Does not check whether the host
// exists.
bool could_be_address(const std::string& text) {
    const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || std::strchr(".-_:[]%", c) != nullptr; };
    if (text.empty() || !std::all_of(text.begin(), text.end(), fits)) return false;
    if (text.find_first_not_of("0123456789.") != text.npos) return true;
    in_addr address{};
    return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

void check_peers(FieldCheck& check, const std::vector<std::string>& peers) {
    for (const std::string& each : peers) {
        if (check.ok() && !could_be_address(each))
            check.wrong({"peers"}, fmt::format("expected addresses or names of hosts, got '{}'", shown(each)));
    }
}

// Reads one entry of `publish` or `subscribe`: a text, or a table with more. `name` is the key of the entry.
void read_topic(FieldCheck& check, const Value& value, const FieldPath& path, const std::string& name, bool publishes,
                std::vector<RosTopic>& out) {
    RosTopic topic;
    topic.place = check.place_of(path);
    if (const std::string* text = value.get_if<std::string>()) {
        (publishes ? topic.topic : topic.port) = *text;
    } else if (value.get_if<FileTable>() != nullptr) {
        Fields fields(check, value, path);
        read_record(fields, topic);
        const std::string_view key = publishes ? "port" : "topic";
        if (fields.has(key)) check.wrong(fields.path_of(key), fmt::format("is given already, by the name '{}'", name));
        fields.require(publishes ? "topic" : "port", publishes ? "a text: the topic" : "a text: \"name.port\"");
        fields.done();
    } else {
        check.wrong(path, fmt::format("expected a text or a table, got {}", kind_of(value)));
    }
    (publishes ? topic.port : topic.topic) = name;
    if (!check.ok()) return;
    if (const std::string problem = problem_of_topic(topic.topic); !problem.empty())
        return check.wrong(path, fmt::format("names no topic '{}': {}", topic.topic, problem));
    out.push_back(std::move(topic));
}

// Reads `publish`, from ports to topics (a list for several topics of a port), or `subscribe`, from topics to ports.
void read_topics(Fields& fields, std::string_view name, std::vector<RosTopic>& out) {
    const bool publishes = name == "publish";
    Fields table = fields.inner(name);
    for (const FileField& each : table.all()) {
        const Value& value = *table.field(each.name);
        const FieldPath path = table.path_of(each.name);
        const FileTable* list = value.get_if<FileTable>();
        if (!publishes || list == nullptr || list->elements.empty() || !list->fields.empty()) {
            read_topic(fields.check(), value, path, each.name, publishes, out);
            continue;
        }
        for (const Value& element : list->elements)
            read_topic(fields.check(), element, path, each.name, publishes, out);
    }
    table.done();
}

// Uses the domain of the environment, as other ROS nodes do.
void use_environment(FieldCheck& check, std::int64_t& domain) {
    const char* said = std::getenv("ROS_DOMAIN_ID");
    if (said == nullptr || *said == '\0') return;
    const std::string_view text = said;
    std::int64_t number = -1;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem == std::errc() && end == text.data() + text.size() && number >= 0 && number <= detail::last_domain) {
        domain = number;
    } else {
        check.wrong_at({}, fmt::format("the environment's ROS_DOMAIN_ID: expected 0 to {}, got '{}'",
                                       detail::last_domain, shown(text)));
    }
}

}  // namespace

Expected<void> SystemWords::network(const WordCall& call, const Value& value) {
    FieldCheck check = check_of(call, value);
    Fields fields(check, value);
    NetworkSpec given;
    given.place = call.place;
    read_record(fields, given);
    fields.done();
    if (check.ok() && !is_identifier(given.name))
        check.wrong({"name"},
                    fmt::format("expected letters, digits and _, not beginning with a digit, got '{}'", given.name));
    if (check.ok() && is_taken_name(given.name))
        check.wrong({"name"}, fmt::format("may not be '{}', a keyword of Lua or a command of the console", given.name));
    if (check.ok() && given.open && !given.secret.empty())
        check.explain({"open"}, "with a `secret`, only hosts that have it may write: leave one of them out");
    if (check.ok() && !given.hosts.empty() && !given.lockstep)
        check.explain({"hosts"}, "only lockstep waits for hosts: say `lockstep = true` as well");
    check_peers(check, given.peers);
    for (const std::string& host : given.hosts) {
        if (!check.ok()) break;
        if (!is_identifier(host)) check.wrong({"hosts"}, fmt::format("expected names of hosts, got '{}'", host));
        if (host == given.name) check.wrong({"hosts"}, fmt::format("may not name '{}': it is this host", host));
    }
    if (auto ok = check.result(); !ok) return ok;
    if (spec_.network) return repeated(call, spec_.network->place);
    // The secret is not read here, because everything that is read for a system is recorded.
    if (const auto path = project_.find(FileKind::data, given.secret, call.place.file); path && !given.secret.empty())
        given.secret_path = path->string();
    spec_.network = std::move(given);
    return {};
}

Expected<void> SystemWords::ros(const WordCall& call, const Value& value) {
    FieldCheck check = check_of(call, value);
    Fields fields(check, value);
    RosSpec given;
    given.place = call.place;
    read_record(fields, given);
    if (!fields.has("domain")) use_environment(check, given.domain);
    read_topics(fields, "publish", given.publish);
    read_topics(fields, "subscribe", given.subscribe);
    fields.done();
    check_peers(check, given.peers);
    if (check.ok() && !is_identifier(given.node))
        check.wrong({"node"},
                    fmt::format("expected letters, digits and _, not beginning with a digit, got '{}'", given.node));
    if (auto ok = check.result(); !ok) return ok;
    if (spec_.ros) return repeated(call, spec_.ros->place);
    spec_.ros = std::move(given);
    return {};
}

Expected<void> SystemWords::check_network() const {
    for (const ConnectionSpec& each : spec_.connections) {
        if (!is_remote(each.from) && !is_remote(each.to)) continue;
        const std::string& remote = is_remote(each.from) ? each.from : each.to;
        const auto refuse = [&](std::string_view why) {
            return failure(fmt::format("connect: {}: {}", remote, why), each.place);
        };
        if (!spec_.network) return refuse("a port of another host needs the word network { name = ... }");
        if (is_remote(each.from) && is_remote(each.to))
            return refuse("both ends are on other hosts: one of these connects them");
        if (host_of(remote) == spec_.network->name)
            return refuse(
                fmt::format("this host is '{}' itself: write \"{}\"", spec_.network->name, without_host(remote)));
    }
    if (!spec_.network || !spec_.ros || spec_.network->domain != spec_.ros->domain) return {};
    if (spec_.network->interface == spec_.ros->interface && spec_.network->peers == spec_.ros->peers) return {};
    return failure(fmt::format("ros: is in domain {} as network is: 'interface' and 'peers' must be the same in both",
                               spec_.ros->domain),
                   spec_.ros->place);
}

}  // namespace nezumi
