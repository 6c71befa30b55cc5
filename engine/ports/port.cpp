// Makes ports from the name of a message type.
#include "engine/ports/port.hpp"

namespace nezumi {

std::unique_ptr<InPortBase> make_in_port(std::size_t type, std::string name, std::string doc, std::size_t queue) {
    return with_payload_type(type, [&]<class T>() -> std::unique_ptr<InPortBase> {
        return std::make_unique<InPort<T>>(std::move(name), std::move(doc), queue);
    });
}

std::unique_ptr<OutPortBase> make_out_port(std::size_t type, std::string name, std::string doc,
                                           std::optional<Value> safe) {
    return with_payload_type(type, [&]<class T>() -> std::unique_ptr<OutPortBase> {
        auto port = std::make_unique<OutPort<T>>(std::move(name), std::move(doc));
        if (safe) port->set_safe(std::move(*safe).get<T>());
        return port;
    });
}

Expected<std::size_t> find_message_type(std::string_view name) {
    for (std::size_t i = 0; i < message_type_count; ++i) {
        if (message_type_names[i] == name) return i;
    }
    const std::vector<std::string_view> names(message_type_names.begin(), message_type_names.end());
    return failure("unknown type '" + shown(name) + "'" + did_you_mean(name, names) +
                   "; `nezumi types` lists them all");
}

}  // namespace nezumi
