// Sockets by libwebsockets. The site decides on content and access.
#include <libwebsockets.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/web/sockets.hpp"
#include "bindings/web/unadmitted.hpp"
#include "engine/base/descriptor.hpp"
#include "engine/base/mutex.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::web {
namespace {

// Time for browsers to receive the rest when the run ends.
constexpr std::chrono::milliseconds farewell{300};
// The most connections of all kinds: browsers, connections without a token, and connections without a token that are
// being closed.
unsigned most_connections(const SocketOptions& options) {
    return static_cast<unsigned>(options.clients + 2 * Unadmitted::most);
}
// [bytes] given to a socket at once.
constexpr std::size_t portion = std::size_t{1} << 16;
// The longest accepted header [bytes].
constexpr std::size_t longest_header = 512;
// [s] without data from a browser until a ping, and then until it is closed.
constexpr std::uint16_t ping_after = 2;
constexpr std::uint16_t close_after = 7;

// The data of a connection. libwebsockets stores them, and sets them to zero first.
struct FilePart {
    std::string* body;  // part of the answer not yet written
    std::size_t written;
};
struct BrowserPart {
    ClientId id;
    std::string* message;  // part received so far
    Admission admission;
};

// The peer's address; "" if unknown.
std::string address_of(int socket) {
    sockaddr_storage peer{};
    socklen_t size = sizeof peer;
    std::array<char, NI_MAXHOST> text{};
    if (getpeername(socket, reinterpret_cast<sockaddr*>(&peer), &size) != 0 ||
        getnameinfo(reinterpret_cast<const sockaddr*>(&peer), size, text.data(), text.size(), nullptr, 0,
                    NI_NUMERICHOST) != 0)
        return "";
    return text.data();
}

void let_stay(lws* socket) { lws_set_timer_usecs(socket, std::chrono::microseconds(Unadmitted::longest_stay).count()); }

std::string header(lws* socket, lws_token_indexes name) {
    std::array<char, longest_header> text{};
    const int length = lws_hdr_copy(socket, text.data(), static_cast<int>(text.size()), name);
    return length > 0 ? std::string(text.data(), static_cast<std::size_t>(length)) : "";
}

class WebSockets final : public Sockets {
public:
    explicit WebSockets(Site& site) : site_(site) {}
    ~WebSockets() override {
        if (thread_.joinable()) {
            Lock lock(mutex_);
            ends_ = true;
            lws_cancel_service(context_);
            has_ended_.wait_for(lock, farewell, [this] { return ended_; });
            at_once_ = true;
            lock.unlock();
            lws_cancel_service(context_);
            thread_.join();
        }
        if (context_ != nullptr) lws_context_destroy(context_);
    }
    WebSockets(const WebSockets&) = delete;
    WebSockets& operator=(const WebSockets&) = delete;

    std::string open(const SocketOptions& options);
    int port() const override { return port_; }
    void wake() override { lws_cancel_service(context_); }

private:
    static WebSockets& self(lws* socket) {
        return *static_cast<WebSockets*>(lws_context_user(lws_get_context(socket)));
    }
    static int file_event(lws* socket, lws_callback_reasons reason, void* user, void* in, std::size_t length);
    static int browser_event(lws* socket, lws_callback_reasons reason, void* user, void* in, std::size_t length);

    bool listen(const SocketOptions& options, int port);
    void come(lws* socket);
    void serve();
    Admission lets_in(lws* socket) const;
    int answer(lws* socket, FilePart& part, std::string_view path) const;
    static int write_body(lws* socket, FilePart& part);
    int receive(lws* socket, BrowserPart& part, std::string_view piece) const;
    int send(lws* socket, const BrowserPart& part);

    Site& site_;
    lws_context* context_ = nullptr;
    std::thread thread_;
    std::atomic<bool> ends_ = false;
    std::atomic<bool> at_once_ = false;  // end without waiting for browsers
    int browsers_ = 0;                   // used by the thread
    Unadmitted unadmitted_;              // used by the thread
    Mutex mutex_;                        // for ended_
    std::condition_variable has_ended_;
    bool ended_ = false;  // the thread
    int port_ = 0;
    ClientId last_id_ = 0;
    std::vector<unsigned char> buffer_{};  // the space that libwebsockets needs before a message, and the message

