// Lines are merged over the runs of a scenario, and over scenarios.
#include "bindings/scenario/coverage_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "bindings/lua/syntax/lexer.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {
namespace {

template <class Map>
std::size_t count_ran(const Map& counts) {
    return static_cast<std::size_t>(
        std::count_if(counts.begin(), counts.end(), [](const auto& each) { return each.second > 0; }));
}

std::string percent(std::size_t ran, std::size_t all) {
    return all == 0 ? "" : fmt::format("{:.1f} %", 100.0 * static_cast<double>(ran) / static_cast<double>(all));
}

// lcov allows only letters, digits and underscores.
std::string test_name(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c >= 0x80 || std::isalnum(c) == 0; }, '_');
    return name;
}

// "1-3, 5, 9".
std::string line_ranges(const std::map<int, std::size_t>& lines) {
    std::string text;
    for (auto line = lines.begin(); line != lines.end();) {
        if (line->second == 0) {
            ++line;
            continue;
        }
        const int first = line->first;
        int last = first;
        for (; line != lines.end() && line->second > 0; ++line) last = line->first;
        text += text.empty() ? "" : ", ";
        text += first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last);
    }
    return text;
}

}  // namespace

void CoverageReport::add(const std::string& scenario, const std::vector<FileCoverage>& files) {
    for (const FileCoverage& from : files) {
        File& file = files_[from.file];
        if (file.scenarios.empty()) file.hash = from.hash;
        if (file.hash != from.hash) continue;  // the file was changed during the session
        const auto same = [&](const auto& each) { return each.first == scenario; };
        auto found = std::find_if(file.scenarios.begin(), file.scenarios.end(), same);
        if (found == file.scenarios.end()) found = file.scenarios.insert(file.scenarios.end(), {scenario, {}});
        for (const CoveredLine& line : from.lines) found->second.lines[line.line] += line.ran ? 1 : 0;
        for (const CoveredBranch& each : from.branches)
            found->second.ways[{each.line, each.number, each.way}] += each.ran ? 1 : 0;
    }
}

void CoverageReport::add_unloaded(const std::string& name, const std::string& text) {
    if (files_.contains(name)) return;
    const MarkedText marked = mark_lines(without_preamble(text));
    if (!compile(marked.text, name)) return;  // too long for a limit of Lua: it would have no marks when it is loaded
    FileCoverage file{.file = name, .hash = ScriptFile({"", "", text}).hash};
    for (const int line : marked.lines) {
        if (line != 0) file.lines.push_back({line, false});
    }
    std::map<int, std::int32_t> numbers;
    for (const MarkedText::Branch& branch : marked.branches) {
        const std::int32_t number = numbers[branch.line]++;
        file.lines.push_back({branch.line, false});
        file.branches.push_back({branch.line, number, 0, false});
        if (!branch.passed.empty()) file.branches.push_back({branch.line, number, 1, false});
    }
    if (!file.lines.empty()) add("", {file});
}

CoverageReport::Counts CoverageReport::File::all() const {
    Counts sum;
    for (const auto& [name, counts] : scenarios) {
        for (const auto& [line, runs] : counts.lines) sum.lines[line] += runs > 0 ? 1 : 0;
        for (const auto& [way, runs] : counts.ways) sum.ways[way] += runs > 0 ? 1 : 0;
    }
    return sum;
}

std::string CoverageReport::Counts::text(std::size_t ran, std::size_t all, const char* what) {
    return all == 0 ? fmt::format("no {}", what) : fmt::format("{} of {} {} ({})", ran, all, what, percent(ran, all));
}

std::string CoverageReport::Counts::text() const {
    return text(count_ran(lines), lines.size(), "lines") + ", " + text(count_ran(ways), ways.size(), "branches");
}

std::string CoverageReport::summary() const {
    std::size_t lines = 0, lines_ran = 0, ways = 0, ways_ran = 0, unloaded = 0;
    for (const auto& [name, file] : files_) {
        const Counts all = file.all();
        unloaded += file.is_loaded() ? 0 : 1;
        lines += all.lines.size();
        lines_ran += count_ran(all.lines);
        ways += all.ways.size();
        ways_ran += count_ran(all.ways);
    }
    return fmt::format("coverage: {}, {} of {} file{}{}", Counts::text(lines_ran, lines, "lines"),
                       Counts::text(ways_ran, ways, "branches"), files_.size(), files_.size() == 1 ? "" : "s",
                       unloaded == 0 ? "" : fmt::format(", {} of which no scenario loads", unloaded));
}

std::string CoverageReport::lcov() const {
    std::string out;
    for (const auto& [name, file] : files_) {
        for (const auto& [scenario, counts] : file.scenarios) {
            out += fmt::format("TN:{}\nSF:{}\n", test_name(scenario), name);
            for (const auto& [way, runs] : counts.ways) {
                const auto& [line, number, side] = way;
                const auto other = counts.ways.find({line, number, 1 - side});
                const bool reached = runs > 0 || (other != counts.ways.end() && other->second > 0);
                out += fmt::format("BRDA:{},{},{},{}\n", line, number, side, reached ? fmt::to_string(runs) : "-");
            }
            out += fmt::format("BRF:{}\nBRH:{}\n", counts.ways.size(), count_ran(counts.ways));
            for (const auto& [line, runs] : counts.lines) out += fmt::format("DA:{},{}\n", line, runs);
            out += fmt::format("LF:{}\nLH:{}\nend_of_record\n", counts.lines.size(), count_ran(counts.lines));
        }
    }
    return out;
}

std::string CoverageReport::text(
    const std::function<std::optional<std::string>(const std::string& file, std::uint64_t hash)>& read) const {
    std::string out = summary() + "\n\n";
    for (const auto& [name, file] : files_) out += fmt::format("{}: {}\n", name, file.all().text());
    out += "\nBefore each line: its number, and how many scenarios ran it (!!!! none).\n";
    for (const auto& [name, file] : files_) {
        const Counts all = file.all();
        out += fmt::format("\n{}\n", name);
        const auto source = read(name, file.hash);
        std::istringstream lines(source.value_or(""));
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            const auto count = all.lines.find(number);
            const std::string ran = count == all.lines.end() ? ""
                                    : count->second == 0     ? "!!!!"
                                                             : fmt::to_string(count->second);
            std::string ways;
            for (auto way = all.ways.lower_bound({number, 0, 0});
                 way != all.ways.end() && std::get<0>(way->first) == number; ++way) {
                if (way->second == 0) ways += std::get<2>(way->first) == 0 ? "  <- never true" : "  <- never false";
            }
            out += fmt::format("{:>5} {:>4}  {}{}\n", number, ran, line, ways);
        }
        if (!file.is_loaded()) out += "  no scenario loads it\n";
        for (const auto& [scenario, counts] : file.scenarios) {
            if (file.is_loaded()) out += fmt::format("  {}: {}\n", scenario, line_ranges(counts.lines));
        }
    }
    return out;
}

}  // namespace nezumi
