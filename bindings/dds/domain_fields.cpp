// Checks addresses by their form.
#include "bindings/dds/domain_fields.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "engine/base/lua_text.hpp"

namespace nezumi::dds {
namespace {

// True if a text has the form of an address or a host name, with or without a port.
bool could_be_address(const std::string& text) {
    const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || std::strchr(".-_:[]%", c) != nullptr; };
    if (text.empty() || !std::all_of(text.begin(), text.end(), fits)) return false;
    if (text.find_first_not_of("0123456789.") != text.npos) return true;
    in_addr address{};
    return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

}  // namespace

void check_peers(FieldCheck& check, const std::vector<std::string>& peers) {
    for (const std::string& each : peers) {
        if (check.ok() && !could_be_address(each))
            check.wrong({"peers"}, fmt::format("expected addresses or names of hosts, got '{}'", shown(each)));
    }
}

std::string names_text(std::string_view field, const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + lua_quoted(name);
    return list.empty() ? "" : fmt::format(", {} = {{ {} }}", field, list);
}

}  // namespace nezumi::dds
