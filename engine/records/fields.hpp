// Strict reading of tables that a person wrote: each field is read by name, and every other field is an error.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/setting.hpp"
#include "engine/records/field_path.hpp"
#include "engine/records/file_table.hpp"

namespace nezumi {

/// Collects the mistakes of one call. Keeps the first mistake of the most serious kind. The kinds, the most serious
/// first: an unknown field (which often explains a missing field), a wrong value, a missing field.
class FieldCheck {
public:
    /// Every message begins with `what`: "robot 'mouse'". `source` may be null. `noun` is the name of a field in
    /// messages.
    FieldCheck(std::string what, std::string word, Place call, const FieldSource* source, std::string noun = "field")
        : what_(std::move(what)),
          word_(std::move(word)),
          call_(std::move(call)),
          source_(source),
          noun_(std::move(noun)) {}
    /// For the options of a call from Lua; the caller adds the location to the error.
    static FieldCheck of_options(std::string what) { return {std::move(what), "", {}, nullptr, "option"}; }

    /// The arguments of the call, which distinguish it from other calls in its line. The table is not copied.
    void set_given(GivenTable given) { given_ = std::move(given); }

    void unknown(const FieldPath& path, std::string_view hint);
    /// "robot 'mouse': field 'pose.x' TEXT".
    void wrong(const FieldPath& path, std::string_view text);
    void missing(const FieldPath& path, std::string_view expected);
    /// "robot 'mouse': field 'set': TEXT".
    void explain(const FieldPath& path, std::string_view text);
    /// "robot 'mouse': TEXT", at the location of the field.
    void wrong_at(const FieldPath& path, std::string_view text);
    /// An error with its own text and location.
    void wrong(Error error);

    bool ok() const { return gravity_ == 0; }
    Place place_of(const FieldPath& path) const {
        return source_ != nullptr ? source_->find(word_, call_, path, given_) : call_;
    }
    const Place& call() const { return call_; }
    const std::string& noun() const { return noun_; }
    Expected<void> result() const;

private:
    void keep(int gravity, Error error);

    std::string what_;
    std::string word_;
    Place call_;
    const FieldSource* source_;
    std::string noun_;
    GivenTable given_;
    int gravity_ = 0;
    Error error_;
};

/// One table, and the fields that have been read. A getter leaves `out` unchanged if there is no such field. It returns
/// whether the field exists and fits.
class Fields {
public:
    /// A nil `value` is an empty table.
    Fields(FieldCheck& check, const Value& value, FieldPath path = {});

    /// nullptr if there is no such field.
    const Value* field(std::string_view name);
    bool has(std::string_view name) { return field(name) != nullptr; }
    /// Whether the field exists, without marking it as read: `done` may still report it as unknown.
    bool gives(std::string_view name) const { return table_->find(name) != nullptr; }
    bool boolean(std::string_view name, bool& out);
    bool number(std::string_view name, double& out, const Rule& rule = {}, std::string_view unit = "");
    bool whole(std::string_view name, std::int64_t& out, std::int64_t min, std::int64_t max);
    bool text(std::string_view name, std::string& out);
    /// `{ x, y }` or `{ x =, y = }`.
    bool point(std::string_view name, Point2D& out, NumberRange range = NumberRange::any);
    /// `{ x, y, z }` or `{ x =, y =, z = }`. If `z_optional`, z may be omitted and keeps its value.
    bool point(std::string_view name, Point3D& out, NumberRange range = NumberRange::any, bool z_optional = false);
    /// The index of the text in `choices`.
    bool choice(std::string_view name, std::size_t& out, std::span<const std::string_view> choices);
    /// A text or a list of texts.
    bool names(std::string_view name, std::vector<std::string>& out);
    /// Values of parameters, by name.
    bool values(std::string_view name, ParameterValues& out);
    /// `{ x =, y =, heading = }`.
    bool pose(std::string_view name, Pose2D& out);
    /// An error if one of the `lengths` is smaller than `rule` allows, because it is too small for the physics.
    void check_lengths(std::string_view name, const Rule& rule, std::string_view unit, std::span<const double> lengths);
    /// The fields of an inner table; none if there is no such table.
    Fields inner(std::string_view name);
    /// Every field in ascending order, for tables with names that the person chooses.
    const std::vector<FileField>& all() const { return table_->fields; }
    /// The elements 1..n; marks them as read.
    const std::vector<Value>& elements();

    /// An error if there is no such field. `expected` describes its value.
    void require(std::string_view name, std::string_view expected);
    /// Refuses every field that was not read. `hint` may explain a name: it returns a text for the end of the message,
    /// or "".
    void done(std::string (*hint)(std::string_view name) = nullptr);

    FieldCheck& check() { return check_; }
    FieldPath path_of(std::string_view name) const;
    const FieldPath& path() const { return path_; }

private:
    bool coordinates(std::string_view name, std::vector<double>& out, std::size_t least, std::size_t most,
                     NumberRange range);

    FieldCheck& check_;
    const FileTable* table_;
    FieldPath path_;
    std::vector<std::string> asked_;
    bool elements_asked_ = false;
};

}  // namespace nezumi
