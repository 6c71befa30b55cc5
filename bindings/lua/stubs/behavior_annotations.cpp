// The words of a behaviour's file, as annotations.
#include "bindings/lua/stubs/annotations.hpp"

namespace nezumi::detail {

const char* const behavior_annotations =
    R"lua(---@alias ParameterValue boolean|integer|number|string|boolean[]|integer[]|number[]|string[]

---@class (exact) ParameterOptions
---@field min? number inclusive; of each element of an array
---@field max? number inclusive; of each element of an array
---@field step? number of widgets only
---@field widget? "slider"|"spin"|"text"|"checkbox"|"radio"|string
---@field unit? string
---@field doc? string
---@field choices? ParameterValue[]
---@field min_size? integer of an array
---@field max_size? integer of an array

---Declares a parameter, read as `config.name`. Its type follows the default: `30` integer, `0.0` number.
---@param name string
---@param default ParameterValue
---@param options? ParameterOptions
function param(name, default, options) end

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

---@class (exact) About
---@field version? string
---@field vendor? string
---@field category? string

---Says who made this component, and what it is.
---@param fields About
function about(fields) end

---Declares a command, callable from console and scenario as `component:name(...)`.
---@param name string
---@param fn fun(...: any): any
---@param doc? string
function command(name, fn, doc) end

)lua";

const char* const system_annotations = R"lua(---@class (exact) RobotFields
---@field model string "raspimouse", or a file that returns robot_model { ... }
---@field pose? { x?: number, y?: number, heading?: number } [m] [rad]
---@field limits? { speed?: number, yaw_rate?: number, acceleration?: number, yaw_acceleration?: number } [m/s] [rad/s]
---@field backend? string
---@field active? boolean

---@class (exact) BehaviorFields
---@field script string the file `behaviors/SCRIPT.lua`
---@field config? table<string, ParameterValue>
---@field sets? table<string, table<string, ParameterValue>>
---@field set? string the set in use
---@field rate? number [Hz], at most the tick's
---@field active? boolean

---@class (exact) ComponentFields
---@field type string of a native component
---@field config? table<string, ParameterValue>
---@field rate? number [Hz]
---@field on? string the robot that carries it
---@field at? number[] [m] { x, y, z } on that robot
---@field yaw? number [rad]
---@field active? boolean

---@class Thing

---@param fields { at: number[], size: number[], yaw?: number, pitch?: number, color?: string, mass?: number }
---@return Thing
function box(fields) end

---@param fields { from: number[], to: number[], height?: number, thickness?: number, color?: string }
---@return Thing
function wall(fields) end

---@param fields { at: number[], radius: number, height: number, mass?: number, color?: string }
---@return Thing
function cylinder(fields) end

---@param fields { id: integer, name?: string, size?: number, at: number[], facing?: number }
---@return Thing
function marker(fields) end

---@param fields { image: string, size: number[] }
---@return Thing
function floor(fields) end

---Fixed boxes from a file with rows x,y,z,lx,ly,lz,yaw.
---@param file string
---@return Thing
function csv(file) end

---@class (exact) ArenaFields
---@field size? number[] [m] { x, y }
---@field border? boolean|{ height?: number, thickness?: number }
---@field [integer] Thing|Thing[]

---@param fields ArenaFields
function arena(fields) end

---@param name string
---@param fields RobotFields
---@overload fun(name: string): fun(fields: RobotFields)
function robot(name, fields) end

---@param name string
---@param fields BehaviorFields
---@overload fun(name: string): fun(fields: BehaviorFields)
function behavior(name, fields) end

---@param name string
---@param fields ComponentFields
---@overload fun(name: string): fun(fields: ComponentFields)
function component(name, fields) end

---Connects an out-port to an in-port of the same type.
---@param from string "name.port"
---@param to string "name.port"
function connect(from, to) end

---@param n integer of everything random in the run
function seed(n) end

---@param hz number ticks a second, 100 unless it says otherwise
function rate(hz) end

---@param fields { step?: number } [s]
function physics(fields) end

---@param fields table
---@return table
function robot_model(fields) end

)lua";

}  // namespace nezumi::detail
