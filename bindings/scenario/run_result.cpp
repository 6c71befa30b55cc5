// A field after the other; texts with their length before them.
#include "bindings/scenario/run_result.hpp"

#include <cstring>
#include <type_traits>

namespace nezumi {
namespace {

template <class Archive, class Result>
bool each_field(Archive& archive, Result& result) {
    return archive(result.outcome) && archive(result.error.message) && archive(result.error.place.file) &&
           archive(result.error.place.line) && archive(result.error.place.column) && archive(result.error.kind) &&
           archive(result.facts) && archive(result.margins) && archive(result.printed) && archive(result.folder) &&
           archive(result.files) && archive(result.seconds) && archive(result.wall_seconds) && archive(result.hash);
}

struct Writer {
    std::string bytes;

    template <class T>
    bool operator()(const T& value) {
        if constexpr (std::is_same_v<T, std::string>) {
            (*this)(value.size());
            bytes += value;
        } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
            (*this)(value.size());
            for (const std::string& each : value) (*this)(each);
        } else {
            static_assert(std::is_trivially_copyable_v<T>);
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
        return true;
    }
};

struct Reader {
    std::string_view bytes;

    template <class T>
    bool operator()(T& value) {
        if constexpr (std::is_same_v<T, std::string>) {
            std::size_t size = 0;
            if (!(*this)(size) || size > bytes.size()) return false;
            value.assign(bytes.substr(0, size));
            bytes.remove_prefix(size);
        } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
            std::size_t size = 0;
            if (!(*this)(size) || size > bytes.size()) return false;
            value.resize(size);
            for (std::string& each : value) {
                if (!(*this)(each)) return false;
            }
        } else {
            if (bytes.size() < sizeof value) return false;
            std::memcpy(&value, bytes.data(), sizeof value);
            bytes.remove_prefix(sizeof value);
        }
        return true;
    }
};

}  // namespace

std::string to_bytes(const RunResult& result) {
    Writer writer;
    each_field(writer, result);
    return writer.bytes;
}

Expected<RunResult> from_bytes(std::string_view bytes) {
    RunResult result;
    Reader reader{bytes};
    if (!each_field(reader, result) || !reader.bytes.empty()) return failure("the run's result is incomplete");
    return result;
}

}  // namespace nezumi
