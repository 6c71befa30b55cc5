// Reads transcripts of the console: a live system, simulated, and a session whose inputs are answered one by one.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "reader.hpp"
#include "tests/unit/console/session_rig.hpp"

namespace nezumi::texts {
namespace {

// A case has its file `system.lua`, or a system of its behaviour `behaviors/it.lua`, or the counter's. An input that
// ends with the sign of the Tab key is answered by what could stand there.
class ConsoleReader : public CaseReader {
public:
    void write(const std::string& name, const std::string& text) override {
        if (session_) {
            session_->folder.write(name, text);
            return;
        }
        static constexpr std::string_view folder = "behaviors/";
        if (name == "system.lua")
            system_ = text;
        else
            behaviors_[name.substr(folder.size(), name.rfind('.') - folder.size())] = text;
    }
    std::vector<Remark> read(const Text&) override { return {}; }
    std::string answer(const std::string& input) override {
        if (!session_) session_ = std::make_unique<SessionRig>(system_.value_or(usual_system()), behaviors_);
        const std::string_view tab = "⇥";
        if (!input.ends_with(tab)) return shortened(with_log(session_->type(input)));
        const std::string text = input.substr(0, input.size() - tab.size());
        const Completion offered = session_->complete(text);
        return fmt::format(
            "{} -> {}", text.substr(std::min(offered.from, text.size())),
            offered.candidates.empty() ? "nothing" : fmt::format("{}", fmt::join(offered.candidates, " ")));
    }

private:
    std::string usual_system() const {
        return behaviors_.contains("it") ? "behavior 'it' { script = 'it' }" : counter_system;
    }
    // The answer, and below it what was logged meanwhile.
    std::string with_log(std::string answer) {
        for (; logged_ < session_->log.size(); ++logged_) {
            const LogLine& line = session_->log[logged_];
            if (!answer.empty()) answer += '\n';
            const std::string who = line.component.empty() ? "" : " " + line.component;
            answer += fmt::format("{}{}: {}", to_text(line.level), who, line.text);
        }
        return answer;
    }
    std::string shortened(std::string text) const {
        const std::string folder = session_->folder.path("").string();
        for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
            text.erase(at, folder.size());
        return text;
    }

    std::optional<std::string> system_;
    std::map<std::string, std::string> behaviors_{{"counter", counter_behavior}};
    std::unique_ptr<SessionRig> session_;
    std::size_t logged_ = 0;  // lines of the log that are shown already
};

}  // namespace

std::unique_ptr<CaseReader> make_console_reader() { return std::make_unique<ConsoleReader>(); }

}  // namespace nezumi::texts
