// `network` and `ros`: what a system shows to other hosts, and takes from them.
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

// Why this is no name of a topic of ROS, or "" (ROS 2 design, "Topic and Service name mapping to DDS").
std::string problem_of_topic(std::string_view topic) {
    if (topic.size() < 2 || topic.front() != '/') return "expected a whole name as \"/odom\"";
    bool begins = false;  // a token of the name
    for (const char c : topic) {
        const bool digit = c >= '0' && c <= '9';
        const bool fits = digit || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (c == '/' ? begins : !fits || (begins && digit))
            return "expected tokens of letters, digits and _ between slashes, none beginning with a digit";
        begins = c == '/';
    }
    return begins ? "expected no slash at the end" : "";
}

// Whether a text can be an address or a host's name, perhaps with a port; whether there is such a host is not known
// here.
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

// Reads one entry of `publish` or `subscribe`: a text, or a table that says more. `name` is what it stands for.
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
        if (fields.has(key)) check.wrong(fields.path_of(key), fmt::format("is said already, by the name '{}'", name));
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

// Reads `publish`, from ports to topics, where a list gives a port several, or `subscribe`, from topics to ports.
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

// As other nodes of ROS find their domain where nobody says it.
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

Expected<void> said_once(const WordCall& call, const Place* before) {
    if (before == nullptr) return {};
    return failure(fmt::format("{}: is set already, at {}:{}", call.word, before->file, before->line), call.place);
}

}  // namespace

Expected<void> SystemWords::network(const WordCall& call, const Value& value) {
    FieldCheck check("network", call.word, call.place, call.source);
    check.set_given({"", &value});
    Fields fields(check, value);
    NetworkSpec given;
    given.place = call.place;
    read_record(fields, given);
    fields.done();
    if (check.ok() && !is_identifier(given.name))
        check.wrong({"name"},
                    fmt::format("expected letters, digits and _, not beginning with a digit, got '{}'", given.name));
    if (check.ok() && is_taken_name(given.name))
        check.wrong({"name"}, fmt::format("may not be '{}', a word of Lua or of the console", given.name));
    if (check.ok() && given.open && !given.secret.empty())
        check.explain({"open"}, "with a `secret` only those who have it may write: leave one of them out");
    if (check.ok() && !given.hosts.empty() && !given.lockstep)
        check.explain({"hosts"}, "only lockstep waits for hosts: say `lockstep = true` as well");
    check_peers(check, given.peers);
    for (const std::string& host : given.hosts) {
        if (!check.ok()) break;
        if (!is_identifier(host)) check.wrong({"hosts"}, fmt::format("expected names of hosts, got '{}'", host));
        if (host == given.name) check.wrong({"hosts"}, fmt::format("may not name '{}': it is this host", host));
    }
    if (auto ok = check.result(); !ok) return ok;
    if (auto once = said_once(call, spec_.network ? &spec_.network->place : nullptr); !once) return once;
    // It is not read here: what a system was read from is recorded.
    if (const auto path = project_.find(FileKind::data, given.secret, call.place.file); path && !given.secret.empty())
        given.secret_path = path->string();
    spec_.network = std::move(given);
    return {};
}

Expected<void> SystemWords::ros(const WordCall& call, const Value& value) {
    FieldCheck check("ros", call.word, call.place, call.source);
    check.set_given({"", &value});
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
    if (auto once = said_once(call, spec_.ros ? &spec_.ros->place : nullptr); !once) return once;
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
