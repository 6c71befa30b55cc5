// Replacements for the parts that run other programs, which a web page can't.
#include "bindings/web/page_directory.hpp"
#include "bindings/web/scenario_runs.hpp"
#include "engine/base/program.hpp"

namespace nezumi {

bool can_run(const std::string& /*program*/) { return false; }
UnnamedFile::UnnamedFile(std::string_view /*text*/) : file_(-1) {}
UnnamedFile::~UnnamedFile() = default;
std::string UnnamedFile::text(std::size_t /*most*/) const { return ""; }
Expected<ProgramEnd> run_program(const ProgramRun& /*run*/) {
    return failure("nezumi in a web page can't run other programs");
}
std::string problem_of(const Expected<ProgramEnd>& end) { return end ? "" : end.error().message; }

namespace web {

std::vector<RunningPage> running_pages(const std::filesystem::path& /*folder*/) { return {}; }

ScenarioRuns::ScenarioRuns(std::filesystem::path project, std::string program, std::string listen, Send send)
    : project_(std::move(project)), program_(std::move(program)), listen_(std::move(listen)), send_(std::move(send)) {}
ScenarioRuns::~ScenarioRuns() = default;
Expected<void> ScenarioRuns::start(ClientId /*client*/, std::int64_t /*id*/, const TestMessage& /*message*/) {
    return failure("nezumi in a web page can't run scenarios");
}

}  // namespace web
}  // namespace nezumi
