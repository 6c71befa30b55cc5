// Questions go to standard error, so that standard output has only results.
#include "bindings/cli/guided/person.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <sstream>

#include "bindings/console/put_text.hpp"

namespace nezumi::cli {

Expected<void> Person::is_there() const {
    if (is_sure_ || isatty(STDIN_FILENO) != 0) return {};
    return failure("a person must stand beside the robot: run this command in a terminal, or add --yes");
}

void Person::tell(const std::string& text) const { put_text(stderr, text + "\n"); }

Expected<void> Person::confirm(const std::string& text) {
    if (is_sure_) return {};
    put_text(stderr, text + " Press Enter to go on, Ctrl-C to end: ");
    auto said = line();
    return said ? Expected<void>() : Unexpected(said.error());
}

Expected<std::vector<double>> Person::numbers(const std::string& question, std::size_t count) {
    for (;;) {
        put_text(stderr, question + ": ");
        const auto said = line();
        if (!said) return Unexpected(said.error());
        std::istringstream words(*said);
        std::vector<double> all;
        for (double number = 0; words >> number;) all.push_back(number);
        if (words.eof() && all.size() == count) return all;
        tell(fmt::format("expected {} number{} separated by spaces, got '{}'", count, count == 1 ? "" : "s",
                         shown(*said)));
    }
}

Expected<std::string> Person::line() {
    std::string text;
    for (;;) {
        char c = 0;
        const ssize_t length = read(STDIN_FILENO, &c, 1);
        if (length == 1 && c == '\n') return text;
        if (length == 1) text += c;
        if (length == 1 || (length < 0 && errno == EINTR && end_ == 0)) continue;
        put_text(stderr, "\n");
        return failure(end_ != 0 ? "interrupted: the robot has stopped"
                                 : "there is no answer: standard input has ended");
    }
}

}  // namespace nezumi::cli
