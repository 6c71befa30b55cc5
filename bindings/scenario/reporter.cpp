// Reports for people, and as TAP.
#include "bindings/scenario/reporter.hpp"

#include <fmt/format.h>

#include "engine/base/lua_text.hpp"

namespace nezumi {
namespace {

class ConsoleReporter final : public Reporter {
public:
    ConsoleReporter(WriteText write, bool colour, bool quiet)
        : write_(std::move(write)), colour_(colour), quiet_(quiet) {}

    void begin(std::size_t) override {}

    void add(const RunReport& report) override {
        const RunResult& result = report.result;
        if (quiet_ && result.outcome == RunOutcome::passed) return;
        const bool read = !report.scenario.empty();
        switch (result.outcome) {
            case RunOutcome::passed: paint("32", "ok    "); break;
            case RunOutcome::failed: paint("31", "FAILED"); break;
            case RunOutcome::could_not_run: paint("31", "could not run"); break;
        }
        std::string line = " ";
        line += read ? report.name : report.file;
        if (result.outcome == RunOutcome::passed)
            line +=
                fmt::format("  ({:.2f} s in {:.3f} s, hash {:016x})", result.seconds, result.wall_seconds, result.hash);
        write_(line + "\n");
        if (result.outcome != RunOutcome::passed) {
            for (const std::string& each : failure_lines(report)) write_(each.empty() ? "\n" : "    " + each + "\n");
        }
        for (const ConditionMargin& margin : result.margins) write_("    " + text_of(margin) + "\n");
        for (const std::string& printed : result.printed) write_("    | " + printed + "\n");
    }

    void end(const SessionSummary& summary) override {
        const std::size_t all = summary.passed + summary.failed + summary.could_not_run;
        std::string text = fmt::format("{} run{}: {} passed", all, all == 1 ? "" : "s", summary.passed);
        if (summary.failed > 0) text += fmt::format(", {} failed", summary.failed);
        if (summary.could_not_run > 0) text += fmt::format(", {} could not run", summary.could_not_run);
        text += fmt::format(" (seed {}, ", summary.seed);
        if (summary.kept > 0) text += fmt::format("{} kept and {} run now: ", summary.kept, all - summary.kept);
        text += fmt::format("{:.2f} s simulated ", summary.seconds);
        text += summary.merged > 0 ? fmt::format("elsewhere, merged from {} folder{})\n", summary.merged,
                                                 summary.merged == 1 ? "" : "s")
                                   : fmt::format("in {:.2f} s with {} job{})\n", summary.wall_seconds, summary.jobs,
                                                 summary.jobs == 1 ? "" : "s");
        write_(text);
        for (const MeasureSummary& measure : summary.measures) write_(text_of(measure) + "\n");
        for (const PairSummary& pair : summary.pairs) write_(text_of(pair) + "\n");
        for (const MarginSummary& margin : summary.margins) write_(text_of(margin) + "\n");
    }

private:
    void paint(std::string_view colour, std::string_view text) {
        write_(colour_ ? fmt::format("\x1b[{}m{}\x1b[0m", colour, text) : std::string(text));
    }

    WriteText write_;
    bool colour_;
    bool quiet_;
};

// The location of the failure: a file, and its line if known.
std::string place_text(const RunReport& report) {
    const Place& place = report.result.error.place;
    const std::string& file = place.file.empty() ? report.file : place.file;
    const int line = place.file.empty() ? report.line : place.line;
    return line > 0 ? fmt::format("{}:{}", file, line) : file;
}

// A description must not contain directives or escapes of TAP.
std::string tap_name(std::string_view name) {
    std::string out;
    for (const char c : name) {
        if (c == '#' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

class TapReporter final : public Reporter {
public:
    explicit TapReporter(WriteText write) : write_(std::move(write)) {}

    void begin(std::size_t runs) override { write_(fmt::format("TAP version 13\n1..{}\n", runs)); }

    void add(const RunReport& report) override {
        const bool passed = report.result.outcome == RunOutcome::passed;
        const std::string name = report.scenario.empty() ? report.file : report.file + ": " + report.name;
        write_(fmt::format("{} {} - {}\n", passed ? "ok" : "not ok", ++number_, tap_name(name)));
        if (passed) {
            for (const ConditionMargin& margin : report.result.margins) write_("# " + text_of(margin) + "\n");
            return;
        }
        const Error& error = report.result.error;
        write_("  ---\n");
        write_(fmt::format("  message: {}\n", lua_quoted(error.message)));
        write_(fmt::format("  severity: {}\n", report.result.outcome == RunOutcome::failed ? "fail" : "error"));
        write_(fmt::format("  at: {}\n", lua_quoted(place_text(report))));
        write_("  details:\n");
        for (const std::string& line : failure_lines(report)) write_(fmt::format("    - {}\n", lua_quoted(line)));
        write_("  ...\n");
    }

    void end(const SessionSummary& summary) override {
        write_(fmt::format("# seed {}, {} passed, {} failed, {} could not run\n", summary.seed, summary.passed,
                           summary.failed, summary.could_not_run));
        if (summary.kept > 0) write_(fmt::format("# {} of them were kept\n", summary.kept));
        for (const MeasureSummary& measure : summary.measures) write_("# " + text_of(measure) + "\n");
        for (const PairSummary& pair : summary.pairs) write_("# " + text_of(pair) + "\n");
        for (const MarginSummary& margin : summary.margins) write_("# " + text_of(margin) + "\n");
    }

private:
    WriteText write_;
    std::size_t number_ = 0;
};

}  // namespace

std::unique_ptr<Reporter> console_reporter(WriteText write, bool colour, bool quiet) {
    return std::make_unique<ConsoleReporter>(std::move(write), colour, quiet);
}

std::unique_ptr<Reporter> tap_reporter(WriteText write) { return std::make_unique<TapReporter>(std::move(write)); }

std::vector<std::string> failure_lines(const RunReport& report) {
    const RunResult& result = report.result;
    std::vector<std::string> lines{describe(result.error)};
    if (report.line > 0) lines.push_back(fmt::format("of the scenario at {}:{}", report.file, report.line));
    lines.insert(lines.end(), result.facts.begin(), result.facts.end());
    if (!result.folder.empty()) {
        std::string files;
        for (const std::string& file : result.files) files += (files.empty() ? "" : ", ") + file;
        lines.push_back(fmt::format("files: {} ({})", result.folder, files));
    }
    if (!report.scenario.empty()) lines.push_back(fmt::format("seed of this run: {}", report.seed));
    if (!report.again.empty()) lines.push_back("repeat it with: " + report.again);
    return lines;
}

}  // namespace nezumi
