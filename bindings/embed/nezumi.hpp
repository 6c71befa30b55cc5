// The header for programs that run systems themselves; installed as <nezumi/nezumi.hpp>, component `embed`.
#pragma once

#include "bindings/embed/simulation.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/system.hpp"
