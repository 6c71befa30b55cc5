// The consoles of `nezumi run`: the prompt on its terminal, commands from standard input, and attached consoles.
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

/// True if standard input and output are a terminal and the program is in the foreground.
bool has_terminal();

class RunConsole final : public Attendant {
public:
    /// The loop must outlive this object. `name` is the name for attaching.
    RunConsole(RunLoop& loop, const std::string& name);
    ~RunConsole() override;
    RunConsole(const RunConsole&) = delete;
    RunConsole& operator=(const RunConsole&) = delete;

    /// Allows others to attach.
    Expected<void> listen() { return server_->listen(name_); }
    /// Opens the prompt; `news` is shown first, unless it is empty. The run ends when the user leaves the prompt.
    Expected<void> open_prompt(const std::string& news);
    /// Reads commands from standard input: time advances only by commands. The run ends after the last one.
    Expected<void> open_batch();
    /// Ends all clients, and waits until the terminal is restored.
    void close();

    /// Passes a log line to all clients that want it. Returns true if the run's own client shows it, so that it need
    /// not be shown elsewhere.
    bool log(const LogLine& line);
    bool say(const std::string& text);
    /// True if no command has failed.
    bool all_well() const { return all_well_; }
    /// The number of the line of --batch that was interrupted, or not run, at the end of the run; 0: none. Valid after
    /// `close`.
    int unfinished_line() const { return unfinished_; }
    /// True while a command of --batch is running.
    bool is_batch_running() const { return server_ && server_->is_batch_running(); }
    /// True if standard output or error is slower than --batch.
    bool is_behind() const { return server_ && server_->is_behind(); }

    ConsoleServer& server() { return *server_; }
    /// Sets the function that gets the state as one line, about once per second.
    void show_status_by(std::function<void(const std::string&, bool running)> show) { show_ = std::move(show); }

    bool serve(Pacer::Clock::time_point until) override;
    void add_files(std::vector<int>& files) const override { files.push_back(server_->file()); }
    /// Called after every tick.
    void after_tick() { server_->after_tick(); }

private:
    Expected<Descriptor> connect(ConsoleServer::Use use);
    void show_status();

    RunLoop& loop_;
    std::string name_;
    std::unique_ptr<ConsoleServer> server_;
    std::thread client_;              // of the run's own client
    std::atomic<bool> left_ = false;  // the run's own client has ended
    std::atomic<bool> all_well_ = true;
    std::atomic<int> unfinished_ = 0;
    std::function<void(const std::string&, bool)> show_;
    Pacer::Clock::time_point shown_{};
    double simulated_ = 0;  // [s] at shown_
    bool was_paused_ = false;
};

}  // namespace nezumi::cli
