// The options of the console's commands, with units and documentation.
#pragma once

#include <vector>

#include "bindings/console/session_parts.hpp"
#include "engine/ports/setting.hpp"
#include "engine/records/record_shape.hpp"

namespace nezumi {

template <>
struct Describe<PlotRequest> {
    static constexpr std::string_view name = "plot_options";
    static constexpr std::string_view doc = "Options of a drawing.";
    static constexpr FieldList fields{
        Setting{"every",
                &PlotRequest::every,
                "s",
                "simulated time between two drawings, at least 0.1",
                {.range = NumberRange::positive, .fallback = "drawn once"}},
        Internal{&PlotRequest::names},
        Internal{&PlotRequest::seconds},
        Internal{&PlotRequest::next},
        Internal{&PlotRequest::elsewhere},
    };
};

/// Options of `resume`.
struct ResumeOptions {
    bool live = false;
};

template <>
struct Describe<ResumeOptions> {
    static constexpr std::string_view name = "resume_options";
    static constexpr std::string_view doc = "Options of `resume`.";
    static constexpr FieldList fields{
        Setting{"live", &ResumeOptions::live, "", "come back to the present, where other programs wait"},
    };
};

/// The shapes of these structures.
inline std::vector<RecordShape> console_records() {
    return {shape_of_record<PlotRequest>(), shape_of_record<ResumeOptions>()};
}

}  // namespace nezumi
