--- Filters for single values: each is made once, is given a value an execution by `update`, and says what comes out.
--- What one remembers is plain data in `memory`, its last argument: a table in `state` lets it live through a reload.

local expect = require "nezumi.expect"

local filters = {}

---@class nezumi.Filter
---@field memory table
local Filter = {}
Filter.__index = Filter

--- Forgets all values.
function Filter:reset()
  for name in pairs(self.memory) do self.memory[name] = nil end
end

-- A kind of filter: `update` is its method, `self` has its options.
local function kind(update)
  local metatable = setmetatable({ update = update }, Filter)
  metatable.__index = metatable
  return function(memory, options)
    options.memory = memory
    return setmetatable(options, metatable)
  end
end

local low_pass = kind(function(self, value, dt)
  expect.number("low_pass: value", value)
  expect.positive("low_pass: dt", dt)
  local memory = self.memory
  local before = memory.value or value
  memory.value = before + (1 - math.exp(-dt / self.time)) * (value - before)
  return memory.value
end)

--- A low pass of first order: after a step, `time` [s] later, 63 % of it have come through. `update(value, dt)`.
---@param options { time: number }
---@param memory table?
---@return nezumi.Filter
function filters.low_pass(options, memory)
  expect.fields("low_pass", options, { "time" })
  local time = expect.positive("low_pass: time", options.time)
  return low_pass(expect.kind("low_pass: memory", memory or {}, "table"), { time = time })
end

-- The newest `count` values, oldest first.
local function remember(memory, value, count)
  memory.values = memory.values or {}
  local values = memory.values
  values[#values + 1] = value
  while #values > count do table.remove(values, 1) end
  return values
end

local LONGEST = 1000

local moving_average = kind(function(self, value)
  expect.number("moving_average: value", value)
  local values = remember(self.memory, value, self.count)
  local sum = 0
  for _, each in ipairs(values) do sum = sum + each end
  return sum / #values
end)

--- The mean of the last `count` values (1 to 1000), or of those that there are. `update(value)`.
---@param options { count: integer }
---@param memory table?
---@return nezumi.Filter
function filters.moving_average(options, memory)
  expect.fields("moving_average", options, { "count" })
  local count = expect.whole("moving_average: count", options.count, 1, LONGEST)
  return moving_average(expect.kind("moving_average: memory", memory or {}, "table"), { count = count })
end

local median = kind(function(self, value)
  expect.number("median: value", value)
  local sorted = table.move(remember(self.memory, value, self.count), 1, self.count, 1, {})
  table.sort(sorted)
  local middle = (#sorted + 1) // 2
  return #sorted % 2 == 1 and sorted[middle] or (sorted[middle] + sorted[middle + 1]) / 2
end)

--- The median of the last `count` values (1 to 1000), or of those that there are: what spikes can't move.
--- `update(value)`.
---@param options { count: integer }
---@param memory table?
---@return nezumi.Filter
function filters.median(options, memory)
  expect.fields("median", options, { "count" })
  local count = expect.whole("median: count", options.count, 1, LONGEST)
  return median(expect.kind("median: memory", memory or {}, "table"), { count = count })
end

local rate_limiter = kind(function(self, value, dt)
  expect.number("rate_limiter: value", value)
  expect.positive("rate_limiter: dt", dt)
  local memory = self.memory
  local before = memory.value or value
  memory.value = math.max(before - self.fall * dt, math.min(before + self.rise * dt, value))
  return memory.value
end)

--- Follows the value, by `rise` a second at most upwards and `fall` downwards, which is `rise` when it is left out.
--- `update(value, dt)`.
---@param options { rise: number, fall: number? }
---@param memory table?
---@return nezumi.Filter
function filters.rate_limiter(options, memory)
  expect.fields("rate_limiter", options, { "rise", "fall" })
  local rise = expect.positive("rate_limiter: rise", options.rise)
  local fall = expect.positive("rate_limiter: fall", options.fall or rise)
  return rate_limiter(expect.kind("rate_limiter: memory", memory or {}, "table"), { rise = rise, fall = fall })
end

local hysteresis = kind(function(self, value)
  expect.number("hysteresis: value", value)
  local memory = self.memory
  if value > self.high then
    memory.on = true
  elseif value < self.low then
    memory.on = false
  end
  return memory.on or false
end)

--- True from a value above `high` on, false from one below `low` on, as before in between. `update(value)`.
---@param options { low: number, high: number }
---@param memory table?
---@return nezumi.Filter
function filters.hysteresis(options, memory)
  expect.fields("hysteresis", options, { "low", "high" })
  local low = expect.number("hysteresis: low", options.low)
  local high = expect.number("hysteresis: high", options.high)
  if low > high then error(("hysteresis: low is %s, above high, %s"):format(low, high), 2) end
  return hysteresis(expect.kind("hysteresis: memory", memory or {}, "table"), { low = low, high = high })
end

local debounce = kind(function(self, value, dt)
  expect.kind("debounce: value", value, "boolean")
  expect.positive("debounce: dt", dt)
  local memory = self.memory
  if memory.value == nil then memory.value = value end
  memory.changed = value ~= memory.value and (memory.changed or 0) + dt or 0
  if memory.changed >= self.time then memory.value, memory.changed = value, 0 end
  return memory.value
end)

--- A boolean that changes only once its input has been another for `time` [s]. `update(value, dt)`.
---@param options { time: number }
---@param memory table?
---@return nezumi.Filter
function filters.debounce(options, memory)
  expect.fields("debounce", options, { "time" })
  local time = expect.positive("debounce: time", options.time)
  return debounce(expect.kind("debounce: memory", memory or {}, "table"), { time = time })
end

return filters
