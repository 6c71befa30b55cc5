// Passes the messages of browsers to the processes of pupils unchanged. Only messages to the class are read here.
#include "bindings/web/classroom/classroom.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <utility>

#include "bindings/web/classroom/confinement.hpp"
#include "engine/base/json_text.hpp"
#include "engine/base/list.hpp"

namespace nezumi::web {
namespace {

// The token of all visitors. It is not a secret.
constexpr std::string_view visitors = "join";
constexpr std::string_view for_the_class = R"("do":"class")";

// Whether the request is for a page of its own: a failed run, or a scenario to watch.
bool opens_page(const nlohmann::ordered_json& request) {
    if (!request.is_object() || request.value("do", nlohmann::ordered_json()) != "test") return false;
    const auto what = request.value("what", nlohmann::ordered_json());
    return what == "open" || what == "watch";
}

}  // namespace

Classroom::Classroom(ClassOptions options, Pupils pupils)
    : options_(std::move(options)),
      access_(options_.sockets.certificate.empty() ? "http" : "https", options_.sockets.address),
      files_(options_.page),
      exercises_(exercises_of(options_)),
      news_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      pupils_(std::move(pupils)) {}

std::vector<Exercise> exercises_of(const ClassOptions& options) {
    std::vector<std::filesystem::path> folders{options.folder / "exercises"};
    folders.insert(folders.end(), options.exercises.begin(), options.exercises.end());
    return find_exercises(folders);
}

Expected<std::unique_ptr<Classroom>> Classroom::open(ClassOptions options) {
    if (!options.trust && !can_confine())
        return failure(
            "this kernel can't confine the programs of pupils (Landlock, Linux 5.13): they could read all your files. "
            "Use another computer, or --trust if you trust all pupils");
    auto pupils = Pupils::load(options.folder);
    if (!pupils) return Unexpected(pupils.error());
    options.sockets.clients = most_browsers;
    std::unique_ptr<Classroom> room(new Classroom(std::move(options), std::move(*pupils)));
    if (room->exercises_.empty()) return failure("there is no exercise: write one with nezumi new exercise NAME");
    if (room->access_.token().empty() || room->access_.view_token().empty())
        return failure("can't get random numbers from the kernel for the secret in the class's address");
    room->first_exercise_ = room->exercises_.front().name;
    room->jobs_ = std::make_unique<JobThread>();
    for (const auto& pupil : room->pupils_.all()) room->add_seat(*pupil);
    if (!room->options_.shared.file.empty()) {
        auto shared = SharedSystem::open(room->options_.shared, room->options_.folder / "shared");
        if (!shared) return Unexpected(shared.error());
        room->shared_ = std::move(*shared);
    }
    auto sockets = open_sockets(room->options_.sockets, *room);
    if (!sockets) return Unexpected(sockets.error());
    const std::lock_guard lock(room->mutex_);
    room->sockets_ = std::move(*sockets);
    room->origin_ = fmt::format("{}://{}:{}/", room->options_.sockets.certificate.empty() ? "http" : "https",
                                room->options_.sockets.address, room->sockets_->port());
    return room;
}

Classroom::~Classroom() {
    ends_ = true;
    jobs_.reset();
    if (sockets_) {
        const std::lock_guard lock(mutex_);
        for (auto& [id, client] : clients_) {
            send(client, {{"is", "bye"}, {"text", "the class has ended"}});
            close(client);
        }
        sockets_->wake();
    }
    sockets_.reset();
    for (auto& [number, seat] : seats_) {
        if (seat->page && seat->page->run) seat->page->run->end();
        if (seat->run) seat->run->end();  // asks all processes to end, before the destructors wait for each
    }
    if (shared_ && shared_->run) shared_->run->end();
}

std::string Classroom::url() const { return origin_; }
std::string Classroom::teacher_url() const { return origin_ + "class.html#" + access_.token(); }

void Classroom::run(const std::function<bool()>& ends) {
    while (!ends()) serve_once();
}

void Classroom::serve_once() {
    std::vector<pollfd> files{{news_.get(), POLLIN, 0}};
    std::vector<int> numbers{0};
    {
        const std::lock_guard lock(mutex_);
        const auto add = [&](int number, const ClassSystem& system) {
            if (!system.run || system.run->socket() < 0 || system.run->is_ending()) return;
            files.push_back({system.run->socket(), static_cast<short>(POLLIN | (system.out.empty() ? 0 : POLLOUT)), 0});
            numbers.push_back(number);
        };
        for (const auto& [number, seat] : seats_) {
            add(number, *seat);
            if (seat->page) add(SharedSystem::page_of(number), *seat->page);
        }
        if (shared_) add(SharedSystem::number, *shared_);
    }
    poll(files.data(), files.size(), 50);
    eventfd_t none = 0;
    eventfd_read(news_.get(), &none);
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 1; i < files.size(); ++i) {
        ClassSystem* system = system_at(numbers[i]);
        if (files[i].revents == 0 || system == nullptr) continue;
        if (!system->run || system->run->socket() != files[i].fd) continue;
        system->flush();
        read_from(*system);
    }
    upkeep(Clock::now());
    sockets_->wake();
}

