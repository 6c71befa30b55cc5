// What a program includes that runs systems itself; installed as <nezumi/nezumi.hpp>, of the component `embed`.
#pragma once

#include "bindings/embed/simulation.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/system.hpp"
