// The words of a behaviour's file, as annotations.
#include "bindings/lua/stubs/annotations.hpp"

namespace nezumi::detail {

const char* const behavior_annotations =
    R"lua(---Declares a parameter, read as `config.name`. Its type follows the default: `30` integer, `0.0` number.
---@param name string
---@param default ParameterValue
---@param options? ParameterOptions
function param(name, default, options) end

---Defines a message type, in a separate file: `return message "Obstacle" { { "distance", "double", unit = "m" } }`.
---@param name string the name of the file: `light_sensors.lua` defines LightSensors
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

---A table that survives a reload. It can hold only plain data.
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

---Shows an internal value as `component.probes.name`; the last value of a tick counts. Recorded, but not in the trace.
---@param name string
---@param value number|boolean|string|table a table is flat, with at most 64 entries
function probe(name, value) end

---Declares a task, a function that waits between its steps. It starts on activation and runs from one wait to the next.
---@param name string
---@param fn fun()
---@param options? TaskOptions
function task(name, fn, options) end

---Starts a task at the next execution; an error if the task is already running.
---@param name string
function start(name) end

---Ends a task, and closes its `<close>` variables. Returns whether the task was running.
---@param name string
---@return boolean
function cancel(name) end

---Waits for this time; can be used only in a task. Returns the time that has passed [s].
---@param seconds number
---@return number
function wait(seconds) end

---Waits until `condition()` is true; can be used only in a task. Checks immediately, then in each execution. Returns
---false if the condition did not become true within the time limit of the options.
---@param condition fun(): any
---@param options? WaitOptions
---@return boolean
function wait_until(condition, options) end

---Called before the first execution after an activation.
function on_activated() end

---Called in every tick, or at the `rate` of the system file.
function on_execute() end

---Called when the component is deactivated or removed, or when the run ends.
function on_deactivated() end

---Called once when an error has stopped the component. May not write velocities.
function on_aborting() end

---Called in every tick while the component is in ERROR. May not write velocities.
function on_error() end

---Called when the component is reset; afterwards it is INACTIVE.
function on_reset() end

---Called in the new version of the file when it takes over from the old one.
---@param old_version integer
function on_reload(old_version) end

)lua";

}  // namespace nezumi::detail
