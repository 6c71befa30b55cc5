// A word of system files that describes peers by one structure with a `Describe`.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/setting.hpp"
#include "engine/project/project.hpp"
#include "engine/records/read_record.hpp"
#include "engine/records/record_shape.hpp"
#include "engine/records/word_call.hpp"
#include "engine/system/peer_word.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// A word whose table is a structure `T` with a member `place`.
template <Recorded T>
class PeerWordOf : public PeerWord {
public:
    struct Spec final : PeerSpec {
        Spec(const PeerWord& word, T table) : PeerSpec(word, table.place), given(std::move(table)) {}
        const T given;
    };

    std::string_view name() const final { return Describe<T>::name; }
    std::vector<RecordShape> records() const override { return {shape_of_record<T>()}; }
    Expected<std::shared_ptr<const PeerSpec>> read(const PeerCall& call) const final {
        FieldCheck check = check_of(call.call, call.table);
        Fields fields(check, call.table);
        T given;
        given.place = call.call.place;
        read_record(fields, given);
        complete(given, fields, call);
        fields.done();
        if (auto ok = check.result(); !ok) return Unexpected(ok.error());
        return spec(std::move(given));
    }
    std::string text(const PeerSpec& spec) const final { return text_of(static_cast<const Spec&>(spec).given); }

    /// An entry for `SystemSpec::peers`.
    std::shared_ptr<const PeerSpec> spec(T given) const { return std::make_shared<Spec>(*this, std::move(given)); }
    /// The table of this word in a system file; null if the file does not use the word.
    static const T* find(const SystemSpec& system) {
        const auto found = system.peers.find(Describe<T>::name);
        return found == system.peers.end() ? nullptr : &static_cast<const Spec&>(*found->second).given;
    }
    /// Sets the table of this word.
    void put(SystemSpec& system, T given) const {
        system.peers.insert_or_assign(std::string(name()), spec(std::move(given)));
    }

protected:
    /// Reads the fields that `read_record` does not read, and checks all fields.
    virtual void complete(T& given, Fields& fields, const PeerCall& call) const = 0;
    virtual std::string text_of(const T& given) const = 0;
};

}  // namespace nezumi