void Classroom::read_from(ClassSystem& system) {
    std::array<char, 1 << 16> piece{};
    const ssize_t got = recv(system.run->socket(), piece.data(), piece.size(), MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (got <= 0) return system.run->end();  // `upkeep` sees the end of the process
    system.reader.add({piece.data(), static_cast<std::size_t>(got)});
    while (auto frame = system.reader.next()) {
        if (frame->client == own_client) {
            system.view.take(*frame);
            // After a text, more texts may follow. A frame of a tick comes only when no text waits.
            if (frame->kind == RelayFrame::Kind::text)
                system.tell({.kind = RelayFrame::Kind::ready, .client = own_client});
            else
                system.view_is_ready = true;
            continue;
        }
        const auto client = clients_.find(frame->client);
        if (client == clients_.end() || system_at(client->second.system) != &system) continue;
        if (frame->kind == RelayFrame::Kind::closes) {
            close(client->second);
            continue;
        }
        client->second.waiting.push_back(
            {{.binary = frame->kind == RelayFrame::Kind::binary, .bytes = std::move(frame->bytes)}, true});
    }
    if (system.reader.is_broken()) system.run->end();
}

HttpReply Classroom::reply_to(const HttpRequest& request) {
    if (!access_.is_own_host(request.host))
        return {.status = 403,
                .body = "this page is not served under this host name: open the address that nezumi has printed\n"};
    return files_.get(request.path == "/" ? "/join.html" : request.path);
}

Admission Classroom::lets_in(const HttpRequest& request) {
    const auto token = access_.offered_token(request);
    if (!token) return {.refused = forbidden};
    const std::lock_guard lock(mutex_);
    std::string none;
    Role role = Role::visitor;
    int pupil = 0;
    if (is_same_secret(*token, access_.token())) {
        role = Role::teacher;
    } else if (is_same_secret(*token, access_.view_token())) {
        role = Role::spectator;
        pupil = projected_;
        if (pupil == 0) return {.refused = unavailable};
    } else if (*token != visitors) {
        for (const auto& [number, seat] : seats_) {
            for (const auto& [secret, its] : {std::pair{&seat->pupil.token, Role::pupil},
                                              {&seat->help_token, Role::helper},
                                              {&seat->look_token, Role::looker},
                                              {&seat->shared_token, Role::guest},
                                              {seat->page ? &seat->page->help_token : &none, Role::reader}}) {
                if (!is_same_secret(*token, *secret)) continue;
                role = its;
                pupil = number;
            }
        }
        if (shared_ && is_same_secret(*token, shared_->help_token)) {
            role = Role::helper;
            pupil = SharedSystem::number;
        }
        if (pupil == 0) return {.refused = forbidden};
    }
    if (ClassSystem* system = system_at(number_at(role, pupil))) {
        system->is_wanted = true;
        // Without a process, messages of the browser would be lost, so it is refused and tries again.
        if (!system->run || system->run->is_ending()) return {.refused = unavailable};
    } else if (role == Role::guest) {
        return {.refused = forbidden};
    }
    const auto alike = static_cast<std::size_t>(std::count_if(clients_.begin(), clients_.end(), [&](const auto& each) {
        return each.second.role == role && each.second.pupil == pupil;
    }));
    const std::size_t most = role == Role::visitor ? most_visitors : most_of_pupil;
    if (alike >= most || clients_.size() >= most_browsers) return {.refused = unavailable};
    if (role == Role::visitor) {
        // The number of a visitor is the index of its address in sources_.
        next_source_ = (next_source_ + 1) % sources_.size();
        sources_[next_source_] = request.source;
        pupil = static_cast<int>(next_source_);
    }
    return {.seat = pupil * 8 + static_cast<int>(role)};
}

void Classroom::opened(ClientId id, const Admission& admission) {
    const std::lock_guard lock(mutex_);
    Client& client = clients_[id];
    client.role = static_cast<Role>(admission.seat % 8);
    if (client.role == Role::visitor)
        client.source = sources_[static_cast<std::size_t>(admission.seat / 8)];
    else
        client.pupil = admission.seat / 8;
    client.system = number_at(client.role, client.pupil);
    client.came = Clock::now();
    if (ClassSystem* system = system_at(client.system); system != nullptr && system->run) {
        system->tell(
            {.kind = is_spectator(client) ? RelayFrame::Kind::viewer : RelayFrame::Kind::opened, .client = id});
        system->tell({.kind = RelayFrame::Kind::ready, .client = id});
    }
    eventfd_write(news_.get(), 1);
}

bool Classroom::is_too_fast(Client& client) const {
    const auto now = Clock::now();
    const double passed = std::chrono::duration<double>(now - client.came).count();
    client.came = now;
    client.allowance = std::min(most_at_once, client.allowance + passed * most_requests) - 1;
    return client.allowance < 0;
}

bool Classroom::received(ClientId id, std::string_view text) {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(id);
    if (found == clients_.end()) return false;
    Client& client = found->second;
    const bool is_ours = client.system == 0 || text.find(for_the_class) != std::string_view::npos;
    if (!is_ours) {
        relay(client, id, text);
        return true;
    }
    if (is_too_fast(client)) return false;
    const Json request = Json::parse(text.begin(), text.end(), nullptr, false);
    if (!request.is_object()) return false;
    const auto done = perform(client, request);
    Json answer{{"is", "answer"}, {"id", request.value("id", Json())}, {"ok", done.has_value()}};
    if (!done)
        answer["text"] = describe(done.error());
    else
        answer.update(*done);
    send(client, answer);
    eventfd_write(news_.get(), 1);
    return true;
}

void Classroom::relay(Client& client, ClientId id, std::string_view text) {
    ClassSystem* system = system_at(client.system);
    if (system == nullptr) return;
    // Most messages are passed on without reading them.
    const bool at_shared = client.system == SharedSystem::number;
    const bool is_read = at_shared || (is_frozen_ && (client.role == Role::pupil || client.role == Role::reader)) ||
                         text.find(R"("save")") != std::string_view::npos ||
                         text.find(R"("do":"test")") != std::string_view::npos;
    if (is_read) {
        const Json request = Json::parse(text.begin(), text.end(), nullptr, false);
        if (const std::string why = why_not(client, request); !why.empty())
            return send(client, {{"is", "answer"},
                                 {"id", request.is_object() ? request.value("id", Json()) : Json()},
                                 {"ok", false},
                                 {"text", why}});
        if (opens_page(request) && !at_shared) {
            if (const auto opened = open_page(client, id, request); !opened)
                send(client, {{"is", "answer"},
                              {"id", request.value("id", Json())},
                              {"ok", false},
                              {"text", describe(opened.error())}});
            return;
        }
        // Everybody may stop the shared system, also a viewer.
        if (at_shared && request.is_object() && request.value("do", Json()) == "stop") {
            system->tell(stop_message);
            return send(client, {{"is", "answer"}, {"id", request.value("id", Json())}, {"ok", true}, {"text", ""}});
        }
    }
    system->tell({.kind = RelayFrame::Kind::message, .client = id, .bytes = std::string(text)});
}

std::string Classroom::why_not(const Client& client, const Json& request) {
    const auto text = [&](const char* name) {
        const auto found = request.is_object() ? request.find(name) : request.end();
        return found != request.end() && found->is_string() ? found->get<std::string>() : "";
    };
    const std::string what = text("do");
    const bool looks = contains(while_looking, what);
    const bool is_pupil = client.role == Role::pupil || client.role == Role::guest || client.role == Role::reader;
    if (is_frozen_ && is_pupil && !looks) return "the teacher has paused the class";
    if (client.role == Role::guest) return looks ? "" : why_not_shared(client, request);
    const Seat* seat = seat_of(client.pupil);
    if (seat == nullptr || what != "edit" || text("what") != "save") return "";
    const auto fits = check_quota(pupils_.work_of(seat->pupil), text("file"), text("text"), options_.quota);
    return fits ? "" : describe(fits.error());
}

std::optional<Outgoing> Classroom::next(ClientId id) {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(id);
    if (found == clients_.end() || found->second.waiting.empty()) return std::nullopt;
    Waiting waiting = std::move(found->second.waiting.front());
    found->second.waiting.pop_front();
    ClassSystem* system = waiting.relayed ? system_at(found->second.system) : nullptr;
    if (system != nullptr) system->tell({.kind = RelayFrame::Kind::ready, .client = id});
    return std::move(waiting.message);
}

void Classroom::closed(ClientId id) {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(id);
    if (found == clients_.end()) return;
    ClassSystem* system = system_at(found->second.system);
    if (system != nullptr) system->tell({.kind = RelayFrame::Kind::closed, .client = id});
    // If the driving pupil has no page any more, the robots must stop.
    const bool drove = drives(found->second);
    clients_.erase(found);
    const bool still =
        std::any_of(clients_.begin(), clients_.end(), [&](const auto& each) { return drives(each.second); });
    if (drove && !still) system->tell(stop_message);
}

void Classroom::send(Client& client, const Json& json) {
    client.waiting.push_back({{.bytes = json_text(json)}, false});
}

void Classroom::close(Client& client) { client.waiting.push_back({{.closes = true}, false}); }

Seat* Classroom::seat_of(int pupil) {
    const auto found = seats_.find(pupil);
    return found == seats_.end() ? nullptr : found->second.get();
}

ClassSystem* Classroom::system_at(int number) {
    if (number == SharedSystem::number) return shared_.get();
    if (number < SharedSystem::number) return seat_of(number);
    Seat* seat = seat_of(number - SharedSystem::number);
    return seat == nullptr ? nullptr : seat->page.get();
}

int Classroom::number_at(Role role, int pupil) {
    switch (role) {
        case Role::visitor: return 0;
        case Role::guest: return SharedSystem::number;
        case Role::reader: return SharedSystem::page_of(pupil);
        default: return pupil;
    }
}

bool Classroom::is_spectator(const Client& client) const {
    return client.role == Role::looker || client.role == Role::spectator ||
           (client.role == Role::guest && !drives(client));
}

}  // namespace nezumi::web
