// JUnit's XML, as common readers accept it (Jenkins, GitLab, GitHub Actions).
#include <fmt/format.h>

#include <cstddef>

#include "bindings/scenario/reporter.hpp"
#include "engine/base/xml_text.hpp"

namespace nezumi {
namespace {

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
                    xml_text(report.file), xml_text(name), xml_text(report.file), report.line, result.wall_seconds);
    if (result.outcome != RunOutcome::passed) {
        const bool failed = result.outcome == RunOutcome::failed;
        const std::string_view tag = failed ? "failure" : "error";
        out += fmt::format("      <{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n", tag, xml_text(result.error.message),
                           failed ? "failed" : "could not run", xml_text(lines_of(failure_lines(report))));
    }
    std::vector<std::string> said;
    for (const ConditionMargin& margin : result.margins) said.push_back(text_of(margin));
    said.insert(said.end(), result.printed.begin(), result.printed.end());
    if (!said.empty()) out += fmt::format("      <system-out>{}</system-out>\n", xml_text(lines_of(said)));
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
        out += fmt::format("  <testsuite name=\"{}\" {}>\n", xml_text(reports[begin].file), counts.attributes());
        out += fmt::format("    <properties>\n      <property name=\"seed\" value=\"{}\"/>\n    </properties>\n",
                           summary.seed);
        out += cases + "  </testsuite>\n";
    }
    return out + "</testsuites>\n";
}

}  // namespace nezumi
