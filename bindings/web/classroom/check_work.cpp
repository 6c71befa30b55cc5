// Makes a new copy for each check: the pupil's files, and then the exercise's scenarios, which replace the pupil's.
#include "bindings/web/classroom/check_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/base/csv.hpp"
#include "engine/base/program.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/base/xml_text.hpp"

namespace nezumi::web {
namespace {

namespace fs = std::filesystem;

constexpr double longest_check = 300;  // [s]

struct Removed {
    fs::path folder;
    ~Removed() {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }
};

std::string csv_cell(std::string_view text) {
    // A spreadsheet takes a text that begins with one of these characters for a formula, so it gets a ' before it.
    std::string cell(!text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos ? "'"
                                                                                                                : "");
    cell += text;
    return csv_field(cell);
}

std::size_t passed(const std::vector<CheckedScenario>& checked) {
    return static_cast<std::size_t>(
        std::count_if(checked.begin(), checked.end(), [](const CheckedScenario& each) { return each.passed; }));
}

}  // namespace

std::vector<std::string> confined_words(const std::string& program, const fs::path& folder, bool trust,
                                        const std::vector<fs::path>& devices) {
    std::vector<std::string> words{program, "confined"};
    if (trust) words.emplace_back("--bounds-only");
    for (const fs::path& each : devices) words.insert(words.end(), {"--devices", each.string()});
    words.insert(words.end(), {folder.string(), "--"});
    return words;
}

std::vector<CheckedScenario> read_tap(const std::string& text, const fs::path& hidden) {
    std::vector<CheckedScenario> checked;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const bool passes = line.starts_with("ok ");
        if (!passes && !line.starts_with("not ok ")) continue;
        const auto dash = line.find(" - "), colon = line.find("_test.lua: ");
        if (dash == std::string::npos || colon == std::string::npos || colon < dash) continue;
        const fs::path file = line.substr(dash + 3, colon + 9 - dash - 3);
        std::error_code none;
        checked.push_back({.name = line.substr(colon + 11),
                           .passed = passes && line.find(" # SKIP") == std::string::npos,
                           .hidden = fs::exists(hidden / "tests" / file.filename(), none)});
    }
    return checked;
}

Expected<std::vector<CheckedScenario>> check_work(const WorkToCheck& wanted, const std::atomic<bool>& give_up) {
    std::error_code none;
    fs::remove_all(wanted.scratch, none);
    const Removed at_the_end{wanted.scratch};
    if (auto ok = copy_files(wanted.work, wanted.scratch, true); !ok) return Unexpected(ok.error());
    fs::remove_all(wanted.scratch / "tests", none);
    if (fs::exists(wanted.exercise.start() / "tests", none)) {
        if (auto ok = copy_files(wanted.exercise.start() / "tests", wanted.scratch / "tests", true); !ok)
            return Unexpected(ok.error());
    }
    if (fs::exists(wanted.exercise.hidden(), none)) {
        if (auto ok = copy_files(wanted.exercise.hidden(), wanted.scratch, true); !ok) return Unexpected(ok.error());
    }
    std::vector<std::string> words = confined_words(wanted.program, wanted.scratch, wanted.trust);
    for (const char* word : {"test", "--project"}) words.emplace_back(word);
    words.push_back(wanted.scratch.string());
    for (const char* word : {"--tap", "--jobs", "1"}) words.emplace_back(word);
    const UnnamedFile output, errors;
    const auto end = run_program({.words = std::move(words),
                                  .output = output.file(),
                                  .errors = errors.file(),
                                  .longest = longest_check,
                                  .give_up = &give_up});
    auto checked = read_tap(output.text(), wanted.exercise.hidden());
    if (!checked.empty()) return checked;
    const std::string said(trimmed(errors.text()));
    return failure(!said.empty() ? said.substr(0, said.find('\n'))
                   : end         ? "the exercise has no scenarios"
                                 : problem_of(end));
}

Expected<void> write_results(const fs::path& folder, const std::vector<PupilResult>& results) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) return failure("can't be made: " + problem.message(), {folder.string()});
    if (auto ok = write_whole(folder / "results.csv", results_csv(results)); !ok) return ok;
    return write_whole(folder / "results.xml", results_junit(results));
}

Expected<void> collect_work(const Pupils& pupils, const Pupil& pupil, const fs::path& folder) {
    return copy_files(pupils.work_of(pupil), folder / fmt::format("{:02}", pupil.number) / pupil.exercise, true);
}

Expected<void> collect_class(const fs::path& folder, const std::vector<Exercise>& exercises, const fs::path& to,
                             const std::string& program, bool trust) {
    const auto pupils = Pupils::load(folder);
    if (!pupils) return Unexpected(pupils.error());
    const std::atomic<bool> never = false;
    std::vector<PupilResult> results;
    for (const auto& pupil : pupils->all()) {
        if (pupil->exercise.empty()) continue;
        PupilResult result{.number = pupil->number,
                           .name = pupil->name,
                           .exercise = pupil->exercise,
                           .mark = pupil->mark,
                           .comment = pupil->comment};
        const auto exercise = std::find_if(exercises.begin(), exercises.end(),
                                           [&](const Exercise& each) { return each.name == pupil->exercise; });
        // An error in one pupil's work does not stop the check of the others.
        const auto copied = collect_work(*pupils, *pupil, to);
        auto checked = !copied ? Unexpected(copied.error())
                       : exercise == exercises.end()
                           ? failure("this exercise no longer exists")
                           : check_work({.exercise = *exercise,
                                         .work = pupils->work_of(*pupil),
                                         .scratch = folder / "checks" / std::to_string(pupil->number),
                                         .program = program,
                                         .trust = trust},
                                        never);
        if (checked)
            result.checked = std::move(*checked);
        else
            result.problem = describe(checked.error());
        results.push_back(std::move(result));
    }
    return write_results(to, results);
}

std::string results_csv(const std::vector<PupilResult>& results) {
    std::string csv = "number,name,exercise,passed,scenarios,problem,mark,comment\n";
    for (const PupilResult& each : results) {
        csv += fmt::format("{:02},{},{},{},{},{},{},{}\n", each.number, csv_cell(each.name), csv_cell(each.exercise),
                           passed(each.checked), each.checked.size(), csv_cell(each.problem), csv_cell(each.mark),
                           csv_cell(each.comment));
    }
    return csv;
}

std::string results_junit(const std::vector<PupilResult>& results) {
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
    for (const PupilResult& each : results) {
        const std::size_t count = each.checked.size() + (each.problem.empty() ? 0 : 1);
        xml +=
            fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n", xml_text(each.name),
                        count, each.checked.size() - passed(each.checked), each.problem.empty() ? 0 : 1);
        for (const CheckedScenario& scenario : each.checked)
            xml += fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}\n", xml_text(each.exercise),
                               xml_text(scenario.name), scenario.passed ? "/>" : "><failure/></testcase>");
        if (!each.problem.empty())
            xml += fmt::format("    <testcase classname=\"{}\" name=\"check\"><error message=\"{}\"/></testcase>\n",
                               xml_text(each.exercise), xml_text(each.problem));
        xml += "  </testsuite>\n";
    }
    return xml + "</testsuites>\n";
}

}  // namespace nezumi::web
