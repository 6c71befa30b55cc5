// Reads transcripts of commands: each is run by a shell in the folder of its case, and answers with what it prints.
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>

#include "reader.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi::texts {
namespace {

// Standard output and standard error together, and "[STATUS]" where the exit status is not 0. `nezumi` is the one of
// this build. Paths of the folder and of the sources are shortened.
class CommandReader : public CaseReader {
public:
    void write(const std::string& name, const std::string& text) override { folder_.write("home/" + name, text); }
    std::vector<Remark> read(const Text&) override { return {}; }
    std::string answer(const std::string& input) override {
        const std::string home = folder_.write("home/.keep", "").parent_path().string();
        const std::string bin = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
        const auto script = folder_.write("command", "PATH='" + bin + "':$PATH; cd '" + home + "'\n" + input + "\n");
        std::FILE* pipe = popen(("sh '" + script.string() + "' 2>&1 </dev/null").c_str(), "r");
        if (pipe == nullptr) return "no shell";
        std::string said;
        std::array<char, 4096> buffer{};
        for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
            said.append(buffer.data(), n);
        const int status = pclose(pipe);
        for (const std::string& folder : {home + "/", source_root() + "/"}) {
            for (std::size_t at = said.find(folder); at != std::string::npos; at = said.find(folder))
                said.erase(at, folder.size());
        }
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return said;
        if (!said.empty() && said.back() != '\n') said += '\n';
        return said + "[" + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status)) + "]";
    }

private:
    Scratch folder_;
};

}  // namespace

std::unique_ptr<CaseReader> make_command_reader() { return std::make_unique<CommandReader>(); }

}  // namespace nezumi::texts
