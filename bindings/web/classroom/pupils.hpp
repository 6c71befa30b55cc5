// The pupils of a class: their names, codes and what the teacher wrote to them, kept in the class's folder.
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::web {

/// The largest number of a pupil.
inline constexpr int most_number = 999'999;

struct Pupil {
    int number = 0;      ///< 1 ... `most_number`; also the name of the pupil's folder
    std::string name{};  ///< in any writing system; never part of a path
    std::string code{};  ///< code with which the pupil comes back
    std::string token{};
    std::string exercise{};
    std::vector<std::string> hints{};  ///< the latest is the last
    std::string mark{}, comment{};
};

class Pupils {
public:
    static constexpr std::size_t longest_name = 120;      ///< [bytes]
    static constexpr std::size_t longest_comment = 4000;  ///< [bytes] also of a hint
    static constexpr std::size_t most_hints = 20;
    static constexpr std::size_t code_length = 6;

    /// Reads the pupils in `folder`/pupils, which is made if missing. An error names the file that can't be read.
    static Expected<Pupils> load(std::filesystem::path folder);

    const std::vector<std::unique_ptr<Pupil>>& all() const { return all_; }
    /// The pupil with this code; blanks, dashes and capitals do not matter. Null if there is none.
    Pupil* find_code(std::string_view code) const;

    /// Adds a new pupil. Refuses a name that is empty, too long, not printable, or already used.
    Expected<Pupil*> join(std::string_view name);
    /// Forgets a pupil who has just joined, and removes the folder.
    void remove(const Pupil& pupil);
    /// Gives the pupil a new code. From then on the old code and the pupil's open pages are refused.
    Expected<void> renew(Pupil& pupil);
    /// Writes the pupil's data to the disk.
    Expected<void> save(const Pupil& pupil) const;

    std::filesystem::path folder_of(const Pupil& pupil) const;
    /// The pupil's copy of their exercise, a project.
    std::filesystem::path work_of(const Pupil& pupil) const;

private:
    explicit Pupils(std::filesystem::path folder) : folder_(std::move(folder)) {}
    Expected<std::string> free_code() const;

    std::filesystem::path folder_;
    std::vector<std::unique_ptr<Pupil>> all_;
};

/// Limits the number of wrong codes, from one address and from all addresses.
class Tries {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t most_of_source = 5, most = 60;  ///< within `span`
    static constexpr std::chrono::seconds span{60};

    bool may_try(const std::string& source, Clock::time_point now);
    void was_wrong(const std::string& source, Clock::time_point now) { wrong_.push_back({source, now}); }

private:
    struct Wrong {
        std::string source;
        Clock::time_point when;
    };
    std::deque<Wrong> wrong_;
};

}  // namespace nezumi::web
