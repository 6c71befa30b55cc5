// The lock is held only to move data in and out of queues; frames are made without it.
#include "bindings/web/hub.hpp"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bindings/web/page_directory.hpp"
#include "engine/base/json_text.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

std::string refusal(std::int64_t id, std::string_view why) {
    return json_text(Json{{"is", "answer"}, {"id", id}, {"ok", false}, {"text", why}});
}

// The other pages with their addresses: a view-only browser gets view-only addresses.
std::string list_of(const std::vector<RunningPage>& pages, bool view_only) {
    Json systems = Json::array();
    for (const RunningPage& page : pages) {
        const bool is_here = page.process == getpid();
        systems.push_back({{"name", page.name},
                           {"process", page.process},
                           {"here", is_here},
                           {"url", is_here     ? ""
                                   : view_only ? page.view_url
                                               : page.url}});
    }
    return Json{{"is", "systems"}, {"systems", std::move(systems)}}.dump();
}

void remove_doubles(std::vector<std::string>& names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
}

// Whether a message only changes how fast time passes.
bool is_pace(const BrowserMessage& message) {
    const auto* time = std::get_if<TimeMessage>(&message.body);
    return time != nullptr && time->what != TimeMessage::What::restart && time->what != TimeMessage::What::quit;
}

}  // namespace

bool is_stop(const BrowserMessage& message) {
    const auto* act = std::get_if<ActMessage>(&message.body);
    return act != nullptr && std::holds_alternative<Stop>(act->act);
}

void put_in_order(std::vector<Hub::Incoming>& waiting, std::size_t from, Hub::Incoming incoming) {
    auto place = waiting.end();
    if (incoming.what == Hub::Incoming::What::message && is_stop(incoming.message)) {
        place = waiting.begin() + static_cast<std::ptrdiff_t>(from);
        const auto comes = std::find_if(place, waiting.end(), [&](const Hub::Incoming& each) {
            return each.client == incoming.client && each.what == Hub::Incoming::What::opened;
        });
        if (comes != waiting.end()) place = comes + 1;
    }
    waiting.insert(place, std::move(incoming));
}

Hub::Hub(AccessControl access, StaticFiles files, PartReader parts, std::string hello)
    : access_(std::move(access)),
      files_(std::move(files)),
      parts_{std::move(parts.project), parts.scripts},
      hello_(std::move(hello)),
      news_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

std::vector<Hub::Incoming> Hub::take() {
    const std::lock_guard lock(mutex_);
    if (incoming_.empty()) return {};
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t got = read(news_.get(), &count, sizeof count);
    for (auto& [id, client] : clients_) client.waiting = 0;
    return std::exchange(incoming_, {});
}

Watch Hub::wanted() const {
    const std::lock_guard lock(mutex_);
    return wanted_;
}

std::unique_ptr<State> Hub::take_back() {
    const std::lock_guard lock(mutex_);
    return std::move(state_);
}

void Hub::put(std::unique_ptr<State> state) {
    const std::lock_guard lock(mutex_);
    state_ = std::move(state);
}

void Hub::put_text(Client& client, std::string text, bool lossy) {
    const bool full = client.backlog > (client.lost > 0 ? most_backlog / 2 : most_backlog);
    if (full && lossy) {
        ++client.lost;
        return;
    }
    if (client.lost > 0 && !full)
        client.texts.push_back(Json{{"is", "lost"}, {"count", std::exchange(client.lost, 0)}}.dump());
    client.backlog += text.size();
    client.is_behind = client.is_behind || client.backlog > longest_backlog;
    if (!client.is_behind) client.texts.push_back(std::move(text));
}

void Hub::send(ClientId id, std::string text, bool lossy) {
    const std::lock_guard lock(mutex_);
    const auto client = clients_.find(id);
    if (client != clients_.end()) put_text(client->second, std::move(text), lossy);
}

void Hub::send_all(const std::string& text, bool lossy) {
    const std::lock_guard lock(mutex_);
    for (auto& [id, client] : clients_) put_text(client, text, lossy);
}

void Hub::log(std::string text) {
    const std::lock_guard lock(mutex_);
    for (auto& [id, client] : clients_) put_text(client, text, true);
    kept_ += text.size();
    log_.push_back(std::move(text));
    while (log_.size() > most_kept || kept_ > longest_kept) {
        kept_ -= log_.front().size();
        log_.pop_front();
    }
}

