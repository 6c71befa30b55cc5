// The words of a behaviour's file, as annotations.
#include "bindings/lua/stubs/annotations.hpp"

namespace nezumi::detail {

const char* const behavior_annotations =
    R"lua(---Declares a parameter, read as `config.name`. Its type follows the default: `30` integer, `0.0` number.
---@param name string
---@param default ParameterValue
---@param options? ParameterOptions
function param(name, default, options) end

---Defines a message type, in a file of its own: `return message "Obstacle" { { "distance", "double", unit = "m" } }`.
---@param name string that of the file: `light_sensors.lua` defines LightSensors
---@return fun(fields: table): nil
function message(name) end

---The constants of a message type that a file defines: `constants("sensor_msgs/Range").ULTRASOUND`.
---@param type MessageType
---@return table<string, boolean|number|string>
function constants(type) end

---@class Config
---@field [string] any

---The parameters that the file declares; `config.x = v` holds from the next tick.
---@type Config
config = {}

---Survives a reload: plain data only.
---@type table<any, any>
state = {}

---[s] Time since the start.
---@return number
function now() end

---[s] Time since the previous execution.
---@type number
dt = 0

---@class Log
---@field debug fun(...: any)
---@field info fun(...: any)
---@field warn fun(...: any)
---@field error fun(...: any)
log = {}

---The version, vendor and category of this component.
---@param fields AboutFields
function about(fields) end

---Declares a command, callable from console and scenario as `component:name(...)`.
---@param name string
---@param fn fun(...: any): any
---@param doc? string
function command(name, fn, doc) end

---Shows a value from inside as `component.probes.name`: the last of a tick counts. Recorded, and no part of the trace.
---@param name string
---@param value number|boolean|string|table a table is flat, with at most 64 entries
function probe(name, value) end

---Declares what is done one after the other: it starts on activation and runs in slices, from one wait to the next.
---@param name string
---@param fn fun()
---@param options? TaskOptions
function task(name, fn, options) end

---Starts a task at the next execution; an error while it is under way.
---@param name string
function start(name) end

---Ends a task, its `<close>` variables included. Returns whether it was under way.
---@param name string
---@return boolean
function cancel(name) end

---Waits so long, in a task only. Returns the time that has passed [s].
---@param seconds number
---@return number
function wait(seconds) end

---Waits until `condition()` is true, in a task only: looks immediately, then in each execution. Returns false when it was
---not within the time that is given.
---@param condition fun(): any
---@param options? WaitOptions
---@return boolean
function wait_until(condition, options) end

---Before the first execution after an activation.
function on_activated() end

---In every tick, or at the `rate` of the system file.
function on_execute() end

---When it is deactivated, removed, or the run ends.
function on_deactivated() end

---Once, when an error has stopped it. May not write velocities.
function on_aborting() end

---In every tick while it is in ERROR. May not write velocities.
function on_error() end

---When somebody resets it; afterwards it is INACTIVE.
function on_reset() end

---When a new version of the file takes over.
---@param old_version integer
function on_reload(old_version) end

)lua";

}  // namespace nezumi::detail
