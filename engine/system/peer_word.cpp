// The word before a port's name shows to which kind of peer the port belongs.
#include "engine/system/peer_word.hpp"

#include <algorithm>

namespace nezumi {

bool PeerWord::has_port(std::string_view end) const {
    const std::string_view form = port_form();
    return !form.empty() && end.starts_with(form.substr(0, form.find(':') + 1));
}

const PeerWord* word_of_port(const PeerWords& words, std::string_view end) {
    const auto found =
        std::find_if(words.begin(), words.end(), [&](const PeerWord* word) { return word->has_port(end); });
    return found == words.end() ? nullptr : *found;
}

}  // namespace nezumi
