// A connection has the same id at both ends: that is how the ports of two RTCs find each other.
#include "bindings/openrtm/peers_json.hpp"

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "bindings/openrtm/peer_parameters.hpp"
#include "engine/base/json_text.hpp"

namespace nezumi::openrtm {
namespace {

using PageJson = nlohmann::ordered_json;

// Limits of what the page shows, because other programs are not trusted.
constexpr std::size_t most_peers = 200;
constexpr std::size_t most_ports = 100;
constexpr std::size_t most_ends = 32;  // of one connection
constexpr std::size_t most_parameters = 200;
constexpr std::size_t most_letters = 200;

std::string cut(std::string_view text) { return std::string(text.substr(0, most_letters)); }

std::string_view state_name(PeerSnapshot::State state) {
    constexpr std::array<std::string_view, 8> names{"INACTIVE", "ACTIVE", "ERROR", "CREATED",
                                                    "UNKNOWN",  "SILENT", "GONE",  "UNASKED"};
    return names[static_cast<std::size_t>(state)];
}

std::string_view way_of(const PeerSnapshot::Port& port) {
    return port.type.empty() ? "service" : port.is_in ? "in" : "out";
}

// "ConsoleOut0" for an RTC of this computer; the whole name for others.
std::string_view short_name_in(const PeerSnapshot& peer, std::string_view context) {
    const std::string_view name = peer.name;
    const bool is_here =
        name.size() > context.size() && name.starts_with(context) && name.find('/', context.size()) == context.size();
    const std::string_view rest = is_here ? name.substr(context.size() + 1) : name;
    return is_here && rest.find('/') == std::string_view::npos ? rest : name;
}

PageJson page_json(const ValueView& value) {
    if (value.type->kind == Type::Kind::text) return value.as<std::string>();
    if (value.type->kind != Type::Kind::sequence)
        return visit_number(value, [](const auto& number) { return PageJson(number); });
    PageJson all = PageJson::array();
    for_each_element(value, [&](const ValueView& element) {
        all.push_back(page_json(element));
        return true;
    });
    return all;
}

PageJson page_json(const PeerParameter& parameter) {
    const ParameterSpec& spec = parameter.spec;
    PageJson json{{"name", spec.name},
                  {"type", type_text(spec.initial)},
                  {"value", page_json(ValueView(parameter.value))},
                  {"min", spec.min ? PageJson(*spec.min) : PageJson()},
                  {"max", spec.max ? PageJson(*spec.max) : PageJson()},
                  {"step", spec.step},
                  {"widget", spec.widget},
                  {"options", PageJson::array()}};
    for (const Value& choice : spec.choices) json["options"].push_back(page_json(ValueView(choice)));
    return json;
}

PageJson page_json(const PeerSnapshot& peer, const std::string& name) {
    PageJson json{
        {"name", name},    {"type", cut(peer.type)},    {"state", state_name(peer.state)}, {"ports", PageJson::array()},
        {"set", peer.set}, {"sets", PageJson::array()}, {"parameters", PageJson::array()}};
    for (const PeerSnapshot::Port& port : peer.ports) {
        if (json["ports"].size() == most_ports) break;
        json["ports"].push_back({{"name", cut(port.name)}, {"way", way_of(port)}, {"type", cut(port.type)}});
    }
    for (const auto& [set, values] : peer.sets) {
        if (!set.starts_with("__")) json["sets"].push_back(set);
    }
    for (const PeerParameter& parameter : parameters_of(peer)) {
        if (json["parameters"].size() == most_parameters) break;
        json["parameters"].push_back(page_json(parameter));
    }
    return json;
}

struct End {
    std::string name;  // "rtm:ConsoleOut0.in", or "controller.out" of ours
    std::string_view way;
    bool is_ours = false;
};

PageJson connections_between(const std::map<std::string, std::vector<End>>& by_id) {
    PageJson all = PageJson::array();
    for (const auto& [id, ends] : by_id) {
        for (const End& from : ends) {
            for (const End& to : ends) {
                const bool fits = (from.way == "out" && to.way == "in") ||
                                  (from.way == "service" && to.way == "service" && from.name < to.name);
                if (fits && !(from.is_ours && to.is_ours)) all.push_back({{"from", from.name}, {"to", to.name}});
            }
        }
    }
    return all;
}

}  // namespace

std::string peers_to_json(const PeerAnswer& answer, std::string_view context) {
    PageJson json{{"is", "rtcs"},
                  {"problem", answer.problem},
                  {"context", context},
                  {"rtcs", PageJson::array()},
                  {"ports", PageJson::object()},
                  {"connections", PageJson::array()}};
    std::map<std::string, std::vector<End>> by_id;
    for (const PeerSnapshot& peer : answer.peers) {
        const std::string name = "rtm:" + std::string(short_name_in(peer, context));
        if (!peer.is_ours) {
            if (json["rtcs"].size() == most_peers) break;
            json["rtcs"].push_back(page_json(peer, name));
        }
        for (const PeerSnapshot::Port& port : peer.ports) {
            if (!port.path.empty()) json["ports"][port.path] = port.type;
            const std::string end = port.path.empty() ? name + "." + cut(port.name) : port.path;
            for (const std::string& id : port.connections) {
                std::vector<End>& ends = by_id[id];
                if (ends.size() < most_ends) ends.push_back({end, way_of(port), peer.is_ours});
            }
        }
    }
    json["connections"] = connections_between(by_id);
    return json_text(json);
}

}  // namespace nezumi::openrtm
