// What is wrong with a command line, in one plain sentence.
#pragma once

#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
class ParseError;
}  // namespace CLI

namespace nezumi::cli {

/// What the parser of `app` did not like, with the nearest option to a slip.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace nezumi::cli
