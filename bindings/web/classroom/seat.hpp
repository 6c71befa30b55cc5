// The systems of a class: their processes, and what the class sees of them through a connection of its own.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/web/access.hpp"
#include "bindings/web/classroom/pupil_run.hpp"
#include "bindings/web/classroom/pupils.hpp"
#include "bindings/web/relay.hpp"

namespace nezumi::web {

/// What a check of a pupil's work found.
struct CheckedScenario {
    std::string name;
    bool passed = false;
    bool hidden = false;
};

/// The state of a pupil's system, from the messages of its page.
class SeatView {
public:
    using Clock = std::chrono::system_clock;  // the wall clock: the teacher reads since when an error lasts

    /// Takes a text or a frame of a tick.
    void take(const RelayFrame& frame);
    void forget() { *this = {}; }

    /// "starting", "runs", "paused", "stopped" (emergency stop), "error".
    std::string state() const;
    /// The error of a component; "" for none.
    const std::string& error() const { return error_; }
    /// [s] since 1970: when the error began; 0: none.
    std::int64_t error_since() const { return error_since_; }
    bool is_described() const { return described_; }
    /// The files of its behaviours, as messages show them.
    const std::vector<std::string>& scripts() const { return scripts_; }

private:
    bool described_ = false;
    bool running_ = true;
    bool stopped_ = false;
    std::string error_;
    std::int64_t error_since_ = 0;
    std::vector<std::string> scripts_;
};

/// The message that stops all robots of a system.
inline constexpr std::string_view stop_message = R"({"do":"stop"})";

/// A system in a process of its own.
struct ClassSystem {
    std::string help_token{}, look_token{};  ///< of the teacher, and of viewers
    std::unique_ptr<PupilRun> run{};
    RelayReader reader{};
    std::string out{};  ///< frames that are not sent yet
    SeatView view{};
    bool is_wanted = false;      ///< a pupil has come for it since the class was opened
    bool view_is_ready = false;  ///< the class's own connection waits for a message
    bool is_repairing = false;   ///< the system file can't run: an empty system is shown instead
    std::string problem{};       ///< why
    int failures = 0;            ///< short runs, one after the other
    PupilRun::Clock::time_point next_start{};

    ClassSystem();
    /// Queues a frame for the process, and sends what it takes now.
    void tell(const RelayFrame& frame);
    /// Queues a message of the class itself for the process.
    void tell(std::string_view message);
    void flush();
    /// Notes why the process has ended, and when it may start again. Returns true if its system file can't run.
    bool note_end(PupilRun::Clock::time_point now);
};

/// What a pupil has opened in a page of its own: a failed scenario, or one that runs.
struct OpenedPage : ClassSystem {
    OpenedPage(ClientId client, std::int64_t id) : asker(client), question(id) {}

    const ClientId asker;  ///< gets the address
    const std::int64_t question;
    bool is_answered = false;
    PupilRun::Clock::time_point seen = PupilRun::Clock::now();  ///< a browser showed it then
};

/// A pupil's place in a class.
struct Seat : ClassSystem {
    explicit Seat(Pupil& its) : pupil(its) {}

    Pupil& pupil;
    std::unique_ptr<OpenedPage> page{};       ///< null if there is none
    std::string shared_token = make_token();  ///< of the pupil, for the shared system
    std::int64_t last_save = 0;               ///< [s] since 1970
    std::vector<CheckedScenario> checked{};
    std::string check{};  ///< "waits", "runs", "" or why it could not be done
};

}  // namespace nezumi::web
