// Checks a connection as far as possible without the other RTC.
#include "bindings/openrtm/rtm_wiring.hpp"

#include <fmt/format.h>

#include <array>

#include "engine/base/list.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::openrtm {
namespace {

constexpr std::array<std::string_view, 2> own_types{"CameraIntrinsics", "SeenMarkerSeq"};

}  // namespace

std::string rtm_type_id(const MessageType& type) {
    if (!type.is_compiled()) return type.rtm;
    if (contains(own_types, type.name)) return "";
    return fmt::format("IDL:RTC/{}:1.0", type.name);
}

void write_rtm_message(Octets& out, const MessageType& type, const ValueView& data, double tm, std::endian order) {
    if (type.has_rtm_stamp) return write_cdr_message(out, data, tm, {.order = order});
    write_cdr(out, {.order = order}, data);
}

Expected<void> read_rtm_message(std::span<const std::uint8_t> bytes, const MessageType& type, const ValuePlace& data,
                                std::endian order) {
    double tm = 0;
    if (type.has_rtm_stamp) return read_cdr_message(bytes, data, tm, {.order = order});
    return read_cdr(bytes, {.order = order}, data);
}

std::string needs_export(std::string_view end, std::string_view component) {
    return fmt::format(
        "{} is a port of another program, which sees only exported components: write rtm {{ export = {{ \"{}\" }} }}",
        end, component);
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
        return failure(
            fmt::format("{} is an {}-port: connect goes from an out-port to an in-port", ours, is_from ? "out" : "in"));
    const MessageType& type = *(*port)->type();
    if (rtm_type_id(type).empty()) {
        return failure(fmt::format("{} is a {}, which OpenRTM does not know{}", ours, type.name,
                                   type.is_compiled() ? "" : ": write rtm = \"IDL:MODULE/NAME:1.0\" in " + type.file));
    }
    return RtmEnds{ours, std::move(*theirs)};
}

}  // namespace nezumi::openrtm
