// Commands for components of other programs. Ticks go on while they wait for an answer.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "bindings/console/console_commands.hpp"
#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/live/object_core.hpp"

namespace nezumi {
namespace {

constexpr std::string_view prefix = "rtm:";

struct Verb {
    std::string_view name;
    PeerRequest::What what;
};
constexpr std::array<Verb, 6> verbs{{{"activate", PeerRequest::What::activate},
                                     {"deactivate", PeerRequest::What::deactivate},
                                     {"reset", PeerRequest::What::reset},
                                     {"use", PeerRequest::What::use},
                                     {"exit", PeerRequest::What::exit},
                                     {"forget", PeerRequest::What::forget}}};

Expected<void> read_verb(PeerRequest& request, const std::string& text, const Arguments& arguments) {
    const auto* verb = std::find_if(verbs.begin(), verbs.end(), [&](const Verb& each) { return each.name == text; });
    if (verb == verbs.end()) {
        std::vector<std::string_view> names;
        names.reserve(verbs.size());
        for (const Verb& each : verbs) names.push_back(each.name);
        const std::string near = did_you_mean(text, names);
        return failure(fmt::format("there is no '{}'{}", shown(text),
                                   near.empty() ? fmt::format(" (there are {})", fmt::join(names, ", ")) : near));
    }
    request.what = verb->what;
    if (request.what != PeerRequest::What::use) return {};
    auto set = arguments.text(3, "the name of a set, as in rtm(\"ConsoleOut0\", \"use\", \"default\")");
    if (!set) return Unexpected(set.error());
    request.set = std::move(*set);
    return {};
}

Expected<void> read_values(PeerRequest& request, const FileTable& table) {
    request.what = PeerRequest::What::configure;
    if (!table.elements.empty() || table.fields.empty())
        return failure("expected values by name, as in rtm(\"ConsoleOut0\", { speed = 0.5 })");
    for (const FileField& field : table.fields) {
        auto value = to_parameter(field.value);
        if (!value) return failure(fmt::format("{}: {}", field.name, value.error().message));
        request.values.emplace(field.name, std::move(*value));
    }
    return {};
}

}  // namespace

std::optional<std::string> peer_named(const Arguments& arguments, int position) {
    if (lua_type(arguments.lua, arguments.index(position)) != LUA_TSTRING) return std::nullopt;
    std::string text(text_at(arguments.lua, arguments.index(position)));
    if (!text.starts_with(prefix)) return std::nullopt;
    return text.substr(prefix.size());
}

Expected<CommandEnd> ask_peers(Session::Parts& parts, const PeerRequest& request) {
    if (!parts.options.peers) return failure("this program can't reach RTCs: use `nezumi run`");
    std::future<Expected<std::string>> answer;
    const bool answered = parts.worker.perform([&] {
        if (!answer.valid()) answer = parts.options.peers(request);
        return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    if (!answered) return failure("interrupted");
    const auto text = answer.get();
    if (!text) return Unexpected(text.error());
    if (!text->empty()) parts.show(*text);
    return CommandEnd::done;
}

Expected<CommandEnd> command_rtm(Session::Parts& parts, const Arguments& arguments) {
    if (arguments.count() < 1) return ask_peers(parts, {});
    auto name = arguments.text(1, "an RTC's name, as in rtm \"ConsoleOut0\"");
    if (!name) return Unexpected(name.error());
    PeerRequest request{.name = name->starts_with(prefix) ? name->substr(prefix.size()) : *name};
    if (!arguments.has(2)) return ask_peers(parts, request);
    if (request.name.empty()) return failure("expected the name of an RTC: rtm() lists them");
    const auto what = read_file_value(arguments.lua, arguments.index(2));
    if (!what) return Unexpected(what.error());
    Expected<void> read = failure("expected an action, as in rtm(\"ConsoleOut0\", \"activate\"), or a table of values");
    if (what->get_if<std::string>() != nullptr) read = read_verb(request, *what->get_if<std::string>(), arguments);
    if (what->get_if<FileTable>() != nullptr) read = read_values(request, *what->get_if<FileTable>());
    if (!read) return Unexpected(read.error());
    return ask_peers(parts, request);
}

}  // namespace nezumi
