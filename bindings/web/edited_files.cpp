// Reads and writes a project's files for browsers. Each folder of a path is opened from the folder before, without
// following links, so no path leads out of the project.
#include "bindings/web/edited_files.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>

#include "engine/base/find_files.hpp"
#include "engine/base/staged_file.hpp"
#include "engine/base/utf8.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/values/walk.hpp"

namespace nezumi::web {
namespace {

constexpr std::array<std::string_view, 3> endings{".lua", ".msg", ".idl"};
constexpr std::size_t longest_name = 400;
constexpr const char* versions_folder = ".nezumi/versions/";

std::string why(int problem) { return problem == ELOOP ? "is a link, which is not followed" : std::strerror(problem); }

std::string last_part(const std::string& path) { return path.substr(path.rfind('/') + 1); }

// A path to this open folder, valid even after the folder was renamed or replaced.
std::string name_of(const Descriptor& folder) {
    std::filesystem::path name = "/proc/self/fd/" + std::to_string(folder.get());
#if defined(__EMSCRIPTEN__)  // files are found by whole names only
    std::error_code none;
    name = std::filesystem::read_symlink(name, none);
#endif
    return name.string();
}

// The text of a file in an open folder; nothing if it does not exist.
Expected<std::optional<std::string>> read_in(const Descriptor& folder, const std::string& name, mode_t* mode) {
    const Descriptor file(openat(folder.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!file && errno == ENOENT) return std::optional<std::string>();
    if (!file) return failure(why(errno));
    struct stat status {};
    if (fstat(file.get(), &status) != 0) return failure(why(errno));
    if (!S_ISREG(status.st_mode)) return failure("is not a file");
    if (mode != nullptr) *mode = status.st_mode & 0777;
    std::string text;
    std::array<char, 65536> buffer{};
    for (;;) {
        const ssize_t count = ::read(file.get(), buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return failure(why(errno));
        if (count == 0) break;
        text.append(buffer.data(), static_cast<std::size_t>(count));
        if (text.size() > EditedFiles::longest_text)
            return failure(
                fmt::format("has more than {} KB: edit it with another program", EditedFiles::longest_text >> 10));
    }
    if (!is_utf8(text)) return failure("is not UTF-8 text: edit it with another program");
    return std::optional<std::string>(std::move(text));
}

// Writes a new file to the disk, and then replaces the file in an open folder by it, unless `may` returns false at that
// moment. Returns 0, or an errno: then the file is unchanged.
int write_in(const Descriptor& folder, const std::string& name, std::string_view text, mode_t mode,
             const std::function<bool()>& may = {}) {
    StagedFile staged(name_of(folder) + "/" + name, mode);
    if (staged.descriptor() < 0) return staged.problem();
    if (const int problem = write_all(staged.descriptor(), text); problem != 0) return problem;
    if (fsync(staged.descriptor()) != 0) return errno;
    if (may && !may()) return ESTALE;
    if (const int problem = staged.commit(); problem != 0) return problem;
    fsync(folder.get());  // writes the new name to the disk; the text is there already
    return 0;
}

// The numbers of the versions in an open folder, sorted.
std::vector<int> numbers_in(const Descriptor& folder) {
    std::vector<int> numbers;
    const int copy = openat(folder.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (copy < 0) return numbers;
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(fdopendir(copy), closedir);
    if (entries == nullptr) {
        ::close(copy);
        return numbers;
    }
    while (const dirent* entry = readdir(entries.get())) {
        const std::string_view name = entry->d_name;
        int number = 0;
        const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), number);
        if (problem == std::errc() && end == name.data() + name.size() && number > 0) numbers.push_back(number);
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

}  // namespace

std::string mark_of(std::string_view text) { return fmt::format("{:016x}", mix(0, text)); }

Expected<void> EditedFiles::check_name(std::string_view name) {
    const auto refuse = [&](std::string_view reason) {
        return failure(fmt::format("'{}' {}", visible_message(std::string(name.substr(0, 100))), reason));
    };
    if (name.empty() || name.size() > longest_name) return failure("a file needs a name of at most 400 bytes");
    const auto is_control = [](unsigned char each) { return each < 0x20 || each == 0x7f || each == '\\'; };
    if (!is_utf8(name) || std::any_of(name.begin(), name.end(), is_control))
        return refuse("is not a file name: it contains a control character, a \\, or bytes that are not UTF-8");
    for (std::string_view rest = name;;) {
        const auto slash = rest.find('/');
        const std::string_view part = rest.substr(0, slash);
        if (part.empty() || part.front() == '.')
            return refuse("is not a file name in the project: no part may be empty or begin with a dot");
        if (part.size() > 200) return refuse("has a part of more than 200 bytes");
        if (slash == std::string_view::npos) break;
        rest.remove_prefix(slash + 1);
    }
    if (std::none_of(endings.begin(), endings.end(), [&](std::string_view each) { return name.ends_with(each); }))
        return refuse(fmt::format("can't be edited here: only files that end in {} can", fmt::join(endings, ", ")));
    return {};
}

std::vector<std::string> EditedFiles::names() const {
    std::vector<std::string> names;
    for (const std::string_view ending : endings) {
        for (const std::filesystem::path& file : find_files(folder_, ending).files) {
            std::string name = file.lexically_relative(folder_).generic_string();
            std::error_code problem;
            if (check_name(name) && !std::filesystem::is_symlink(file, problem)) names.push_back(std::move(name));
        }
    }
    std::sort(names.begin(), names.end());
    if (names.size() > most_files) names.resize(most_files);
    return names;
}

// Opens the folder of the file `path`, which may be in our hidden folder of versions. With `makes`, makes missing
// folders.
Expected<Descriptor> EditedFiles::open_folder_of(const std::string& path, bool makes) const {
    Descriptor folder(open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!folder) return failure(why(errno));
    std::string_view rest = path;
    for (auto slash = rest.find('/'); slash != std::string_view::npos; slash = rest.find('/')) {
        const std::string part(rest.substr(0, slash));
        rest.remove_prefix(slash + 1);
        if (makes && mkdirat(folder.get(), part.c_str(), 0777) != 0 && errno != EEXIST) return failure(why(errno));
        Descriptor next(openat(folder.get(), part.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
        // ENOTDIR: the part is a file, or a link, for which the kernel gives the same error.
        if (!next && errno == ENOTDIR)
            return failure(fmt::format("'{}' is not a folder, or is a link, which is not followed", part));
        if (!next) return failure(why(errno));
        folder = std::move(next);
    }
    return folder;
}

Expected<EditedText> EditedFiles::read(const std::string& name) const {
    if (auto ok = check_name(name); !ok) return Unexpected(ok.error());
    const auto folder = open_folder_of(name, false);
    if (!folder) return failure(folder.error().message, {name});
    auto text = read_in(*folder, last_part(name), nullptr);
    if (!text) return failure(text.error().message, {name});
    if (!*text) return failure("there is no such file", {name});
    std::string mark = mark_of(**text);
    return EditedText{std::move(**text), std::move(mark)};
}

Expected<SavedText> EditedFiles::write(const std::string& name, const std::string& text,
                                       const std::string& before) const {
    if (auto ok = check_name(name); !ok) return Unexpected(ok.error());
    if (text.size() > longest_text) return failure(fmt::format("more than {} KB", longest_text >> 10), {name});
    const auto folder = open_folder_of(name, before.empty());
    if (!folder) return failure(folder.error().message + ": nothing was saved", {name});
    mode_t mode = 0666;
    auto present = read_in(*folder, last_part(name), &mode);
    if (!present) return failure(present.error().message + ": nothing was saved", {name});
    const auto mark = [](const std::optional<std::string>& of) { return of ? mark_of(*of) : ""; };
    const auto refuse = [&] {
        SavedText refused{.is_refused = true};
        if (*present) refused.present = EditedText{**present, mark(*present)};
        return refused;
    };
    if (mark(*present) != before) return refuse();
    SavedText saved;
    if (*present) saved.note = keep(name, **present);
    const auto is_same = [&] {  // the file may have changed while the text was written to the disk
        present = read_in(*folder, last_part(name), nullptr);
        return present && mark(*present) == before;
    };
    const int problem = write_in(*folder, last_part(name), text, mode, is_same);
    if (problem == ESTALE && present) return refuse();
    if (problem != 0)
        return failure(fmt::format("can't be written: {}: the file is unchanged", std::strerror(problem)), {name});
    if (std::string note = keep(name, text); saved.note.empty()) saved.note = std::move(note);
    saved.mark = mark_of(text);
    return saved;
}

// Stores a text as the newest version of the file, unless it is the newest version already. Returns "", or why it
// failed.
std::string EditedFiles::keep(const std::string& name, const std::string& text) const {
    const std::string path = versions_folder + name + "/";
    const auto folder = open_folder_of(path, true);
    if (!folder) return "this version is not kept: " + folder.error().message;
    std::vector<int> numbers = numbers_in(*folder);
    if (!numbers.empty()) {
        const auto last = read_in(*folder, std::to_string(numbers.back()), nullptr);
        if (last && *last == text) return "";
    } else if (const auto all = open_folder_of(versions_folder, false)) {
        write_in(*all, ".gitignore", "*\n", 0666);  // so that git ignores the versions
    }
    const int number = numbers.empty() ? 1 : numbers.back() + 1;
    if (const int problem = write_in(*folder, std::to_string(number), text, 0666); problem != 0)
        return fmt::format("this version is not kept: {}", std::strerror(problem));
    numbers.push_back(number);
    for (std::size_t i = 0; i + most_versions < numbers.size(); ++i)
        unlinkat(folder->get(), std::to_string(numbers[i]).c_str(), 0);
    return "";
}

std::vector<KeptVersion> EditedFiles::versions(const std::string& name) const {
    std::vector<KeptVersion> versions;
    if (!check_name(name)) return versions;
    const auto folder = open_folder_of(versions_folder + name + "/", false);
    if (!folder) return versions;
    const std::vector<int> numbers = numbers_in(*folder);
    for (auto number = numbers.rbegin(); number != numbers.rend(); ++number) {
        struct stat status {};
        if (fstatat(folder->get(), std::to_string(*number).c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 ||
            !S_ISREG(status.st_mode))
            continue;
        versions.push_back({*number, status.st_mtime, static_cast<std::size_t>(status.st_size)});
    }
    return versions;
}

Expected<std::string> EditedFiles::version(const std::string& name, int number) const {
    if (auto ok = check_name(name); !ok) return Unexpected(ok.error());
    const auto folder = open_folder_of(versions_folder + name + "/", false);
    const auto text = folder ? read_in(*folder, std::to_string(number), nullptr)
                             : Expected<std::optional<std::string>>(std::optional<std::string>());
    if (!text) return failure(text.error().message, {name});
    if (!*text) return failure(fmt::format("version {} is no longer available", number), {name});
    return **text;
}

}  // namespace nezumi::web
