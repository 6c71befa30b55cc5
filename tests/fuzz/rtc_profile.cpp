// Reads anything as a profile of RTCBuilder or RTSystemEditor: what comes out is a behaviour that loads and a profile
// that reads back as the same, or a system file and a profile in XML and YAML, or one line that says why not.
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/cli/new/behavior.hpp"
#include "bindings/cli/new/profile_behavior.hpp"
#include "bindings/cli/new/profile_system.hpp"
#include "bindings/lua/syntax/syntax_tree.hpp"
#include "bindings/openrtm/restore_system.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

// What is written is read as what was written.
void write_again(const openrtm::SystemProfile& profile) {
    const std::string date = "2026-01-31T12:00:00";
    const auto written = openrtm::write_system_profile(profile, date);
    if (!written) return require_line(written.error().message);
    for (const auto format : {openrtm::ProfileFormat::xml, openrtm::ProfileFormat::yaml}) {
        const auto text = openrtm::write_system_profile(profile, date, format);
        require(text.has_value());
        const auto again = openrtm::read_system_profile(*text, "RTS");
        require(again.has_value());
        require(openrtm::write_system_profile(*again, date) == *written);
    }
    const auto nameservers = openrtm::nameservers_of(profile);
    if (!nameservers) require_line(nameservers.error().message);
}

void read_system(std::string_view text) {
    const auto profile = openrtm::read_system_profile(text, "RTS.xml");
    if (!profile) return check(profile.error());
    write_again(*profile);
    const auto any_behavior = [](const std::string&) {
        auto script = Script::load({"it.lua", "it.lua",
                                    "input(\"in\", \"TimedLong\") output(\"out\", \"TimedLong\") "
                                    "param(\"speed\", 0.5, { max = 1 }) param(\"names\", { \"a\" })"},
                                   {.component = "it"});
        require(script.has_value());
        return std::move(*script);
    };
    std::vector<std::string> remarks;
    const std::string system = cli::system_text_of(*profile, any_behavior, remarks);
    for (const std::string& remark : remarks) require(remark.find('\n') == std::string::npos);
    const SyntaxTree tree(system);
    require(!tree.error());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    read_system(text);
    const auto profile = openrtm::read_component_profile(text, "RTC.xml");
    if (!profile) {
        check(profile.error());
        return 0;
    }
    std::vector<std::string> remarks;
    const auto texts = cli::write_behavior({.name = "", .base = cli::parts_of(*profile, cli::new_messages(), remarks)});
    for (const std::string& remark : remarks) require(remark.find('\n') == std::string::npos);
    if (!texts) require_line(texts.error().message);

    const auto written = openrtm::write_component_profile(*profile, "2026-01-31T12:00:00Z");
    if (!written) {
        require_line(written.error().message);
        return 0;
    }
    const auto again = openrtm::read_component_profile(*written, "RTC.xml");
    require(again.has_value());
    require(openrtm::write_component_profile(*again, "2026-01-31T12:00:00Z") == *written);
    return 0;
}
