// Checks a connection as far as possible without the other RTC.
#include "engine/system/rtm_wiring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/system/system.hpp"

namespace nezumi {
namespace {

constexpr std::array<std::string_view, 2> own_types{"CameraIntrinsics", "SeenMarkerSeq"};

bool is_exported(const SystemSpec& spec, std::string_view component) {
    return spec.rtm &&
           std::find(spec.rtm->exported.begin(), spec.rtm->exported.end(), component) != spec.rtm->exported.end();
}

}  // namespace

bool is_rtm_type(std::string_view type) {
    return std::find(own_types.begin(), own_types.end(), type) == own_types.end();
}

std::string needs_export(std::string_view end, std::string_view component) {
    return fmt::format(
        "{} is a port of another program, which sees only what is exported: write rtm {{ export = {{ \"{}\" }} }}", end,
        component);
}

Expected<RtmEnds> rtm_ends(const System& system, const ConnectionSpec& connection) {
    const bool is_from = is_rtm_path(connection.from);
    if (is_from && is_rtm_path(connection.to))
        return failure("both ends are ports of other programs: one of them must be of this system");
    const std::string& ours = is_from ? connection.to : connection.from;
    auto theirs = rtm_path(is_from ? connection.from : connection.to);
    if (!theirs) return Unexpected(theirs.error());
    const auto port = system.port(ours);
    if (!port) return Unexpected(port.error());
    if (((*port)->direction() == Direction::in) != is_from)
        return failure(fmt::format("{} is an {}-port", ours, is_from ? "out" : "in"));
    if (!is_rtm_type((*port)->type_name()))
        return failure(fmt::format("{} is a {}, which OpenRTM does not know", ours, (*port)->type_name()));
    return RtmEnds{ours, std::move(*theirs)};
}

Expected<void> connect_rtm(SystemSpec& spec, const System& system, const std::string& from, const std::string& to) {
    ConnectionSpec wanted{from, to, {}};
    const auto ends = rtm_ends(system, wanted);
    if (!ends) return Unexpected(ends.error());
    const std::string component = ends->ours.substr(0, ends->ours.find('.'));
    if (!is_exported(spec, component)) return failure(needs_export(ends->ours == from ? to : from, component));
    auto& connections = spec.rtm_connections;
    if (std::find(connections.begin(), connections.end(), wanted) != connections.end())
        return failure(fmt::format("{} is connected to {} already", from, to));
    connections.push_back(std::move(wanted));
    return {};
}

std::size_t disconnect_rtm(SystemSpec& spec, std::string_view from, std::string_view to) {
    return std::erase_if(spec.rtm_connections, [&](const ConnectionSpec& each) {
        return to.empty() ? each.from == from || each.to == from : each.from == from && each.to == to;
    });
}

std::vector<std::string> rtm_peers(const SystemSpec& spec, std::string_view end) {
    std::vector<std::string> others;
    for (const ConnectionSpec& each : spec.rtm_connections) {
        if (each.from == end) others.push_back(each.to);
        if (each.to == end) others.push_back(each.from);
    }
    return others;
}

void forget_rtm(SystemSpec& spec, std::string_view component) {
    const std::string ports = std::string(component) + ".";
    std::erase_if(spec.rtm_connections, [&](const ConnectionSpec& each) {
        return each.from.starts_with(ports) || each.to.starts_with(ports);
    });
}

}  // namespace nezumi
