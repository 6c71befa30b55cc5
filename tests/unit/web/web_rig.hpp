// A live system served to browsers, in the test's own thread.
#pragma once

#include <catch2/catch.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bindings/web/web_server.hpp"
#include "engine/vision/checked_image.hpp"
#include "tests/unit/console/session_rig.hpp"
#include "tests/unit/web/raw_browser.hpp"

namespace nezumi {

struct WebRig : SessionRig {
    using Json = nlohmann::json;

    explicit WebRig(const std::string& system = counter_system,
                    const std::map<std::string, std::string>& behaviors = {{"counter", counter_behavior}},
                    web::EditorOptions editor = {})
        : SessionRig(system, behaviors) {
        folder.write("page/index.html", "<!doctype html>the page");
        folder.write("page/main.js", "export {};");
        folder.write("page/.secret.js", "secret");
        folder.write("secret.js", "secret");
        web::WebOptions options{
            .page = file.parent_path() / "page", .version = "1.2.3", .encode = to_jpeg, .editor = std::move(editor)};
        options.sockets.first_port = 0;
        auto opened = web::WebServer::open(*live, *this, consoles, options);
        if (!opened) FAIL(opened.error().message);
        server = std::move(*opened);
        const std::string url = server->url(), view_url = server->view_url();
        port = std::atoi(url.c_str() + url.rfind(':') + 1);
        token = url.substr(url.find('#') + 1);
        view_token = view_url.substr(view_url.find('#') + 1);
    }

    void serve() {
        consoles.serve(std::chrono::steady_clock::now());
        server->serve(std::chrono::steady_clock::now() + std::chrono::milliseconds(2), 0.001);
        if (!is_paused()) turn();
    }
    RawBrowser connect(int buffer = 0) {
        return RawBrowser(
            port, [this] { serve(); }, buffer);
    }
    std::string host() const { return "127.0.0.1:" + std::to_string(port); }

    /// The lines that request a WebSocket; "" leaves a header out.
    static std::string upgrade(const std::string& host, const std::string& origin, const std::string& protocols,
                               const std::string& path = "/ws") {
        std::string lines = "GET " + path +
                            " HTTP/1.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
        if (!host.empty()) lines += "Host: " + host + "\r\n";
        if (!origin.empty()) lines += "Origin: " + origin + "\r\n";
        if (!protocols.empty()) lines += "Sec-WebSocket-Protocol: " + protocols + "\r\n";
        return lines;
    }
    /// Opens a browser that is admitted.
    RawBrowser open(const std::string& with_token, int buffer = 0) {
        RawBrowser browser = connect(buffer);
        const std::string head = browser.ask(upgrade(host(), "http://" + host(), "nezumi, token." + with_token));
        INFO(head);
        REQUIRE(head.rfind("HTTP/1.1 101", 0) == 0);
        return browser;
    }
    RawBrowser open() { return open(token); }
    /// The answer to a message with this id.
    static Json answer(RawBrowser& browser, const Json& message) {
        REQUIRE(browser.send_frame(message.dump()));
        const std::string text = browser.next_text("\"is\":\"answer\",\"id\":" + message.at("id").dump() + ",");
        INFO(message.dump());
        REQUIRE(!text.empty());
        return Json::parse(text);
    }

    ConsoleServer consoles{*live, *this};
    std::unique_ptr<web::WebServer> server;
    int port = 0;
    std::string token, view_token;
};

}  // namespace nezumi
