// The pupils of a class. Each pupil is a folder with a number: pupil.json, and the work on each exercise.
#include "bindings/web/classroom/pupils.hpp"

#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bindings/web/access.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/base/utf8.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::web {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The letters of codes. Letters that look alike are left out.
constexpr std::string_view code_letters = "23456789abcdefghjkmnpqrstuvwxyz";

std::string random_code() {
    std::string code;
    while (code.size() < Pupils::code_length) {
        unsigned char byte = 0;
        if (getrandom(&byte, 1, 0) != 1) return "";
        // Larger bytes are skipped, so that all letters are equally likely.
        if (byte < 256 / code_letters.size() * code_letters.size()) code += code_letters[byte % code_letters.size()];
    }
    return code;
}

Expected<Pupil> read_pupil(const fs::path& file, int number) {
    const auto text = read_whole(file, file.string());
    if (!text) return Unexpected(text.error());
    const Json json = Json::parse(*text, nullptr, false);
    const auto wrong = [&](const char* why) { return failure(why, {file.string()}); };
    if (!json.is_object()) return wrong("is not JSON");
    Pupil pupil{.number = number};
    for (const auto& [name, place] : {std::pair{"name", &pupil.name}, std::pair{"code", &pupil.code},
                                      std::pair{"token", &pupil.token}, std::pair{"exercise", &pupil.exercise},
                                      std::pair{"mark", &pupil.mark}, std::pair{"comment", &pupil.comment}}) {
        const auto found = json.find(name);
        if (found == json.end() || !found->is_string()) return wrong("is not the file of a pupil");
        *place = found->get<std::string>();
    }
    if (const auto hints = json.find("hints"); hints != json.end() && hints->is_array()) {
        for (const Json& each : *hints) {
            if (each.is_string()) pupil.hints.push_back(each.get<std::string>());
        }
    }
    return pupil;
}

}  // namespace

Expected<Pupils> Pupils::load(fs::path folder) {
    Pupils pupils(std::move(folder));
    const fs::path home = pupils.folder_ / "pupils";
    std::error_code problem;
    fs::create_directories(home, problem);
    if (problem) return failure("can't be made: " + problem.message(), {home.string()});
    fs::permissions(home, fs::perms::owner_all, problem);  // names, codes and work are for the teacher only
    for (fs::directory_iterator entry(home, problem), end; !problem && entry != end; entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        int number = 0;
        const auto [rest, wrong] = std::from_chars(name.data(), name.data() + name.size(), number);
        if (wrong != std::errc() || rest != name.data() + name.size() || number < 1 || number > most_number) continue;
        auto pupil = read_pupil(entry->path() / "pupil.json", number);
        if (!pupil) return Unexpected(pupil.error());
        pupils.all_.push_back(std::make_unique<Pupil>(std::move(*pupil)));
    }
    std::sort(pupils.all_.begin(), pupils.all_.end(),
              [](const auto& left, const auto& right) { return left->number < right->number; });
    return pupils;
}

Pupil* Pupils::find_code(std::string_view code) const {
    std::string plain;
    for (const char each : code.substr(0, 40)) {
        if (each == '-' || each == ' ') continue;
        plain += each >= 'A' && each <= 'Z' ? static_cast<char>(each - 'A' + 'a') : each;
    }
    const auto found =
        std::find_if(all_.begin(), all_.end(), [&](const auto& each) { return is_same_secret(each->code, plain); });
    return found == all_.end() ? nullptr : found->get();
}

Expected<Pupil*> Pupils::join(std::string_view given) {
    const std::string name(trimmed(given));
    if (name.empty()) return failure("enter a name");
    if (name.size() > longest_name) return failure("the name is too long");
    if (!is_utf8(name) || visible(name) != name || name.find_first_of("\n\t") != std::string::npos)
        return failure("the name has characters that can't be shown");
    if (std::any_of(all_.begin(), all_.end(), [&](const auto& each) { return each->name == name; }))
        return failure("this name is already used: use your code to come back, or add a letter to the name");
    const auto code = free_code();
    if (!code) return Unexpected(code.error());
    Pupil pupil{
        .number = all_.empty() ? 1 : all_.back()->number + 1, .name = name, .code = *code, .token = make_token()};
    if (auto ok = save(pupil); !ok) {
        remove(pupil);
        return Unexpected(ok.error());
    }
    all_.push_back(std::make_unique<Pupil>(std::move(pupil)));
    return all_.back().get();
}

void Pupils::remove(const Pupil& pupil) {
    std::error_code none;
    fs::remove_all(folder_of(pupil), none);
    std::erase_if(all_, [&](const auto& each) { return each.get() == &pupil; });
}

Expected<std::string> Pupils::free_code() const {
    for (;;) {
        std::string code = random_code();
        if (code.empty()) return failure("the kernel gives no random numbers for a code");
        if (find_code(code) == nullptr) return code;
    }
}

Expected<void> Pupils::renew(Pupil& pupil) {
    const auto code = free_code();
    if (!code) return Unexpected(code.error());
    pupil.code = *code;
    pupil.token = make_token();
    return save(pupil);
}

Expected<void> Pupils::save(const Pupil& pupil) const {
    const fs::path folder = folder_of(pupil);
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) return failure("can't be made: " + problem.message(), {folder.string()});
    const Json json{{"name", pupil.name},         {"code", pupil.code},   {"token", pupil.token},
                    {"exercise", pupil.exercise}, {"hints", pupil.hints}, {"mark", pupil.mark},
                    {"comment", pupil.comment}};
    return write_whole(folder / "pupil.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

fs::path Pupils::folder_of(const Pupil& pupil) const { return folder_ / "pupils" / fmt::format("{:02}", pupil.number); }

fs::path Pupils::work_of(const Pupil& pupil) const { return folder_of(pupil) / "work" / pupil.exercise; }

bool Tries::may_try(const std::string& source, Clock::time_point now) {
    while (!wrong_.empty() && now - wrong_.front().when > span) wrong_.pop_front();
    const auto own =
        std::count_if(wrong_.begin(), wrong_.end(), [&](const Wrong& each) { return each.source == source; });
    return wrong_.size() < most && static_cast<std::size_t>(own) < most_of_source;
}

}  // namespace nezumi::web