void Hub::end(const std::string& text) {
    const std::lock_guard lock(mutex_);
    for (auto& [id, client] : clients_) put_text(client, text, false);
    goodbye_ = text;
}

void Hub::show(Slot slot, std::string text) {
    const std::lock_guard lock(mutex_);
    slots_.insert_or_assign(slot, Shown{std::move(text), ++last_number_});
}

void Hub::show_floor(std::string file) {
    const std::lock_guard lock(mutex_);
    floor_ = std::move(file);
}

void Hub::show_picture(const std::string& port, std::string message) {
    const std::lock_guard lock(mutex_);
    pictures_.insert_or_assign(port, Shown{std::move(message), ++last_number_});
}

// Reads clients_ without the lock, because only this thread changes what is read here.
void Hub::watch_anew() {
    Watch all;
    for (const auto& [id, client] : clients_) {
        all.ports.insert(all.ports.end(), client.watch.ports.begin(), client.watch.ports.end());
        all.pictures.insert(all.pictures.end(), client.watch.pictures.begin(), client.watch.pictures.end());
        all.members.insert(all.members.end(), client.watch.members.begin(), client.watch.members.end());
        all.truth = all.truth || client.watch.truth;
        all.rays = all.rays || client.watch.rays;
        all.peers = all.peers || client.watch.peers;
    }
    remove_doubles(all.ports);
    remove_doubles(all.pictures);
    remove_doubles(all.members);
    const std::lock_guard lock(mutex_);
    wanted_ = std::move(all);
    std::erase_if(pictures_, [&](const auto& each) {
        return !std::binary_search(wanted_.pictures.begin(), wanted_.pictures.end(), each.first);
    });
}

HttpReply Hub::reply_to(const HttpRequest& request) {
    if (!access_.is_own_host(request.host))
        return {.status = 403,
                .body = "this page is not served under this host name: open the address that nezumi has printed\n"};
    return files_.get(request.path);
}

Admission Hub::lets_in(const HttpRequest& request) {
    Admission admission = access_.check(request);
    const std::lock_guard lock(mutex_);
    const auto viewers = static_cast<std::size_t>(
        std::count_if(clients_.begin(), clients_.end(), [](const auto& each) { return each.second.view_only; }));
    const bool is_full = clients_.size() >= most_clients || (admission.view_only && viewers >= most_viewers);
    if (admission.refused == 0 && (goodbye_ || is_full)) admission.refused = unavailable;
    return admission;
}

void Hub::opened(ClientId id, const Admission& admission) {
    const bool view_only = admission.view_only || !only_shows_.empty();
    const std::lock_guard lock(mutex_);
    Client& client = clients_[id];
    client.view_only = view_only;
    client.paces = !only_shows_.empty() && !admission.view_only;
    client.came = Clock::now();
    ++clients_there_;
    // The browser's own fields come first.
    put_text(client,
             fmt::format(R"({{"is":"hello","you":"browser {}","view_only":{},"paces":{},"view_token":"{}",{})", id,
                         view_only, client.paces, access_.view_token(), hello_),
             false);
    for (const std::string& line : log_) put_text(client, line, true);
    if (goodbye_) put_text(client, *goodbye_, false);  // the run ended while the browser was being admitted
    incoming_.push_back({.client = id, .what = Incoming::What::opened, .view_only = view_only});
    eventfd_write(news_.get(), 1);
}

bool Hub::is_too_fast(Client& client) {
    const auto now = Clock::now();
    const double passed = std::chrono::duration<double>(now - client.came).count();
    client.came = now;
    client.allowance = std::min(most_messages, client.allowance + passed * most_messages) - 1;
    return client.allowance < 0;
}

