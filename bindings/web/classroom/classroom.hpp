// A class: joins pupils, gives each a system of their own, and shows the teacher their progress.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/web/access.hpp"
#include "bindings/web/classroom/exercises.hpp"
#include "bindings/web/classroom/seat.hpp"
#include "bindings/web/classroom/shared_system.hpp"
#include "bindings/web/classroom/work_folder.hpp"
#include "bindings/web/job_thread.hpp"
#include "bindings/web/sockets.hpp"
#include "bindings/web/static_files.hpp"
#include "engine/base/descriptor.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::web {

struct ClassOptions {
    std::filesystem::path folder{};                  ///< folder of the class, with pupils/, exercises/, collected/
    std::vector<std::filesystem::path> exercises{};  ///< folders of exercises in addition to `folder`/exercises
    std::filesystem::path page{};                    ///< folder of the page's files
    std::string program{};                           ///< path of nezumi
    bool trust = false;                              ///< the kernel does not confine pupils' processes
    Quota quota{};                                   ///< limits for a pupil's copy of an exercise
    SharedOptions shared{};
    SocketOptions sockets{};
};

/// The exercises in the folder of the class, and those of the other folders in the options.
std::vector<Exercise> exercises_of(const ClassOptions& options);

class Classroom final : public Site {
public:
    static constexpr std::size_t most_pupils = 60;
    /// The most browsers without a pupil yet, and the most of one pupil.
    static constexpr std::size_t most_visitors = 40, most_of_pupil = 6;
    /// The most browsers at a time.
    static constexpr std::size_t most_browsers = 3 * most_pupils + most_visitors;
    /// The most new pupils in a minute.
    static constexpr std::size_t most_joins = 40;
    /// The most requests of one browser to the class: per second, and in a burst.
    static constexpr double most_requests = 5, most_at_once = 20;

    /// Starts to serve. An error gives the reason in one line.
    static Expected<std::unique_ptr<Classroom>> open(ClassOptions options);
    ~Classroom() override;
    Classroom(const Classroom&) = delete;
    Classroom& operator=(const Classroom&) = delete;

    /// The address for pupils, and the address with the token for the teacher.
    std::string url() const;
    std::string teacher_url() const;

    /// Serves until `ends` is true.
    void run(const std::function<bool()>& ends);

    // The site; runs in the sockets' thread.

    HttpReply reply_to(const HttpRequest& request) override;
    Admission lets_in(const HttpRequest& request) override;
    void opened(ClientId client, const Admission& admission) override;
    bool received(ClientId client, std::string_view text) override;
    std::optional<Outgoing> next(ClientId client) override;
    void closed(ClientId client) override;

private:
    using Json = nlohmann::ordered_json;
    // Requests that a viewer, or a pupil of a frozen class, may still send.
    static constexpr std::array<std::string_view, 5> while_looking{"watch", "floor", "stop", "remembered", "systems"};
    using Clock = std::chrono::steady_clock;
    // guest: a pupil in the page of the shared system. reader: a pupil in the page of a failed or watched scenario.
    enum class Role { visitor, teacher, pupil, helper, looker, spectator, guest, reader };

    struct Waiting {
        Outgoing message;
        bool relayed = false;  // from a pupil's process, which sends the next one only after this one
    };
    struct Client {
        Role role = Role::visitor;
        int pupil = 0;   // the number of the pupil who uses it, or whose system it shows; 0: none
        int system = 0;  // number of the system that it shows, as in `system_at`; 0: none
        std::string source{};
        std::deque<Waiting> waiting{};
        std::string shown{};  // the last state of the class that was sent
        Clock::time_point shown_at{};
        double allowance = most_at_once;
        Clock::time_point came{};
    };

    explicit Classroom(ClassOptions options, Pupils pupils);

    // Call all these functions with the lock held.
    Seat* seat_of(int pupil);
    ClassSystem* system_at(int number);
    static int number_at(Role role, int pupil);
    bool is_spectator(const Client& client) const;
    bool is_there(int pupil) const;
    void send(Client& client, const Json& json);
    void close(Client& client);
    void relay(Client& client, ClientId id, std::string_view text);
    /// Why this message may not reach the system; "" if it may.
    std::string why_not(const Client& client, const Json& request);
    bool is_too_fast(Client& client) const;
    Expected<Json> perform(Client& client, const Json& request);
    Expected<Json> join(Client& client, const Json& request);
    Expected<Json> teach(const Json& request);
    Expected<Json> teach_one(Seat& seat, const std::string& what, const Json& request);
    Expected<void> give_exercise(Seat& seat, const std::string& name);
    Expected<void> check_later(Seat& seat);
    Expected<Json> collect();
    void tell_all(std::string_view message);
    Seat& add_seat(Pupil& pupil);
    /// Opens a page for a failed scenario, or for a scenario that runs now. Ends the page that was opened before.
    Expected<void> open_page(const Client& client, ClientId id, const Json& request);
    void close_page(Seat& seat);
    void serve_page(Seat& seat, Clock::time_point now);
    void start(Seat& seat);
    void start(ClassSystem& system, std::vector<std::string> words);
    void restart(ClassSystem& system);
    void ended(Seat& seat);
    void read_from(ClassSystem& system);
    void upkeep(Clock::time_point now);
    void show_states();
    Json state_for_teacher() const;
    Json state_for_pupil(const Client& client) const;
    Json tile(const Seat& seat) const;
    const Exercise* exercise_called(std::string_view name) const;

    // For the shared system, also with the lock held.
    bool drives(const Client& client) const;
    /// Why a guest may not send this request to the shared system; "" if the guest may.
    std::string why_not_shared(const Client& client, const Json& request) const;
    Expected<Json> ask_shared(const Client& client, std::string_view what);
    Expected<Json> teach_shared(const Json& request);
    void take_behaviors();
    void begin_turn();
    void end_turn();
    void serve_shared(Clock::time_point now);
    Json state_of_shared() const;
    Json shared_for_pupil(const Client& client) const;

    void serve_once();
    void check_now(int pupil);

    const ClassOptions options_;
    const AccessControl access_;  // the full token is for the teacher, the view token for spectators
    const StaticFiles files_;
    const std::vector<Exercise> exercises_;
    std::string origin_;
    Descriptor news_;  // eventfd

    mutable Mutex mutex_;  // for all members below
    Pupils pupils_;
    std::map<int, std::unique_ptr<Seat>> seats_;
    std::unique_ptr<SharedSystem> shared_;  // null if there is none
    std::vector<std::unique_ptr<PupilRun>> ending_;
    std::map<ClientId, Client> clients_;
    std::array<std::string, 256> sources_;  // addresses of the latest visitors
    std::size_t next_source_ = 0;
    Tries tries_;
    std::deque<Clock::time_point> joins_;
    std::string first_exercise_;  // the exercise of a new pupil
    bool door_is_open_ = true;
    bool is_frozen_ = false;
    int projected_ = 0;  // number of the system that spectators see; 0: none
    std::string collected_;
    Clock::time_point looked_{};
    Clock::time_point shown_{};
    std::atomic<bool> ends_ = false;
    std::unique_ptr<Sockets> sockets_;
    std::unique_ptr<JobThread> jobs_;
};

}  // namespace nezumi::web
