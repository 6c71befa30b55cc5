// The words of a scenario's file, as annotations.
#include "bindings/lua/stubs/annotations.hpp"

namespace nezumi::detail {

const char* const scenario_annotations = R"lua(---@class TaskView
---@field status "inactive"|"ready"|"waiting"|"finished"|"cancelled"|"failed"
---@field since number [s] time of the last change of the status
---@field waiting? string what the task waits for, and the remaining time
---@field line? integer where it waits

---@class ProbeView
---@field value number|boolean|string|table
---@field tm number [s] time when the value was set
---@field age number [s]

---@alias World table<string, Component>
---@alias PortName Port|string a port or "name.port"
---@alias Condition fun(): any

---@class Range

---@param from number
---@param to number
---@param step? number without it any number between
---@return Range
function range(from, to, step) end

---@param name string
---@param options ScenarioOptions
---@param fn fun(s: Scenario, p: table<string, any>)
---@overload fun(name: string, fn: fun(s: Scenario))
function scenario(name, options, fn) end

---@class SpacePart
---@field [1] string its name
---@field count? integer number of values, 1 without it
---@field min? number
---@field max? number

---@class Environment
---@field system string the name of a system file
---@field ticks? integer of a step, 1 without it
---@field limit? integer steps after which an episode is truncated
---@field action (SpacePart|string)[]
---@field observation (SpacePart|string)[]
---@field start? fun(): table<string, any> values as of `--set`, for the system of this episode
---@field reset? fun(world: World) before the first tick
---@field act fun(world: World, action: number[])
---@field observe fun(world: World): any the numbers of the observation, also in nested lists
---@field reward fun(world: World, action: number[]): number
---@field terminated? fun(world: World): boolean

---Describes an environment for learning programs.
---@param description Environment
function environment(description) end

---@class Scenario
---@field seed integer of this run
---@field world World the components of the system, as soon as a system exists
---@field [string] Component a component of the system
local s = {}

---Loads a system file and activates its components. Its robots may differ by fields of a robot file.
---@param file string
---@param options? LoadOptions
---@return World
function s:load(file, options) end

---A recorded run as a world: its ports can be read while time moves through the recording. A journal, a recording
---of nezumi, or a recording of ROS 2 in MCAP.
---@param file string
---@param options? RecordedOptions
---@return World world
---@return number length [s] of the recording
function s:recorded(file, options) end

---Gives a behaviour the inputs of its component in a recorded run. Fails if an output differs from the recorded one.
---@param options JudgeOptions
function s:judge(options) end

---[s] Simulated time since the scenario began.
---@return number
function s:now() end

---The condition must be true after every tick, from now to the end of the scenario.
---@param name string
---@param condition Condition
---@overload fun(self: Scenario, name: string, options: ExpectationOptions, condition: Condition)
function s:always(name, condition) end

---The condition must be false after every tick, from now to the end of the scenario.
---@param name string
---@param condition Condition
---@overload fun(self: Scenario, name: string, options: ExpectationOptions, condition: Condition)
function s:never(name, condition) end

---Lets time pass.
---@param seconds number [s]
function s:run(seconds) end

---@param name string
---@param options ExpectationOptions
---@param condition Condition
function s:wait_until(name, options, condition) end

---@param name string
---@param options ExpectationOptions
---@param condition Condition
function s:eventually(name, options, condition) end

---@param name string
---@param options ExpectationOptions
---@param condition Condition
function s:maintain(name, options, condition) end

---@param value any
---@param message? string
function s:check(value, message) end

---@param actual number
---@param expected number
---@param tolerance number
---@param message? string
function s:near(actual, expected, tolerance, message) end

---Compares deeply; a failure shows both values.
---@param actual any
---@param expected any
---@param message? string
function s:equal(actual, expected, message) end

---Allows this component to go to ERROR from now on. Without this, ERROR fails the scenario.
---@param component Component|string
function s:allow_error(component) end

---Draws values, each from a range or list, by the seed of this run. A search chooses them. A failing run is simplified.
---@param name string
---@param values table<string, any[]|Range>
---@return table<string, any>
function s:any(name, values) end

---Keeps one number of this run under a name: `nezumi test --measures FILE.csv` has a row for each run.
---@param name string
---@param value number finite
---@param unit? string
function s:measure(name, value, unit) end

---Records these ports after every tick from now on, and compares them with a committed file beside the scenario file.
---@param file string
---@param options GoldenOptions
---@param ... PortName
---@overload fun(self: Scenario, file: string, ...: PortName)
function s:golden(file, options, ...) end

---Puts one message into a port, as if it came through a connection.
---@param port PortName
---@param value any
function s:inject(port, value) end

---The port has this value, whatever else is written, until `release`.
---@param port PortName
---@param value any
---@param options? HoldOptions
function s:hold(port, value, options) end

---@param port PortName
function s:release(port) end

---@param component Component|string
---@param new ReloadOptions
---@return boolean ok
---@return string? message
function s:reload(component, new) end

---No message gets through this port.
---@param port PortName
---@param seconds? number [s] without it until `restore`
function s:drop(port, seconds) end

---The port repeats its present value.
---@param port PortName
---@param seconds? number [s] without it until `restore`
function s:freeze(port, seconds) end

---Forces velocities on a robot, as if a hand moved it.
---@param robot Component|string
---@param velocities VelocityConstraintFields
function s:disturb(robot, velocities) end

---@param robot Component|string
---@param button string
---@param seconds? number [s] without it until `restore`
function s:press(robot, button, seconds) end

---Moves a robot, which is then at rest. Or moves a marker or object by its name; omitted fields keep their values.
---@param thing Component|string
---@param pose PoseFields|MarkerPoseFields
function s:teleport(thing, pose) end

---Emergency stop: every robot brakes as hard as it can and ignores commands, until `rearm`.
function s:stop() end

---Ends the emergency stop: robots obey commands from now on. All robots must stand still.
function s:rearm() end

---Ends what `drop`, `freeze`, `disturb` and `press` began.
---@param thing PortName|Component
function s:restore(thing) end
)lua";

}  // namespace nezumi::detail

namespace nezumi {

const char* const annotations_plugin =
    R"lua(--- A plugin of the Lua language server: `config.` completes the parameters that a file declares with `param`.
--- Written by `nezumi new project`.

local function type_of(default)
  if default == "true" or default == "false" then return "boolean" end
  if default:find("^[\"']") then return "string" end
  if default:find("^{") then return type_of(default:match("^{%s*([^%s,}]+)") or "0.0") .. "[]" end
  return math.type(tonumber(default)) == "integer" and "integer" or "number"
end

function OnSetText(uri, text)
  local fields = {}
  for name, at in text:gmatch("%f[%w_]param%s*%(?%s*[\"']([%a_][%w_]*)[\"']%s*,%s*()") do
    local default = text:match("^%b{}", at) or text:match("^[^,)%s]+", at) or ""
    table.insert(fields, ("---@field %s %s\n"):format(name, type_of(default)))
  end
  if #fields == 0 then return nil end
  local class = "Config." .. (uri:match("([%w_]+)%.lua$") or "here")
  return { {
    start = 1, finish = 0,
    text = ("---@class (exact) %s\n%slocal config\n"):format(class, table.concat(fields)),
  } }
end
)lua";

}  // namespace nezumi