bool Hub::received(ClientId id, std::string_view text) {
    auto message = read_message(text, parts_);  // outside of the lock, because an act may read files
    const bool wants_systems = message && std::holds_alternative<SystemsMessage>(message->body);
    const std::vector<RunningPage> pages = wants_systems ? running_pages() : std::vector<RunningPage>();
    Lock lock(mutex_);
    const auto found = clients_.find(id);
    if (found == clients_.end()) return false;
    Client& client = found->second;
    if (is_too_fast(client)) return false;
    if (!message) {
        put_text(client, refusal(message.error().id, message.error().text), false);
        return true;
    }
    if (auto* watch = std::get_if<Watch>(&message->body)) {
        client.watch = std::move(*watch);
        client.seen = {};
        client.pictures.clear();
        lock.unlock();
        watch_anew();
        return true;
    }
    if (wants_systems) {
        put_text(client, list_of(pages, client.view_only), false);
        return true;
    }
    if (std::holds_alternative<FloorMessage>(message->body)) {
        client.wants_floor = !floor_.empty();
        return true;
    }
    const bool changes_nothing = std::holds_alternative<ExplainMessage>(message->body) ||
                                 std::holds_alternative<RememberedMessage>(message->body) ||
                                 std::holds_alternative<ThenMessage>(message->body) ||
                                 std::holds_alternative<EarlierMessage>(message->body);
    if (client.view_only && !changes_nothing && !(client.paces && is_pace(*message))) {
        put_text(client, refusal(message->id, client.paces ? only_shows_ : "this link is view-only"), false);
        return true;
    }
    if (++client.waiting > most_waiting) return false;
    put_in_order(incoming_, 0, {.client = id, .what = Incoming::What::message, .message = std::move(*message)});
    eventfd_write(news_.get(), 1);
    return true;
}

std::optional<Outgoing> Hub::next_text(Client& client) {
    if (!client.texts.empty()) {
        Outgoing out{.bytes = std::move(client.texts.front())};
        client.texts.pop_front();
        client.backlog -= std::min(client.backlog, out.bytes.size());
        return out;
    }
    if (goodbye_) return Outgoing{.closes = true};
    for (const auto& [slot, shown] : slots_) {
        std::uint64_t& got = client.shown[slot];
        if (got == shown.number) continue;
        got = shown.number;
        return Outgoing{.bytes = shown.text};
    }
    return std::nullopt;
}

std::optional<Outgoing> Hub::next_picture(Client& client) {
    for (const std::string& port : client.watch.pictures) {
        const auto picture = pictures_.find(port);
        if (picture == pictures_.end()) continue;
        std::uint64_t& got = client.pictures[port];
        if (got == picture->second.number) continue;
        got = picture->second.number;
        return Outgoing{.binary = true, .bytes = picture->second.text};
    }
    return std::nullopt;
}

Outgoing Hub::read_floor(const std::string& file) {
    auto bytes = read_whole(file, file, largest_floor);
    if (bytes) return {.binary = true, .bytes = std::string{static_cast<char>(BinaryKind::floor), 0, 0, 0} + *bytes};
    const Json line{{"is", "log"},
                    {"level", "warn"},
                    {"component", ""},
                    {"text", "the floor's picture can't be shown: " + nezumi::describe(bytes.error())},
                    {"at", 0}};
    return {.bytes = json_text(line)};
}

std::optional<Outgoing> Hub::next(ClientId id) {
    Client* client = nullptr;
    std::unique_ptr<State> state;
    Watch watch;
    std::string floor;
    {
        const std::lock_guard lock(mutex_);
        const auto found = clients_.find(id);
        if (found == clients_.end()) return std::nullopt;
        client = &found->second;
        if (client->is_behind) return Outgoing{.closes = true};
        if (auto text = next_text(*client)) return text;
        // A frame is valid only after the description of its system was sent.
        if (!client->shown.contains(Slot::system)) return std::nullopt;
        if (auto picture = next_picture(*client)) return picture;
        if (std::exchange(client->wants_floor, false)) {
            floor = floor_;
        } else {
            state = std::move(state_);
            watch = client->watch;
        }
    }
    if (!floor.empty()) return read_floor(floor);
    // Only this thread adds and removes clients, and uses the following members.
    if (state != nullptr) changes_.take(std::move(*state));
    if (!changes_.is_news(client->seen)) return std::nullopt;
    const WebFrame frame = changes_.since(client->seen, watch);
    Octets bytes;
    write_cdr(bytes, {}, frame);
    Outgoing out{.binary = true, .bytes = {static_cast<char>(BinaryKind::frame), 0, 0, 0}};
    out.bytes.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return out;
}

void Hub::closed(ClientId id) {
    Lock lock(mutex_);
    if (clients_.erase(id) == 0) return;
    --clients_there_;
    std::erase_if(incoming_, [&](const Incoming& each) {
        return each.client == id && each.what == Incoming::What::message && !is_stop(each.message);
    });
    incoming_.push_back({.client = id, .what = Incoming::What::closed});
    eventfd_write(news_.get(), 1);
    lock.unlock();
    watch_anew();
}

}  // namespace nezumi::web
