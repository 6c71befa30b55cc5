// The options of a behaviour's declarations, with documentation and limits.
#pragma once

#include "bindings/lua/script/script.hpp"
#include "engine/ports/setting.hpp"

namespace nezumi {

template <>
struct Describe<PortDeclaration> {
    static constexpr std::string_view name = "port_options";
    static constexpr std::string_view doc = "Options of a port.";
    static constexpr std::array<std::string_view, 2> kinds{"input", "output"};
    static constexpr unsigned input = 1U << 0U, output = 1U << 1U;
    static constexpr FieldList fields{
        Setting{"queue",
                &PortDeclaration::queue,
                "",
                "how many unread messages are kept; then the oldest is dropped",
                {.min = 1, .max = 100'000, .of = input, .fallback = "the latest only"}},
        Extra{"safe",
              "a value of the port's type",
              "",
              "written when the component stops",
              {.of = output, .fallback = "0 for TimedVelocity2D, else nothing"}},
        Internal{&PortDeclaration::direction},
        Internal{&PortDeclaration::name},
        Internal{&PortDeclaration::type},
        Internal{&PortDeclaration::doc},
        Internal{&PortDeclaration::safe},
        Internal{&PortDeclaration::place},
    };
};

template <>
struct Describe<TaskOptions> {
    static constexpr std::string_view name = "task_options";
    static constexpr std::string_view doc = "Options of a task.";
    static constexpr FieldList fields{
        Setting{"repeating", &TaskOptions::repeating, "", "starts again in the next execution after its end"},
    };
};

template <>
struct Describe<WaitOptions> {
    static constexpr std::string_view name = "wait_options";
    static constexpr std::string_view doc = "Options of a wait for a condition.";
    static constexpr FieldList fields{
        Setting{"within",
                &WaitOptions::within,
                "s",
                "stops waiting after this time",
                {.range = NumberRange::not_negative, .fallback = "never"}},
    };
};

template <>
struct Describe<ScriptAbout> {
    static constexpr std::string_view name = "about";
    static constexpr std::string_view doc = "The version, vendor and category of this component.";
    static constexpr FieldList fields{
        Setting{"version", &ScriptAbout::version, "", "of the file, for example \"1.2\""},
        Setting{"vendor", &ScriptAbout::vendor, "", "who made it"},
        Setting{"category", &ScriptAbout::category, "", "what kind of component it is, for example \"navigation\""},
        Internal{&ScriptAbout::given},
    };
};

}  // namespace nezumi
