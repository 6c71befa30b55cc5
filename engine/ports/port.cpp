// Makes ports from the name of a message type.
#include "engine/ports/port.hpp"

namespace nezumi {

std::unique_ptr<InPortBase> make_in_port(const MessageType* type, std::string name, std::string doc,
                                         std::size_t queue) {
    return with_payload_type(*type, [&]<class T>() -> std::unique_ptr<InPortBase> {
        return std::make_unique<InPort<T>>(std::move(name), std::move(doc), queue, type);
    });
}

std::unique_ptr<OutPortBase> make_out_port(const MessageType* type, std::string name, std::string doc,
                                           std::optional<Value> safe) {
    return with_payload_type(*type, [&]<class T>() -> std::unique_ptr<OutPortBase> {
        auto port = std::make_unique<OutPort<T>>(std::move(name), std::move(doc), default_safe<T>(), type);
        if (safe) port->set_safe_any(&*safe);
        return port;
    });
}

Expected<const MessageType*> find_message_type(std::string_view name) {
    for (const MessageType& each : compiled_message_types()) {
        if (each.name == name) return &each;
    }
    const auto all = compiled_message_names();
    const std::vector<std::string_view> names(all.begin(), all.end());
    return failure("unknown type '" + shown(name) + "'" + did_you_mean(name, names) +
                   "; `nezumi types` lists them all");
}

}  // namespace nezumi
