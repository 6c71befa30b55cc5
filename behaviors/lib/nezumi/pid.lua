--- A PID controller: sampled with the time that has passed, with output limits, anti-windup, and the derivative taken of
--- the measurement, so that a new setpoint makes no kick.

local angles = require "nezumi.angles"
local expect = require "nezumi.expect"

---@class nezumi.Pid
---@field kp number proportional gain; the gains may be assigned at any time
---@field ki number integral gain [1/s]
---@field kd number derivative gain [s]
---@field min number least output
---@field max number largest output
local Pid = {}
Pid.__index = Pid

--- The output that brings `measured` to `setpoint`.
---@param setpoint number
---@param measured number
---@param dt number time since the previous update [s], above 0
---@return number within min and max
function Pid:update(setpoint, measured, dt)
  expect.number("pid: setpoint", setpoint)
  expect.number("pid: measured", measured)
  expect.positive("pid: dt", dt)
  local memory = self.memory

  local deviation = setpoint - measured
  local step = measured - (memory.measured or measured)
  if self.angle then deviation, step = angles.wrap(deviation), angles.wrap(step) end
  -- First-order low pass, exact for inputs that are constant over dt.
  local weight = self.derivative_time > 0 and 1 - math.exp(-dt / self.derivative_time) or 1
  local rate = memory.rate or 0
  rate = rate + weight * (step / dt - rate)

  local growth = self.ki * deviation * dt
  local integral = (memory.integral or 0) + growth
  local wanted = self.kp * deviation + integral - self.kd * rate
  local output = math.max(self.min, math.min(self.max, wanted))
  -- Conditional integration (Astrom and Hagglund, Advanced PID Control, 3.5): at a limit the integral only grows away
  -- from it.
  if (wanted - output) * growth <= 0 then memory.integral = integral end
  memory.measured, memory.rate = measured, rate
  return output
end

--- Forgets all that was measured.
function Pid:reset()
  for name in pairs(self.memory) do self.memory[name] = nil end
end

local OPTIONS = { "kp", "ki", "kd", "min", "max", "angle", "derivative_time" }

--- `pid { kp =, ki =, kd =, min =, max =, angle =, derivative_time = }`: all may be left out. `angle = true` is for
--- setpoints and measurements in radians that go round; `derivative_time` [s] smooths the derivative.
--- What it remembers is plain data in `memory`: a table in `state` lets it live through a reload.
---@param options table
---@param memory table?
---@return nezumi.Pid
local function new(options, memory)
  expect.fields("pid", options, OPTIONS)
  local self = setmetatable({ memory = expect.kind("pid: memory", memory or {}, "table") }, Pid)
  for _, gain in ipairs { "kp", "ki", "kd" } do self[gain] = expect.number("pid: " .. gain, options[gain] or 0) end
  self.min, self.max = options.min or -math.huge, options.max or math.huge
  if not (type(self.min) == "number" and type(self.max) == "number" and self.min <= self.max) then
    error("pid: min and max expected numbers, min not above max", 2)
  end
  self.derivative_time = expect.not_negative("pid: derivative_time", options.derivative_time or 0)
  self.angle = expect.kind("pid: angle", options.angle or false, "boolean")
  return self
end

return new
