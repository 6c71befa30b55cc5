// JUnit's XML, as common readers accept it (Jenkins, GitLab, GitHub Actions).
#include <fmt/format.h>

#include <cstddef>

#include "bindings/scenario/reporter.hpp"

namespace nezumi {
namespace {

// The number of bytes of the UTF-8 character at `at`; 0 if XML does not allow it.
std::size_t character_size(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) -> unsigned {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const unsigned first = byte(at);
    if (first < 0x80) return first >= 0x20 || first == '\n' || first == '\t' ? 1 : 0;
    const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4) return 0;
    unsigned code = first & (0xffU >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(at + i) & 0xc0U) != 0x80U) return 0;
        code = (code << 6U) | (byte(at + i) & 0x3fU);
    }
    constexpr unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return code < least[size] || code > 0x10ffff || surrogate || code == 0xfffe || code == 0xffff ? 0 : size;
}

// Text for content and attributes; characters that XML does not allow become question marks.
std::string xml(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t size = character_size(text, at);
        switch (size == 1 ? text[at] : '\0') {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\n': out += "&#10;"; break;
            case '\t': out += "&#9;"; break;
            default: size == 0 ? out += '?' : out.append(text.substr(at, size));
        }
        at += size == 0 ? 1 : size;
    }
    return out;
}

std::string lines_of(const std::vector<std::string>& lines) {
    std::string out;
    for (const std::string& line : lines) out += line + "\n";
    return out;
}

struct Counts {
    std::size_t tests = 0;
    std::size_t failures = 0;
    std::size_t errors = 0;
    double seconds = 0;

    void add(const RunReport& report) {
        ++tests;
        failures += report.result.outcome == RunOutcome::failed ? 1 : 0;
        errors += report.result.outcome == RunOutcome::could_not_run ? 1 : 0;
        seconds += report.result.wall_seconds;
    }
    std::string attributes() const {
        return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"{:.6f}\"", tests, failures,
                           errors, seconds);
    }
};

std::string test_case(const RunReport& report) {
    const RunResult& result = report.result;
    const std::string name = report.scenario.empty() ? "(the file)" : report.name;
    std::string out =
        fmt::format("    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" line=\"{}\" time=\"{:.6f}\">\n",
                    xml(report.file), xml(name), xml(report.file), report.line, result.wall_seconds);
    if (result.outcome != RunOutcome::passed) {
        const bool failed = result.outcome == RunOutcome::failed;
        const std::string_view tag = failed ? "failure" : "error";
        out += fmt::format("      <{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n", tag, xml(result.error.message),
                           failed ? "failed" : "could not run", xml(lines_of(failure_lines(report))));
    }
    std::vector<std::string> said;
    for (const ConditionMargin& margin : result.margins) said.push_back(text_of(margin));
    said.insert(said.end(), result.printed.begin(), result.printed.end());
    if (!said.empty()) out += fmt::format("      <system-out>{}</system-out>\n", xml(lines_of(said)));
    return out + "    </testcase>\n";
}

}  // namespace

std::string junit_text(const std::vector<RunReport>& reports, const SessionSummary& summary) {
    Counts all;
    for (const RunReport& report : reports) all.add(report);
    std::string out =
        fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"nezumi\" {}>\n", all.attributes());
    for (std::size_t begin = 0, end = 0; begin < reports.size(); begin = end) {
        Counts counts;
        std::string cases;
        for (end = begin; end < reports.size() && reports[end].file == reports[begin].file; ++end) {
            counts.add(reports[end]);
            cases += test_case(reports[end]);
        }
        out += fmt::format("  <testsuite name=\"{}\" {}>\n", xml(reports[begin].file), counts.attributes());
        out += fmt::format("    <properties>\n      <property name=\"seed\" value=\"{}\"/>\n    </properties>\n",
                           summary.seed);
        out += cases + "  </testsuite>\n";
    }
    return out + "</testsuites>\n";
}

}  // namespace nezumi
