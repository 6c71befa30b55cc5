// The files of the page, and the libraries of it that Debian has: all that is given without a token.
#pragma once

#include <filesystem>
#include <string_view>

#include "bindings/web/site.hpp"

namespace nezumi::web {

class StaticFiles {
public:
    /// `page` is the folder of the page's own files, `libraries` that of Debian's scripts; `socket` is what the page
    /// may connect to, as a source of a content security policy.
    explicit StaticFiles(std::filesystem::path page, std::filesystem::path libraries = "/usr/share/javascript")
        : page_(std::move(page)), libraries_(std::move(libraries)) {}

    /// The file at "/", "/main.js", "/lib/three/three.module.js". Folders have no lists, a name that begins with a dot
    /// or leads out of the folders is not found.
    HttpReply get(std::string_view path) const;

    /// No file is longer [bytes].
    static constexpr std::size_t longest_file = std::size_t{16} << 20;

private:
    std::filesystem::path page_;
    std::filesystem::path libraries_;
};

}  // namespace nezumi::web
