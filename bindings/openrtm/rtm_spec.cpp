// The names of RTCs, their ports and their name service.
#include "bindings/openrtm/rtm_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "engine/base/number_in.hpp"

namespace nezumi::openrtm {
namespace {

constexpr std::string_view prefix = "rtm:";
constexpr int last_port = 65535;

// The contexts and the name of an RTC: printable and not empty.
bool is_component(std::string_view text) {
    const auto plain = [](unsigned char c) { return std::isgraph(c) != 0 || c >= 0x80; };
    return !text.empty() && text.front() != '/' && text.back() != '/' && text.find("//") == std::string_view::npos &&
           std::all_of(text.begin(), text.end(), plain);
}

bool is_number(std::string_view text, int least, int most) {
    const auto number = number_in<int>(text);
    return number && *number >= least && *number <= most;
}

}  // namespace

bool is_rtm_path(std::string_view end) { return end.starts_with(prefix); }

Expected<RtmPath> rtm_path(std::string_view end) {
    const std::string_view path = end.substr(std::min(prefix.size(), end.size()));
    const std::size_t dot = path.rfind('.');
    const std::size_t slash = path.rfind('/');
    const bool is_whole = dot != std::string_view::npos && (slash == std::string_view::npos || slash < dot) &&
                          is_component(path.substr(0, dot)) && is_component(path.substr(dot + 1));
    if (!is_rtm_path(end) || !is_whole) {
        return failure(
            fmt::format("expected \"rtm:NAME.port\" or \"rtm:HOST.host_cxt/NAME.port\", got '{}'", shown(end)));
    }
    return RtmPath{std::string(path.substr(0, dot)), std::string(path.substr(dot + 1))};
}

std::string adopt_nameserver(std::string& text) {
    const std::size_t colon = text.find(':');
    const std::string_view host = std::string_view(text).substr(0, colon);
    const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_'; };
    const bool has_port = colon != std::string::npos;
    if (host.empty() || !std::all_of(host.begin(), host.end(), plain) ||
        (has_port && !is_number(std::string_view(text).substr(colon + 1), 1, last_port))) {
        return fmt::format("expected \"HOST:PORT\", got '{}'", shown(text));
    }
    if (!has_port) text += usual_port;
    return "";
}

std::string adopt_interface(std::string& text) {
    std::string_view rest = text;
    int numbers = 0;
    bool fits = true;
    while (fits && numbers < 4) {
        const std::size_t dot = rest.find('.');
        fits = is_number(rest.substr(0, dot), 0, 255) && (dot == std::string_view::npos) == (numbers == 3);
        if (dot != std::string_view::npos) rest = rest.substr(dot + 1);
        ++numbers;
    }
    return fits ? "" : fmt::format("expected an address such as 192.168.1.10, got '{}'", shown(text));
}

}  // namespace nezumi::openrtm
