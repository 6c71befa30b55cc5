// Data are on the disk before the next step uses them: syncfs before each of the two renames.
#include "bindings/push/pushed_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>

#include "bindings/push/content_hash.hpp"
#include "bindings/push/finishing.hpp"
#include "engine/base/descriptor.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::push {
namespace {

namespace fs = std::filesystem;

constexpr mode_t folder_mode = 0777, file_mode = 0666, program_mode = 0777;  // minus umask

Unexpected problem_with(const std::string& name, int code) {
    return failure(fmt::format("can't be written: {}", std::strerror(code)), {.file = name});
}

bool lock(int folder, double longest_wait) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(longest_wait);
    while (flock(folder, LOCK_EX | LOCK_NB) != 0) {
        if (errno != EWOULDBLOCK || std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
}

// The path of a list, relative to the pushed folder.
std::string own_name(std::string_view name) { return fmt::format("{}/{}", own_folder, name); }

Expected<FileList> read_list(const OpenFolder& folder, const std::string& name) {
    std::string text;
    const int problem = folder.read(name, [&](std::string_view bytes) {
        text += bytes;
        return 0;
    });
    if (problem != 0) return failure(std::string("can't be read: ") + std::strerror(problem), {.file = name});
    auto list = read_file_list(text);
    if (!list) return failure(list.error().message, {.file = name});
    return list;
}

int write_synced(int folder, const char* name, std::string_view text) {
    const Descriptor file(openat(folder, name, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, file_mode));
    if (!file) return errno;
    if (const int problem = write_all(file.get(), text); problem != 0) return problem;
    return fsync(file.get()) == 0 ? 0 : errno;
}

// Writes a complete list to the disk, or nothing. No list with this name may exist: it would be removed after an error.
int make_list(int own, const std::string& name, const FileList& list) {
    const std::string fresh = name + ".new";
    int problem = write_synced(own, fresh.c_str(), to_text(list));
    if (problem == 0 && renameat(own, fresh.c_str(), own, name.c_str()) != 0) problem = errno;
    if (problem == 0 && fsync(own) != 0) problem = errno;
    if (problem != 0) {
        unlinkat(own, fresh.c_str(), 0);
        unlinkat(own, name.c_str(), 0);
    }
    return problem;
}

}  // namespace

Expected<FileList> pushed_list(const OpenFolder& folder) {
    const std::string name = own_name("list");
    return folder.find(name) ? read_list(folder, name) : FileList{};
}

bool was_pushed_to(const OpenFolder& folder) { return folder.find(own_name("list")) || is_committed_to(folder); }

bool is_committed_to(const OpenFolder& folder) { return folder.find(own_name("next")).has_value(); }

Expected<PushedFolder> PushedFolder::open(const fs::path& folder, double longest_wait) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) return problem_with(folder.string(), problem.value());
    auto files = OpenFolder::open(folder);
    if (!files) return Unexpected(files.error());
    const fs::path own_path = folder / own_folder;
    if (mkdirat(files->descriptor(), own_path.filename().c_str(), folder_mode) != 0 && errno != EEXIST)
        return problem_with(own_path.string(), errno);
    auto own = files->below(own_path.filename());
    if (!own) return Unexpected(own.error());
    if (!lock(own->descriptor(), longest_wait))
        return failure("another push to this folder is running: wait until it ends", {.file = folder.string()});
    if (mkdirat(own->descriptor(), "new", folder_mode) != 0 && errno != EEXIST)
        return problem_with((own_path / "new").string(), errno);
    auto staged = own->below("new");
    if (!staged) return Unexpected(staged.error());
    return PushedFolder(std::move(*files), std::move(*own), std::move(*staged));
}

Expected<bool> PushedFolder::end_interrupted() {
    const bool is_committed = is_committed_to(files_);
    if (is_committed) {
        if (const auto finished = finish(); !finished) return Unexpected(finished.error());
    }
    const auto left = staged_.names_in("");
    if (!left) return Unexpected(left.error());
    for (const std::string& name : *left) {
        if (const int problem = staged_.remove(name); problem != 0) return problem_with(name, problem);
    }
    return is_committed;
}

Expected<void> PushedFolder::can_change(const std::string& name) const {
    const int why = files_.refuses(name);
    return why == 0 ? Expected<void>() : problem_with(name, why);
}

Expected<void> PushedFolder::stage(std::size_t number, const std::string& name, const ListedFile& file,
                                   const GivesBytes& content) {
    const std::string staged = std::to_string(number);
    const bool is_link = file.kind == ListedFile::Kind::link;
    Descriptor out;
    if (!is_link) {
        const mode_t mode = file.kind == ListedFile::Kind::program ? program_mode : file_mode;
        out = Descriptor(openat(staged_.descriptor(), staged.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
        if (!out) return problem_with(name, errno);
    }
    ContentHash hash;
    std::string target;
    while (true) {
        const auto piece = content();
        if (!piece) return Unexpected(piece.error());
        if (piece->empty()) break;
        hash.add(*piece);
        if (is_link) {
            target += *piece;
        } else if (const int problem = write_all(out.get(), *piece); problem != 0) {
            return problem_with(name, problem);
        }
    }
    if (is_link && symlinkat(target.c_str(), staged_.descriptor(), staged.c_str()) != 0)
        return problem_with(name, errno);
    if (hash.digits() != file.hash) return failure("changed while it was sent: push again", {.file = name});
    return {};
}

Expected<void> PushedFolder::commit(const FileList& next) {
    const int own = own_.descriptor();
    const int problem = syncfs(own) == 0 ? make_list(own, "next", next) : errno;
    return problem == 0 ? Expected<void>() : problem_with(own_name("next"), problem);
}

Expected<void> PushedFolder::adopt(const FileList& brought) {
    const int problem = make_list(own_.descriptor(), "list", brought);
    return problem == 0 ? Expected<void>() : problem_with(own_name("list"), problem);
}

Expected<std::vector<FileChange>> PushedFolder::finish() {
    const auto before = pushed_list(files_);
    if (!before) return Unexpected(before.error());
    const auto next = read_list(files_, own_name("next"));
    if (!next) return Unexpected(next.error());
    auto kept = put_in_place(*before, *next, files_, staged_.descriptor());
    if (!kept) return kept;
    const int own = own_.descriptor();
    if (syncfs(own) != 0 || renameat(own, "next", own, "list") != 0) return problem_with(own_name("list"), errno);
    fsync(own);  // if this rename is lost by a power cut, the same steps are repeated
    return kept;
}

}  // namespace nezumi::push
