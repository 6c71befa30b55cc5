// Messages are separated by end bytes, by their length, or by COBS.
#include "hw/wire/framing.hpp"

namespace nezumi::hw {

std::string encode_cobs(std::string_view message) {
    std::string bytes(1, '\1');
    std::size_t code = 0;  // where the length of the present block is
    for (const char byte : message) {
        if (byte != '\0') {
            bytes.push_back(byte);
            bytes[code] = static_cast<char>(bytes[code] + 1);
        }
        if (byte == '\0' || bytes[code] == '\xff') {
            code = bytes.size();
            bytes.push_back('\1');
        }
    }
    return bytes;
}

std::optional<std::string> decode_cobs(std::string_view bytes) {
    std::string message;
    for (std::size_t i = 0; i < bytes.size();) {
        const std::size_t size = static_cast<unsigned char>(bytes[i]);
        if (size == 0 || i + size > bytes.size()) return std::nullopt;
        const std::string_view block = bytes.substr(i + 1, size - 1);
        if (block.find('\0') != std::string_view::npos) return std::nullopt;
        message += block;
        i += size;
        if (size < 0xff && i < bytes.size()) message.push_back('\0');
    }
    return message;
}

std::vector<std::string> Framer::take(std::string_view bytes) {
    std::vector<std::string> messages;
    if (framing_.length == 0 && end().empty()) {
        if (!bytes.empty()) messages.emplace_back(bytes);
        return messages;
    }
    rest_ += bytes;
    std::string_view left = rest_;
    if (framing_.length > 0) {
        for (; left.size() >= framing_.length; left.remove_prefix(framing_.length))
            messages.emplace_back(left.substr(0, framing_.length));
    } else {
        const std::string mark = end();
        for (std::size_t at = left.find(mark); at != std::string_view::npos; at = left.find(mark)) {
            const std::string_view message = left.substr(0, at);
            left.remove_prefix(at + mark.size());
            if (!framing_.cobs) {
                messages.emplace_back(message);
            } else if (message.empty()) {
                continue;  // a second zero
            } else if (auto decoded = decode_cobs(message)) {
                messages.push_back(std::move(*decoded));
            }
        }
    }
    rest_ = std::string(left);
    if (rest_.size() > longest) rest_.clear();
    return messages;
}

std::optional<std::string> Framer::encode(std::string_view message) const {
    if (framing_.length > 0 && message.size() != framing_.length) return std::nullopt;
    return (framing_.cobs ? encode_cobs(message) : std::string(message)) + end();
}

}  // namespace nezumi::hw
