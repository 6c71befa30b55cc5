// Reads only files of this user in a folder of this user, and takes only two addresses from each file.
#include "bindings/web/page_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <tuple>

#include "engine/base/descriptor.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::web {
namespace {

constexpr std::string_view suffix = ".html";
constexpr std::string_view before_url = "content=\"0; url=", after_url = "\"";
constexpr std::string_view before_view = "<!-- view: ", after_view = " -->";

std::string plain(std::string_view name) {
    std::string text;
    for (const char each : name.substr(0, 40)) {
        const bool fits = std::isalnum(static_cast<unsigned char>(each)) != 0 || each == '_';
        text += fits ? each : '_';
    }
    return text.empty() ? "system" : text;
}

// Parses NAME-PID.html; nothing for any other file name.
std::optional<RunningPage> parse_name(std::string_view file) {
    if (!file.ends_with(suffix)) return std::nullopt;
    file.remove_suffix(suffix.size());
    const auto dash = file.rfind('-');
    if (dash == std::string_view::npos || dash == 0) return std::nullopt;
    RunningPage page{.name = std::string(file.substr(0, dash))};
    const std::string_view number = file.substr(dash + 1);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), page.process);
    if (error != std::errc{} || end != number.data() + number.size() || page.process <= 0) return std::nullopt;
    return page;
}

// The page address between two texts, or "".
std::string address_between(std::string_view text, std::string_view before, std::string_view after) {
    const auto begin = text.find(before);
    if (begin == std::string_view::npos) return "";
    text.remove_prefix(begin + before.size());
    const std::string_view address = text.substr(0, text.find(after));
    const bool is_address = address.starts_with("http://") || address.starts_with("https://");
    const bool is_clean = std::all_of(address.begin(), address.end(), [](char each) {
        return std::isalnum(static_cast<unsigned char>(each)) != 0 || std::strchr(":/.#-[]", each) != nullptr;
    });
    return is_address && is_clean && address.size() < 200 ? std::string(address) : "";
}

bool runs(pid_t process) { return kill(process, 0) == 0 || errno == EPERM; }

}  // namespace

Expected<PageEntry> PageEntry::open(const RunningPage& page, const std::filesystem::path& folder) {
    const std::string text = fmt::format(
        "<!doctype html>\n<meta charset=\"utf-8\">\n<title>nezumi</title>\n<meta http-equiv=\"refresh\" {}{}{}>\n<a "
        "href=\"{}\">{}</a>\n{}{}{}\n",
        before_url, page.url, after_url, page.url, plain(page.name), before_view, page.view_url, after_view);
    const std::filesystem::path file = folder / fmt::format("{}-{}{}", plain(page.name), page.process, suffix);
    unlink(file.c_str());
    const Descriptor opened(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (!opened || ::write(opened.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
        return failure(file.string() + " can't be written: " + std::strerror(errno));
    return PageEntry(file);
}

PageEntry::~PageEntry() {
    if (!file_.empty()) unlink(file_.c_str());
}

std::vector<RunningPage> running_pages(const std::filesystem::path& folder) {
    std::vector<RunningPage> pages;
    struct stat status {};
    if (lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
        (status.st_mode & 077) != 0)
        return pages;
    std::error_code problem;
    for (std::filesystem::directory_iterator entry(folder, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        auto page = parse_name(entry->path().filename().string());
        if (!page) continue;
        if (!runs(page->process)) {
            unlink(entry->path().c_str());
            continue;
        }
        const auto text = read_whole(entry->path(), entry->path().string(), 4096);
        if (!text) continue;
        page->url = address_between(*text, before_url, after_url);
        page->view_url = address_between(*text, before_view, after_view);
        if (!page->url.empty() && !page->view_url.empty()) pages.push_back(std::move(*page));
    }
    std::sort(pages.begin(), pages.end(), [](const RunningPage& a, const RunningPage& b) {
        return std::tie(a.name, a.process) < std::tie(b.name, b.process);
    });
    return pages;
}

}  // namespace nezumi::web
