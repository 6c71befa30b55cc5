// Who may talk to a running system from a browser: two tokens, and what headers must say.
#pragma once

#include <string>
#include <string_view>

#include "bindings/web/site.hpp"

namespace nezumi::web {

/// 128 random bits as 32 hexadecimal digits; "" where the kernel gives none.
std::string make_token();

/// Whether two texts are equal; none is equal to an empty one. How long that takes tells nothing about where they
/// differ.
bool is_same_secret(std::string_view left, std::string_view right);

class AccessControl {
public:
    /// `scheme`: "http", or "https" where TLS is spoken. `address`: another name than the loopback's that is ours.
    explicit AccessControl(std::string scheme = "http", std::string address = "")
        : scheme_(std::move(scheme)), address_(std::move(address)) {}

    /// For those who may act, and for those who may only look. Empty, they let nobody in.
    const std::string& token() const { return token_; }
    const std::string& view_token() const { return view_token_; }

    /// A Host is ours when it names this computer's loopback, whatever the port (a tunnel has one of its own), or the
    /// address that is listened on. Whoever has led a browser here by another name is refused.
    bool is_own_host(std::string_view host) const;
    /// What wants to be a WebSocket must ask for /ws of our host, come from a page of exactly that host, and offer the
    /// protocols "nezumi" and "token.TOKEN".
    Admission check(const HttpRequest& request) const;

private:
    std::string scheme_;
    std::string address_;
    std::string token_ = make_token();
    std::string view_token_ = make_token();
};

}  // namespace nezumi::web
