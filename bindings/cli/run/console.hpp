// The consoles of `nezumi run`: the prompt on its own terminal, commands from a file, and those who attach.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bindings/console/server.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

/// Whether a person sits at a terminal that the prompt may have: standard input and output, in the foreground.
bool has_terminal();

class RunConsole final : public Attendant {
public:
    /// The loop must outlive it. `name` is what it is called by those who attach.
    RunConsole(RunLoop& loop, const std::string& name);
    ~RunConsole() override;
    RunConsole(const RunConsole&) = delete;
    RunConsole& operator=(const RunConsole&) = delete;

    /// Lets others attach.
    Expected<void> listen() { return server_->listen(name_); }
    /// Opens the prompt, which begins with `news`, a line or none. The run ends when it is left.
    Expected<void> open_prompt(const std::string& news);
    /// Takes commands from standard input: time stands still but for what they say. The run ends after the last.
    Expected<void> open_batch();
    /// Says goodbye to everybody, and waits until the terminal is as it was before.
    void close();

    /// What is said in the log, or otherwise, to those who want to know. Returns whether that is whoever started the
    /// run: then it need not be said elsewhere.
    bool log(const LogLine& line);
    bool say(const std::string& text);
    /// No command has failed.
    bool all_well() const { return all_well_; }
    /// The line of --batch that was cut off, or never run, when the run ended; 0: none. After `close`.
    int unfinished_line() const { return unfinished_; }
    /// A command of --batch is at work.
    bool batch_works() const { return server_ && server_->batch_works(); }
    /// Standard output or error take less than --batch says.
    bool is_behind() const { return server_ && server_->is_behind(); }

    ConsoleServer& server() { return *server_; }
    /// Is given the state in one line, about once a second.
    void show_status_by(std::function<void(const std::string&, bool running)> show) { show_ = std::move(show); }

    bool serve(Pacer::Clock::time_point until) override;
    void add_files(std::vector<int>& files) const override { files.push_back(server_->file()); }
    /// After every tick.
    void after_tick() { server_->after_tick(); }

private:
    Expected<Descriptor> connect(ConsoleServer::Use use);
    void show_status();

    RunLoop& loop_;
    std::string name_;
    std::unique_ptr<ConsoleServer> server_;
    std::thread client_;              // of whoever started the run
    std::atomic<bool> left_ = false;  // it
    std::atomic<bool> all_well_ = true;
    std::atomic<int> unfinished_ = 0;
    std::function<void(const std::string&, bool)> show_;
    Pacer::Clock::time_point shown_{};
    double simulated_ = 0;  // [s] at shown_
    bool was_paused_ = false;
};

}  // namespace nezumi::cli
