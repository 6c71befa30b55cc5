// The page's files and its JavaScript libraries from Debian: everything served without a token.
#pragma once

#include <filesystem>
#include <string_view>

#include "bindings/web/site.hpp"

namespace nezumi::web {

class StaticFiles {
public:
    /// `page` is the folder of the page's own files, `libraries` that of the scripts.
    StaticFiles(std::filesystem::path page, std::filesystem::path libraries)
        : page_(std::move(page)), libraries_(std::move(libraries)) {}
    /// Uses the scripts that Debian's packages install, or those that nezumi brings itself (.ci/portable).
    explicit StaticFiles(const std::filesystem::path& page);

    /// Returns the file at "/", "/main.js", "/lib/three/three.module.js". Folders are not listed. Names that begin with
    /// a dot or lead out of the folders are not found.
    HttpReply get(std::string_view path) const;

    /// [bytes] Longer files are not served.
    static constexpr std::size_t longest_file = std::size_t{16} << 20;

private:
    std::filesystem::path page_;
    std::filesystem::path libraries_;
};

}  // namespace nezumi::web