    const std::array<lws_protocols, 3> protocols_{
        {{.name = "file", .callback = file_event, .per_session_data_size = sizeof(FilePart)},
         {.name = "nezumi",
          .callback = browser_event,
          .per_session_data_size = sizeof(BrowserPart),
          .rx_buffer_size = portion,
          .tx_packet_size = portion},
         {}}};
    const lws_retry_bo_t patience_{.secs_since_valid_ping = ping_after, .secs_since_valid_hangup = close_after};
};

std::string WebSockets::open(const SocketOptions& options) {
    lws_set_log_level(0, nullptr);
    lws_context_creation_info info{};
    info.port = CONTEXT_PORT_NO_LISTEN;
    info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS;
    if (!options.certificate.empty()) info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
    info.user = this;
    info.gid = static_cast<gid_t>(-1);
    info.uid = static_cast<uid_t>(-1);
    info.fd_limit_per_thread = most_connections(options);
    info.timeout_secs = Unadmitted::longest_stay.count();
    info.retry_and_idle_policy = &patience_;
    context_ = lws_create_context(&info);
    if (context_ == nullptr) return std::string("browsers can't be served: ") + std::strerror(errno);

    int problem = 0;
    for (int tried = 0; tried < options.ports && port_ == 0; ++tried) {
        errno = 0;
        if (!listen(options, options.first_port + tried)) problem = errno;
    }
    if (port_ == 0) {
        std::string where = options.address + ":" + std::to_string(options.first_port);
        if (options.ports > 1) where += " to " + std::to_string(options.first_port + options.ports - 1);
        return "can't listen on " + where + ": " + std::strerror(problem != 0 ? problem : EADDRINUSE);
    }
    std::string failed;
    try {
        thread_ = start_thread([this] { serve(); });
    } catch (const std::system_error& none) {
        failed = std::string("can't start a thread for browsers: ") + none.what();
    }
    return failed;
}

bool WebSockets::listen(const SocketOptions& options, int port) {
    lws_context_creation_info info{};
    info.vhost_name = "nezumi";
    info.iface = options.address.c_str();
    info.port = port;
    info.protocols = protocols_.data();
    info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND;
    if (!options.certificate.empty()) {
        info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
        info.ssl_cert_filepath = options.certificate.c_str();
        info.ssl_private_key_filepath = options.key.c_str();
        info.alpn = "http/1.1";  // a WebSocket begins as HTTP/1.1, whose header Host has the requested name
    }
    info.keepalive_timeout = Unadmitted::longest_stay.count();
    info.timeout_secs = Unadmitted::longest_stay.count();
    info.retry_and_idle_policy = &patience_;
    lws_vhost* host = lws_create_vhost(context_, &info);
    if (host == nullptr) return false;
    port_ = lws_get_vhost_listen_port(host);
    return port_ > 0;
}

void WebSockets::serve() {
    while (!at_once_ && !(ends_ && browsers_ == 0)) {
        if (lws_service(context_, 0) < 0) break;
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    has_ended_.notify_all();
}

void WebSockets::come(lws* socket) {
    let_stay(socket);
    const auto* goes = unadmitted_.add(socket, address_of(lws_get_socket_fd(socket)));
    if (goes == nullptr) return;
    lws_set_timeout(static_cast<lws*>(const_cast<void*>(goes)), PENDING_TIMEOUT_USER_REASON_BASE, LWS_TO_KILL_ASYNC);
}

Admission WebSockets::lets_in(lws* socket) const {
    const std::string path = header(socket, WSI_TOKEN_GET_URI);
    const std::string host = header(socket, WSI_TOKEN_HOST);
    const std::string origin = header(socket, WSI_TOKEN_ORIGIN);
    const std::string protocols = header(socket, WSI_TOKEN_PROTOCOL);
    const std::string source = address_of(lws_get_socket_fd(socket));
    return site_.lets_in({.path = path, .host = host, .origin = origin, .protocols = protocols, .source = source});
}

int WebSockets::answer(lws* socket, FilePart& part, std::string_view path) const {
    let_stay(socket);
    const std::string host = header(socket, WSI_TOKEN_HOST);
    HttpReply reply{.status = 405, .body = "only GET\n"};
    if (lws_hdr_total_length(socket, WSI_TOKEN_GET_URI) > 0)
        reply = site_.reply_to({.path = path, .host = host, .origin = {}, .protocols = {}, .source = {}});

    std::array<unsigned char, LWS_PRE + 4096> head{};
    unsigned char* const begin = head.data() + LWS_PRE;
    unsigned char* const end = head.data() + head.size();
    unsigned char* at = begin;
    const unsigned status = static_cast<unsigned>(reply.status) | LWSAHH_FLAG_NO_SERVER_NAME;
    if (lws_add_http_common_headers(socket, status, reply.type.c_str(), reply.body.size(), &at, end) != 0) return 1;
    for (const auto& [name, value] : reply.headers) {
        const std::string with_colon = name + ":";
        if (lws_add_http_header_by_name(socket, reinterpret_cast<const unsigned char*>(with_colon.c_str()),
                                        reinterpret_cast<const unsigned char*>(value.c_str()),
                                        static_cast<int>(value.size()), &at, end) != 0)
            return 1;
    }
    if (lws_finalize_write_http_header(socket, begin, &at, end) != 0) return 1;
    if (reply.body.empty()) return lws_http_transaction_completed(socket);
    delete std::exchange(part.body, new std::string(std::move(reply.body)));
    part.written = 0;
    lws_callback_on_writable(socket);
    return 0;
}

int WebSockets::write_body(lws* socket, FilePart& part) {
    if (part.body == nullptr) return 0;
    const std::size_t count = std::min(portion, part.body->size() - part.written);
    const bool last = part.written + count == part.body->size();
    std::vector<unsigned char> piece(LWS_PRE + count);
    std::memcpy(piece.data() + LWS_PRE, part.body->data() + part.written, count);
    const int written = lws_write(socket, piece.data() + LWS_PRE, count, last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP);
    if (written < 0) return -1;
    let_stay(socket);
    part.written += count;
    if (!last) {
        lws_callback_on_writable(socket);
        return 0;
    }
    delete std::exchange(part.body, nullptr);
    return lws_http_transaction_completed(socket) != 0 ? -1 : 0;
}

int WebSockets::receive(lws* socket, BrowserPart& part, std::string_view piece) const {
    if (part.message == nullptr) part.message = new std::string;
    if (part.message->size() + piece.size() > longest_message) {
        lws_close_reason(socket, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, nullptr, 0);
        return -1;
    }
    part.message->append(piece);
    if (lws_is_final_fragment(socket) == 0 || lws_remaining_packet_payload(socket) != 0) return 0;
    const std::unique_ptr<std::string> message(std::exchange(part.message, nullptr));
    if (site_.received(part.id, *message)) return 0;
    lws_close_reason(socket, LWS_CLOSE_STATUS_POLICY_VIOLATION, nullptr, 0);
    return -1;
}

int WebSockets::send(lws* socket, const BrowserPart& part) {
    const auto message = site_.next(part.id);
    if (!message) return 0;
    if (message->closes) {
        lws_close_reason(socket, LWS_CLOSE_STATUS_POLICY_VIOLATION, nullptr, 0);
        return -1;
    }
    buffer_.resize(LWS_PRE + message->bytes.size());
    std::memcpy(buffer_.data() + LWS_PRE, message->bytes.data(), message->bytes.size());
    const int written = lws_write(socket, buffer_.data() + LWS_PRE, message->bytes.size(),
                                  message->binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT);
    if (written < 0) return -1;
    lws_callback_on_writable(socket);  // until all is written
    return 0;
}

int WebSockets::file_event(lws* socket, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
    auto* part = static_cast<FilePart*>(user);
    switch (reason) {
        case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
            return leaves_free(static_cast<int>(reinterpret_cast<std::intptr_t>(in)), for_files_and_consoles) ? 0 : 1;
        case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED: self(socket).come(socket); return 0;
        case LWS_CALLBACK_TIMER: return -1;  // open for too long
        case LWS_CALLBACK_WSI_DESTROY: self(socket).unadmitted_.remove(socket); return 0;
        case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE: {
            if (in == nullptr || std::strcmp(static_cast<const char*>(in), "websocket") != 0) return -1;
            const Admission admission = self(socket).lets_in(socket);
            if (admission.refused == 0) return 0;
            return lws_return_http_status(socket, static_cast<unsigned>(admission.refused), nullptr) < 0 ? -1 : 1;
        }
        case LWS_CALLBACK_HTTP: return self(socket).answer(socket, *part, {static_cast<const char*>(in), length});
        case LWS_CALLBACK_HTTP_WRITEABLE: return write_body(socket, *part);
        case LWS_CALLBACK_CLOSED_HTTP:
        case LWS_CALLBACK_HTTP_DROP_PROTOCOL:
            if (part != nullptr) delete std::exchange(part->body, nullptr);
            return 0;
        case LWS_CALLBACK_ESTABLISHED:
        case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION: return -1;  // refuses a WebSocket with the protocol for files
        default: return 0;
    }
}

int WebSockets::browser_event(lws* socket, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
    auto* part = static_cast<BrowserPart*>(user);
    switch (reason) {
        case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION: {
            const Admission admission = self(socket).lets_in(socket);
            if (part != nullptr) part->admission = admission;
            return admission.refused != 0 || part == nullptr ? -1 : 0;
        }
        case LWS_CALLBACK_ESTABLISHED:
            self(socket).unadmitted_.remove(socket);
            lws_set_timer_usecs(socket, LWS_SET_TIMER_USEC_CANCEL);
            part->id = ++self(socket).last_id_;
            ++self(socket).browsers_;
            self(socket).site_.opened(part->id, part->admission);
            lws_callback_on_writable(socket);
            return 0;
        case LWS_CALLBACK_RECEIVE: return self(socket).receive(socket, *part, {static_cast<const char*>(in), length});
        case LWS_CALLBACK_SERVER_WRITEABLE: return self(socket).send(socket, *part);
        case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
            lws_callback_on_writable_all_protocol(lws_get_context(socket), lws_get_protocol(socket));
            return 0;
        case LWS_CALLBACK_CLOSED:
            if (part == nullptr || part->id == 0) return 0;
            delete std::exchange(part->message, nullptr);
            --self(socket).browsers_;
            self(socket).site_.closed(std::exchange(part->id, 0));
            return 0;
        default: return 0;
    }
}

}  // namespace
}  // namespace nezumi::web

extern "C" __attribute__((visibility("default"))) nezumi::web::Sockets* nezumi_open_sockets(
    const nezumi::web::SocketOptions& options, nezumi::web::Site& site, std::string& problem) {
    auto sockets = std::make_unique<nezumi::web::WebSockets>(site);
    problem = sockets->open(options);
    return problem.empty() ? sockets.release() : nullptr;
}
