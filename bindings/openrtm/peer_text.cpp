// The format is that of components in the console.
#include "bindings/openrtm/peer_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "engine/base/visible.hpp"

namespace nezumi::openrtm {
namespace {

// A port that is not a data port.
constexpr std::string_view service = "service";

std::string_view to_text(PeerSnapshot::State state) {
    constexpr std::array<std::string_view, 8> texts{
        "INACTIVE",
        "ACTIVE",
        "ERROR",
        "CREATED",
        "without a state",
        "does not answer",
        "no longer exists: its program has crashed, and its name is still in the name service",
        "was not asked: too many others do not answer"};
    return texts[static_cast<std::size_t>(state)];
}

bool answers(const PeerSnapshot& peer) { return peer.state < PeerSnapshot::State::silent; }

// Makes a text fit on one line: a name that another program has chosen must not look like a further line.
std::string one_line(std::string_view text) {
    std::string line = visible(text);
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
}

std::string port_lines(const PeerSnapshot& peer) {
    std::string text;
    std::size_t name_width = 0;
    std::size_t type_width = 0;
    for (const PeerSnapshot::Port& port : peer.ports) {
        name_width = std::max(name_width, one_line(port.name).size());
        type_width = std::max(type_width, port.type.empty() ? service.size() : port.type.size());
    }
    for (const PeerSnapshot::Port& port : peer.ports) {
        const std::string_view direction = port.type.empty() ? "" : port.is_in ? "in" : "out";
        const std::size_t count = port.connections.size();
        const std::string connected = count == 0   ? "not connected"
                                      : count == 1 ? "1 connection"
                                                   : fmt::format("{} connections", count);
        text += fmt::format("\n  {:3} {:{}}  {:{}}  {}", direction, one_line(port.name), name_width,
                            port.type.empty() ? service : std::string_view(port.type), type_width, connected);
    }
    return text;
}

// Sets for tools have names such as "__widget__".
bool is_for_tools(const std::string& set) { return set.starts_with("__"); }

std::string set_lines(const PeerSnapshot& peer) {
    std::string text;
    std::vector<std::string_view> others;
    for (const auto& [name, values] : peer.sets) {
        if (is_for_tools(name)) continue;
        if (name != peer.set) {
            others.push_back(name);
            continue;
        }
        for (const auto& [parameter, value] : values)
            text += fmt::format("\n  config.{} = {}", one_line(parameter), one_line(value));
    }
    if (!others.empty()) text += "\n  other sets: " + one_line(fmt::format("{}", fmt::join(others, ", ")));
    return text;
}

// "rtm:pc.host_cxt/ConsoleOut0  ConsoleOut, ACTIVE, set fast"
std::string title(const PeerSnapshot& peer) {
    std::string text = "rtm:" + one_line(peer.name) + "  ";
    if (!answers(peer)) return text + std::string(to_text(peer.state));
    text += fmt::format("{}, {}", one_line(peer.type), to_text(peer.state));
    if (peer.is_stopped) text += ", its execution context is stopped";
    if (!peer.set.empty() && peer.set != "default") text += ", set " + one_line(peer.set);
    return text;
}

}  // namespace

Expected<std::string> told_of_peers(const PeerQuestion& question, const PeerAnswer& answer) {
    if (!answer.problem.empty()) {
        return failure(one_line(answer.problem) + did_you_mean(answer.missing, answer.known));
    }
    std::string text;
    for (const PeerSnapshot& peer : answer.peers) {
        text += (text.empty() ? "" : "\n") + title(peer);
        if (!question.request) text += port_lines(peer) + set_lines(peer);
    }
    return text.empty() && !question.request ? "the name service has no RTCs" : text;
}

}  // namespace nezumi::openrtm
