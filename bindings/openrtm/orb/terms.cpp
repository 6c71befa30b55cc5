// Properties have OpenRTM-aist's names and defaults.
#include "bindings/openrtm/orb/terms.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>

#include "bindings/openrtm/orb/properties.hpp"

namespace nezumi::openrtm {
namespace {

// The largest rate [Hz] of a periodic connection.
constexpr double most_rate = 1000;

// True if a list "little, big" contains a word.
bool has(const std::string& list, std::string_view word) {
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::size_t first = list.find_first_not_of(' ', begin);
        const std::size_t last = list.find_last_not_of(' ', end == 0 ? 0 : end - 1);
        if (first < end && list.substr(first, last - first + 1) == word) return true;
        begin = end + 1;
    }
    return false;
}

}  // namespace

std::optional<Terms> terms_of(const SDOPackage::NVList& properties) {
    // Converts to lower case, because "Push" is the same as "push".
    const auto said = [&](const char* name, const char* fallback) {
        std::string text = text_of(properties, name);
        std::transform(text.begin(), text.end(), text.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        return text.empty() ? std::string(fallback) : text;
    };
    Terms terms;
    if (!has(said("dataport.interface_type", "corba_cdr"), "corba_cdr")) return std::nullopt;
    // OpenRTM-aist 2 has two names for this property.
    const std::string serializer = said("dataport.marshaling_type", "cdr");
    if (!has(serializer, "cdr") && !has(serializer, "corba")) return std::nullopt;
    const std::string dataflow = said("dataport.dataflow_type", "push");
    terms.push = has(dataflow, "push");
    if (!terms.push && !has(dataflow, "pull")) return std::nullopt;
    const std::string subscription = said("dataport.subscription_type", "flush");
    if (has(subscription, "periodic")) {
        terms.subscription = Terms::Subscription::periodic;
        std::string rate = said("dataport.publisher.push_rate", "");
        if (rate.empty()) rate = said("dataport.push_rate", "10");
        terms.rate = std::strtod(rate.c_str(), nullptr);
        if (!(terms.rate > 0)) return std::nullopt;
        terms.rate = std::min(terms.rate, most_rate);
    } else if (has(subscription, "new")) {
        terms.subscription = Terms::Subscription::newest;
    } else if (!has(subscription, "flush")) {
        return std::nullopt;
    }
    std::string policy = said("dataport.publisher.push_policy", "");
    if (policy.empty()) policy = said("dataport.push_policy", "");
    terms.keeps_all = policy == "all" || policy == "fifo";
    // Both sides use the first byte order of the list.
    const std::string orders = said("dataport.serializer.cdr.endian", "little");
    const std::string first = orders.substr(0, orders.find(','));
    if (has(first, "big")) {
        terms.order = std::endian::big;
    } else if (!has(first, "little")) {
        return std::nullopt;
    }
    return terms;
}

void add_own_terms(SDOPackage::NVList& properties, const std::string& type_id) {
    add_text(properties, "dataport.data_type", type_id);
    add_text(properties, "dataport.interface_type", "corba_cdr");
    add_text(properties, "dataport.dataflow_type", "push");
    add_text(properties, "dataport.subscription_type", "flush");
    add_text(properties, "dataport.marshaling_type", "cdr");
    add_text(properties, "dataport.serializer.cdr.endian", "little,big");
}

}  // namespace nezumi::openrtm
