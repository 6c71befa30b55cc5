--- State machines that can be watched: what one remembers is plain data, `current`, `previous`, `since` and `changes`,
--- and a table in `state` shows it in the console and in scenarios, and lets it live through a reload.

local expect = require "nezumi.expect"

---@class nezumi.StateMachine
---@field memory { current: string?, previous: string?, since: number?, changes: integer? }
local Machine = {}
Machine.__index = Machine

local function call(self, name, ...)
  local callback = self.states[self.memory.current][name]
  if callback then return callback(...) end
end

local function enter(self, name, now)
  local memory = self.memory
  memory.previous, memory.current, memory.since = memory.current, name, now
  memory.changes = (memory.changes or 0) + 1
  call(self, "enter")
end

local function names_of(states)
  local names = {}
  for name in pairs(states) do names[#names + 1] = name end
  return table.concat(names, ", ")
end

--- One execution: the present state's `execute(seconds)` runs, and the name that it returns, if it does, is entered.
---@param now number now() [s]
---@return string # the state that it is in then
function Machine:update(now)
  expect.number("state_machine: now", now)
  local memory = self.memory
  if self.states[memory.current] == nil then enter(self, self.initial, now) end
  local next_name = call(self, "execute", now - memory.since)
  if next_name ~= nil then
    if self.states[next_name] == nil then
      error(("state_machine: '%s' went to '%s', which is not a state: there are %s"):format(
        memory.current, tostring(next_name), names_of(self.states)), 2)
    end
    call(self, "exit")
    enter(self, next_name, now)
  end
  return memory.current
end

--- Goes to a state from outside of it, as a command may: it is left, and the other entered.
---@param name string
---@param now number now() [s]
function Machine:go(name, now)
  expect.number("state_machine: now", now)
  if self.states[name] == nil then
    error(("state_machine: there is no state '%s': there are %s"):format(tostring(name), names_of(self.states)), 2)
  end
  if self.states[self.memory.current] ~= nil then call(self, "exit") end
  enter(self, name, now)
end

--- The name of the state that it is in; nil before the first update.
---@return string?
function Machine:current() return self.memory.current end

--- `state_machine({ initial = "search", states = { search = { enter =, execute =, exit = }, ... } }, state.mode)`.
--- A state may also be a function, its `execute`. After a reload it goes on in its present state, which is not entered
--- again; if that state does not exist any more, it begins with `initial`.
---@param options { initial: string, states: table<string, table|fun(seconds: number): string?> }
---@param memory table?
---@return nezumi.StateMachine
local function new(options, memory)
  expect.fields("state_machine", options, { "initial", "states" })
  expect.kind("state_machine: states", options.states, "table")
  local states = {}
  for name, given in pairs(options.states) do
    expect.kind("state_machine: the name of a state", name, "string")
    local callbacks = type(given) == "function" and { execute = given } or given
    expect.fields("state_machine: state '" .. name .. "'", callbacks, { "enter", "execute", "exit" })
    for what, callback in pairs(callbacks) do
      expect.kind(("state_machine: %s of '%s'"):format(what, name), callback, "function")
    end
    states[name] = callbacks
  end
  if states[options.initial] == nil then
    error(("state_machine: initial is '%s', which is not a state: there are %s"):format(
      tostring(options.initial), names_of(states)), 2)
  end
  expect.kind("state_machine: memory", memory or {}, "table")
  return setmetatable({ initial = options.initial, states = states, memory = memory or {} }, Machine)
end

return new
