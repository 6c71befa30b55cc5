// The editor of the page: answers its requests about the project's files, while ticks go on.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bindings/web/edited_files.hpp"
#include "bindings/web/job_thread.hpp"
#include "bindings/web/messages.hpp"
#include "bindings/web/site.hpp"
#include "engine/project/project.hpp"

namespace nezumi::web {

/// Descriptions of the Lua names that files may use.
struct EditorWords {
    std::string annotations{};  ///< the text for the Lua language server (`annotations`)
    /// The global names of each kind of file: "systems", "behaviors", ...
    std::map<std::string, std::vector<std::string>> names{};
};

struct EditorOptions {
    /// The path of nezumi, whose command `check` checks texts; "": nothing is checked.
    std::string program{};
    /// The kind of a file: "systems", "robots", ..., or "" for others.
    std::function<std::string(const std::filesystem::path& file, const std::string& text)> kind{};
    std::function<EditorWords()> words{};
};

class Editor {
public:
    /// Sends the answer to a request, a JSON object, to the browser; called in any thread.
    using Answer = std::function<void(ClientId client, std::string answer)>;

    Editor(Project project, std::filesystem::path folder, EditorOptions options, Answer answer);
    /// Waits until a file is written that is being written now, and ends a running check.
    ~Editor();
    Editor(const Editor&) = delete;
    Editor& operator=(const Editor&) = delete;

    /// Begins a request, which is answered later. Returns an error if too many requests wait.
    Expected<void> start(ClientId client, std::int64_t id, EditMessage message);

    /// [s] A check that takes longer is ended.
    static constexpr double longest_check = 20;

private:
    std::string answer_to(std::int64_t id, const EditMessage& message) const;

    const Project project_;
    const EditedFiles files_;
    const EditorOptions options_;
    const Answer answer_;
    std::atomic<bool> ends_ = false;
    JobThread file_jobs_;
    JobThread checks_;  // a separate thread, so that requests for files don't wait for a slow check
};

}  // namespace nezumi::web
