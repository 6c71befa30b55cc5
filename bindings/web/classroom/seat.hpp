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

/// The result of one scenario in a check of a pupil's work.
struct CheckedScenario {
    std::string name;
    bool passed = false;
    bool hidden = false;
};

/// The state of a pupil's system, from the messages of its page.
class SeatView {
public:
    using Clock = std::chrono::system_clock;  // the wall clock: the teacher sees when an error began

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
    std::string help_token{}, look_token{};  ///< the tokens of the teacher and of viewers
    std::unique_ptr<PupilRun> run{};
    RelayReader reader{};
    std::string out{};  ///< frames that are not sent yet
    SeatView view{};
    bool is_wanted = false;      ///< the pupil has come since the class was opened
    bool view_is_ready = false;  ///< the class's own connection waits for a message
    bool is_repairing = false;   ///< the system file can't run: an empty system is shown instead
    std::string problem{};       ///< why the system can't run or has ended
    int failures = 0;            ///< number of short runs in a row
    PupilRun::Clock::time_point next_start{};

    ClassSystem();
    /// Queues a frame for the process, and sends as much as the process takes now.
    void tell(const RelayFrame& frame);
    /// Queues a message of the class itself for the process.
    void tell(std::string_view message);
    void flush();
    /// Notes why the process has ended, and when the next may start. Returns true if the system file can't run.
    bool note_end(PupilRun::Clock::time_point now);
};

/// A run that a pupil has opened in a page of its own: a failed scenario, or a scenario that runs now.
struct OpenedPage : ClassSystem {
    OpenedPage(ClientId client, std::int64_t id) : asker(client), question(id) {}

    const ClientId asker;  ///< the browser that gets the address of the page
    const std::int64_t question;
    bool is_answered = false;
    PupilRun::Clock::time_point seen = PupilRun::Clock::now();  ///< when a browser last showed the page
};

/// A pupil's place in a class.
struct Seat : ClassSystem {
    explicit Seat(Pupil& its) : pupil(its) {}

    Pupil& pupil;
    std::unique_ptr<OpenedPage> page{};       ///< null if there is none
    std::string shared_token = make_token();  ///< the pupil's token for the shared system
    std::int64_t last_save = 0;               ///< [s] since 1970
    std::vector<CheckedScenario> checked{};
    std::string check{};  ///< "waits", "runs", "" or why it could not be done
};

}  // namespace nezumi::web
