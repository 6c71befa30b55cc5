// Files served without a token: the page's and Debian's libraries, no other file of the disk.
#include "bindings/web/static_files.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;
using namespace nezumi::web;

TEST_CASE("the page's files come with headers that keep others out", "[web][files]") {
    WebRig rig;
    RawBrowser browser = rig.connect();
    const std::string head = browser.ask("GET / HTTP/1.1\r\nHost: " + rig.host() + "\r\n");
    INFO(head);
    CHECK(head.rfind("HTTP/1.1 200", 0) == 0);
    CHECK(head.find("content-security-policy: default-src 'none'; script-src 'self';") != std::string::npos);
    CHECK(head.find("x-content-type-options: nosniff") != std::string::npos);
    CHECK(head.find("referrer-policy: no-referrer") != std::string::npos);
    CHECK(head.find("cache-control: no-store") != std::string::npos);
    CHECK(head.find("text/html") != std::string::npos);
    CHECK(browser.body(23) == "<!doctype html>the page");
}

TEST_CASE("a path that leads out of the folders is not found", "[web][files]") {
    WebRig rig;
    for (const std::string path :
         {"/../secret.js", "/..%2fsecret.js", "/%2e%2e/secret.js", "/x/../../secret.js", "//secret.js", "/.secret.js",
          "/lib/../../../../etc/passwd", "/lib/three/../../../../etc/passwd", "/lib/jquery/jquery.js", "/etc/passwd",
          "/index.html%00.js", "/page", "/lib", "/lib/", "/lib/three", "/main.js/", "/main.lua", "/\\..\\secret.js"}) {
        INFO(path);
        RawBrowser browser = rig.connect();
        const std::string head = browser.ask("GET " + path + " HTTP/1.1\r\nHost: " + rig.host() + "\r\n");
        CHECK(head.rfind("HTTP/1.1 200", 0) != 0);
        CHECK(browser.body(6) != "secret");
    }
    // The same without the sockets' own refusals.
    const StaticFiles files(rig.file.parent_path() / "page");
    CHECK(files.get("/main.js").status == 200);
    for (const std::string_view path : {"/../secret.js", "", "main.js", "/./main.js", "/lib/three/../../x.js"})
        CHECK(files.get(path).status == 404);
    CHECK(files.get(std::string("/index.html\0.js", 15)).status == 404);
    CHECK(files.get("/" + std::string(300, 'a') + ".js").status == 404);
}

TEST_CASE("only GET is answered with a file", "[web][files]") {
    WebRig rig;
    for (const std::string method : {"POST", "PUT", "DELETE", "OPTIONS"}) {
        INFO(method);
        RawBrowser browser = rig.connect();
        const std::string head =
            browser.ask(method + " / HTTP/1.1\r\nHost: " + rig.host() + "\r\nContent-Length: 0\r\n");
        CHECK(head.rfind("HTTP/1.1 200", 0) != 0);
    }
}
