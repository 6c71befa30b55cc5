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

/// The text of a file, and its mark, which differs for different texts.
struct EditedText {
    std::string text;
    std::string mark;
};

/// The mark of a text: 16 hexadecimal digits.
std::string mark_of(std::string_view text);

/// The result of saving a text.
struct SavedText {
    /// True: the file has changed since the writer read it, so nothing was written.
    bool is_refused = false;
    /// If refused: the present text of the file; nothing if the file is gone.
    std::optional<EditedText> present{};
    /// If written: the mark of the written text.
    std::string mark{};
    /// Why no version was kept in the history; "" if it was.
    std::string note{};
};

/// A text that was saved earlier.
struct KeptVersion {
    int number = 0;             ///< 1 for the first version; only the latest `most_versions` are kept
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

    /// Returns an error if a file of this name can't be edited.
    static Expected<void> check_name(std::string_view name);

    /// All files, sorted; at most `most_files`.
    std::vector<std::string> names() const;
    Expected<EditedText> read(const std::string& name) const;
    /// Writes the whole file to the disk, or nothing. `before` is the mark of the text that the writer has read, "" for
    /// a new file; if the file has another text now, nothing is written.
    Expected<SavedText> write(const std::string& name, const std::string& text, const std::string& before) const;

    /// The kept versions of a file, newest first: the text before the first save, and each saved text.
    std::vector<KeptVersion> versions(const std::string& name) const;
    Expected<std::string> version(const std::string& name, int number) const;

private:
    Expected<Descriptor> open_folder_of(const std::string& path, bool makes) const;
    std::string keep(const std::string& name, const std::string& text) const;

    std::filesystem::path folder_;
};

}  // namespace nezumi::web
