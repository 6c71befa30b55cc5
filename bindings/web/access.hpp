// Access of browsers to a running system: two tokens, and checks of request headers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bindings/web/site.hpp"

namespace nezumi::web {

constexpr int forbidden = 403;    ///< HTTP status: the request is refused
constexpr int unavailable = 503;  ///< HTTP status: the request can't be served now

/// Returns 128 random bits as 32 hexadecimal digits; "" if the kernel gives none.
std::string make_token();

/// True if two texts are equal and not empty. The time taken does not show where they differ.
bool is_same_secret(std::string_view left, std::string_view right);

class AccessControl {
public:
    /// `scheme`: "http", or "https" with TLS. `address`: the server's own address, "" for the loopback.
    explicit AccessControl(std::string scheme = "http", std::string address = "")
        : scheme_(std::move(scheme)), address_(std::move(address)) {}

    /// Makes an object that admits no browser: here another program decides who is admitted.
    static AccessControl closed() {
        AccessControl none;
        none.token_.clear();
        none.view_token_.clear();
        return none;
    }

    /// The tokens for full access and for viewing only. An empty token admits no browser.
    const std::string& token() const { return token_; }
    const std::string& view_token() const { return view_token_; }

    /// True if a Host header names this computer's loopback, with any port (a tunnel has its own), or the address that
    /// the server listens on. Other names are refused, because a page of another site may have sent the request.
    bool is_own_host(std::string_view host) const;
    /// The token in a request for a WebSocket, in the form that `check` accepts; nothing for any other request.
    std::optional<std::string_view> offered_token(const HttpRequest& request) const;
    /// A request for a WebSocket must ask for /ws of our host, come from a page of exactly that host, and offer the
    /// protocols "nezumi" and "token.TOKEN".
    Admission check(const HttpRequest& request) const;

private:
    std::string scheme_;
    std::string address_;
    std::string token_ = make_token();
    std::string view_token_ = make_token();
};

}  // namespace nezumi::web
