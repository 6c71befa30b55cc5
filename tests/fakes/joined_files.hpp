// The files of a robot and of one more device in one folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/fakes/served_files.hpp"

namespace nezumi::fakes {

/// Both must outlive this.
class JoinedFiles final : public ServedFiles {
public:
    /// The second has one file, of this name.
    JoinedFiles(ServedFiles& first, ServedFiles& second, std::string name_of_second)
        : first_(first), second_(second), name_(std::move(name_of_second)) {}

    std::vector<std::string> names() const override {
        std::vector<std::string> all = first_.names();
        for (std::string& name : second_.names()) all.push_back(std::move(name));
        return all;
    }
    std::vector<std::string> folders() const override { return first_.folders(); }
    int look(const std::string& name) override { return of(name).look(name); }
    int open(const std::string& name, std::uint64_t& handle) override { return of(name).open(name, handle); }
    void close(const std::string& name, std::uint64_t handle) override { of(name).close(name, handle); }
    int read(const std::string& name, std::uint64_t handle, std::string& text) override {
        return of(name).read(name, handle, text);
    }
    int write(const std::string& name, std::uint64_t handle, std::string_view text) override {
        return of(name).write(name, handle, text);
    }
    bool is_stream(const std::string& name) const override { return of(name).is_stream(name); }
    int read_on(const std::string& name, std::uint64_t handle, std::size_t most, std::string& text) override {
        return of(name).read_on(name, handle, most, text);
    }
    unsigned poll(const std::string& name, std::uint64_t handle, std::function<void()> again) override {
        return of(name).poll(name, handle, std::move(again));
    }
    int control(const std::string& name, std::uint64_t handle, unsigned request, void* data) override {
        return of(name).control(name, handle, request, data);
    }
    std::size_t mapped_size(const std::string& name) const override { return of(name).mapped_size(name); }
    void read_mapped(const std::string& name, std::size_t from, std::size_t size, char* bytes) override {
        of(name).read_mapped(name, from, size, bytes);
    }
    void tell_changes(std::function<void(const std::string& name)> changed) override {
        first_.tell_changes(changed);
        second_.tell_changes(std::move(changed));
    }

private:
    ServedFiles& of(const std::string& name) const { return name == name_ ? second_ : first_; }

    ServedFiles& first_;
    ServedFiles& second_;
    const std::string name_;
};

}  // namespace nezumi::fakes
