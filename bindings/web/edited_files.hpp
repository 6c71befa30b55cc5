// The files of a project that browsers read and write: only those within its folder, and never through links.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"

namespace nezumi::web {

/// A text, and a mark that differs for another text.
struct EditedText {
    std::string text;
    std::string mark;
};

/// The mark of a text: 16 hexadecimal digits.
std::string mark_of(std::string_view text);

/// What became of a text that was to be saved.
struct SavedText {
    /// The file is not the one that was read before: nothing was written.
    bool is_refused = false;
    /// Then its present text; nothing if the file is gone.
    std::optional<EditedText> present{};
    /// Otherwise the mark of the written text.
    std::string mark{};
    /// Why no version was kept in the history; "" if it was.
    std::string note{};
};

/// A text that was saved earlier.
struct KeptVersion {
    int number = 0;             ///< 1 is the oldest one; older ones than `most_versions` are removed
    std::int64_t saved_at = 0;  ///< [s] since 1970
    std::size_t bytes = 0;
};

/// Names are paths below the folder, with '/'. Hidden files, other kinds of files and links are refused, also for the
/// folders on the way. All functions may be called in any thread; calls must not overlap.
class EditedFiles {
public:
    /// [bytes] Longer texts are neither read nor written.
    static constexpr std::size_t longest_text = std::size_t{256} << 10;
    static constexpr std::size_t most_files = 2000;
    static constexpr int most_versions = 100;

    explicit EditedFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& folder() const { return folder_; }

    /// An error if the name can't be that of a file here.
    static Expected<void> check_name(std::string_view name);

    /// All files, sorted; at most `most_files`.
    std::vector<std::string> names() const;
    Expected<EditedText> read(const std::string& name) const;
    /// Writes the whole file or nothing: it is on the disk when this returns. `before` is the mark of the text that the
    /// writer has read, "" for a new file; if the file has another text now, nothing is written.
    Expected<SavedText> write(const std::string& name, const std::string& text, const std::string& before) const;

    /// The kept versions of a file, newest first: what was found at the first save, and each saved text.
    std::vector<KeptVersion> versions(const std::string& name) const;
    Expected<std::string> version(const std::string& name, int number) const;

private:
    Expected<Descriptor> open_folder_of(const std::string& path, bool makes) const;
    std::string keep(const std::string& name, const std::string& text) const;

    std::filesystem::path folder_;
};

}  // namespace nezumi::web
