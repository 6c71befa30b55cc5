// A path is split and joined again from valid names only, so no other path reaches the disk.
#include "bindings/web/static_files.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>

#include "engine/base/list.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::web {
namespace {

constexpr std::array<std::string_view, 3> libraries{"three", "codemirror", "dygraphs"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> types{{{".html", "text/html; charset=utf-8"},
                                                                              {".js", "text/javascript; charset=utf-8"},
                                                                              {".css", "text/css; charset=utf-8"},
                                                                              {".json", "application/json"},
                                                                              {".svg", "image/svg+xml"},
                                                                              {".png", "image/png"},
                                                                              {".ico", "image/x-icon"},
                                                                              {".woff2", "font/woff2"}}};

constexpr const char* policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; base-uri "
    "'none'; form-action 'none'; frame-ancestors 'none'";

bool is_name(std::string_view part) {
    const auto allowed = [](char each) {
        return (each >= 'a' && each <= 'z') || (each >= 'A' && each <= 'Z') || (each >= '0' && each <= '9') ||
               each == '_' || each == '-' || each == '.';
    };
    return !part.empty() && part.front() != '.' && part.size() <= 64 && std::all_of(part.begin(), part.end(), allowed);
}

HttpReply with_headers(HttpReply reply, bool keeps) {
    reply.headers = {{"content-security-policy", policy},
                     {"x-content-type-options", "nosniff"},
                     {"referrer-policy", "no-referrer"},
                     {"cross-origin-opener-policy", "same-origin"},
                     {"cross-origin-resource-policy", "same-origin"},
                     {"cache-control", keeps ? "max-age=3600" : "no-store"}};
    return reply;
}

HttpReply not_found() { return with_headers({.status = 404, .body = "there is no such file\n"}, false); }

}  // namespace

StaticFiles::StaticFiles(const std::filesystem::path& page) : StaticFiles(page, "/usr/share/javascript") {
    std::error_code none;
    const std::filesystem::path own = (page / "../../../javascript").lexically_normal();
    if (std::filesystem::is_directory(own, none)) libraries_ = own;
}

HttpReply StaticFiles::get(std::string_view path) const {
    if (path.empty() || path.front() != '/' || path.size() > 256) return not_found();
    path.remove_prefix(1);
    std::filesystem::path file = page_;
    bool is_library = false;
    if (path.starts_with("lib/")) {
        path.remove_prefix(4);
        const std::string_view name = path.substr(0, path.find('/'));
        if (!contains(libraries, name)) return not_found();
        file = libraries_;
        is_library = true;
    }
    if (path.empty()) path = "index.html";
    for (;;) {
        const auto slash = path.find('/');
        const std::string_view part = path.substr(0, slash);
        if (!is_name(part)) return not_found();
        file /= part;
        if (slash == std::string_view::npos) break;
        path.remove_prefix(slash + 1);
    }
    const std::string ending = file.extension().string();
    const auto* const type =
        std::find_if(types.begin(), types.end(), [&](const auto& each) { return each.first == ending; });
    std::error_code problem;
    if (type == types.end() || !std::filesystem::is_regular_file(file, problem) ||
        std::filesystem::file_size(file, problem) > longest_file || problem)
        return not_found();
    auto body = read_whole(file, file.string(), longest_file);
    if (!body) return not_found();
    return with_headers({.status = 200, .type = std::string(type->second), .body = std::move(*body)}, is_library);
}

}  // namespace nezumi::web
