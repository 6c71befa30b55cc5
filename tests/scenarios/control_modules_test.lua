--- The modules for control: angles, pid, filters, state_machine, and what they say of arguments that are wrong.

local angles = require "nezumi.angles"
local filters = require "nezumi.filters"
local pid = require "nezumi.pid"
local state_machine = require "nezumi.state_machine"

--- What a call says when it fails, with its line, which is to be one of this file.
local function said(f)
  local ok, message = pcall(f)
  local file, text = tostring(message):match("^(.-):%d+: (.*)$")
  return not ok and file and file:match("control_modules_test%.lua$") and text or "not refused here: " .. tostring(message)
end

local function equal(s, actual, expected) s:check(actual == expected, ("%s, not %s"):format(actual, expected)) end

scenario("angles wrap into one turn, pi itself stays", function(s)
  for _, case in ipairs { { 0, 0 }, { math.pi, math.pi }, { -math.pi, math.pi }, { 3 * math.pi, math.pi }, { 7, 7 - 2 * math.pi },
    { -7, 2 * math.pi - 7 }, { 1e-9, 1e-9 }, { -1e-20, 0 }, { 200 * math.pi + 1, 1 } } do
    s:near(angles.wrap(case[1]), case[2], 1e-12)
  end
  s:near(angles.difference(3, -3), 2 * math.pi - 6, 1e-12, "across the seam")
  s:near(angles.difference(-3, 3), 6 - 2 * math.pi, 1e-12)
  s:near(angles.difference(0.25, 1), 0.75, 1e-12)
end)

scenario("a mean of angles works across pi, and is nil if the angles cancel out", function(s)
  s:near(math.abs(angles.mean { math.pi - 0.1, -math.pi + 0.1 }), math.pi, 1e-12)
  s:near(angles.mean { 0.2, 0.4 }, 0.3, 1e-12)
  s:near(angles.mean { 2 }, 2, 1e-12)
  s:check(angles.mean { 0, math.pi } == nil)
  s:check(angles.mean { 0, math.pi - 1.5e-9 } == nil, "where nearly nothing is left")
  s:near(angles.mean { 0, math.pi - 3e-9 }, math.pi / 2, 1e-6)
  s:near(angles.mean { math.pi / 2, math.pi / 2 }, math.pi / 2, 1e-12)
end)

scenario("a value that is not an angle is refused", function(s)
  equal(s, said(function() angles.wrap("1") end), "angles.wrap: angle expected a finite number, got string")
  equal(s, said(function() angles.wrap(0 / 0) end), "angles.wrap: angle expected a finite number, got nan")
  equal(s, said(function() angles.difference(1) end), "angles.difference: to expected a finite number, got nothing")
  equal(s, said(function() angles.difference(nil, 1) end), "angles.difference: from expected a finite number, got nothing")
  equal(s, said(function() angles.mean(1) end), "angles.mean: list expected a table, got 1")
  equal(s, said(function() angles.mean {} end),
    ("angles.mean: the length of the list expected a whole number from 1 to %d, got 0"):format(math.maxinteger))
  equal(s, said(function() angles.mean { 1, math.huge } end), "angles.mean: angle 2 expected a finite number, got inf")
end)

scenario("a PID controller has its three parts", function(s)
  s:near(pid { kp = 2 }:update(3, 1, 0.1), 4, 1e-12)
  local integral = pid { ki = 0.5 }
  s:near(integral:update(1, 0, 0.1), 0.05, 1e-12)
  s:near(integral:update(1, 0, 0.2), 0.15, 1e-12)
  local derivative = pid { kd = 0.5 }
  s:near(derivative:update(0, 1, 0.1), 0, 1e-12, "nothing was measured before")
  s:near(derivative:update(0, 1.2, 0.1), -1, 1e-12)
  s:near(derivative:update(100, 1.2, 0.1), 0, 1e-12, "a new setpoint makes no kick")
  derivative:reset()
  s:near(derivative:update(0, 5, 0.1), 0, 1e-12)
end)

scenario("a PID controller that was held at a limit leaves it at once", function(s)
  local limited = pid { kp = 1, ki = 1, min = -1, max = 1 }
  for _ = 1, 1000 do s:near(limited:update(10, 0, 0.1), 1, 1e-12) end
  s:check(limited:update(10, 10.5, 0.1) < 0, "nothing has wound up")
  for _ = 1, 1000 do limited:update(-10, 0, 0.1) end
  local slow = pid { kp = 1, ki = 0.01, min = -1, max = 1 }
  for _ = 1, 1000 do slow:update(10, 0, 0.1) end
  s:check(slow:update(10, 10.5, 0.1) < 0)
  s:check(limited:update(-10, -10.5, 0.1) > 0)
end)

scenario("a PID controller of an angle turns the short way round", function(s)
  local heading = pid { kp = 1, kd = 1, angle = true }
  s:near(heading:update(3, -3, 0.1), 6 - 2 * math.pi, 1e-12)
  s:near(heading:update(3, 3.2 - 2 * math.pi, 0.1), -0.2 - (0.2 - (2 * math.pi - 6)) / 0.1 - 0, 1e-9)
end)

scenario("the derivative of a PID controller can be smoothed, and the loop settles", function(s)
  local smooth = pid { kd = 1, derivative_time = 0.1 }
  smooth:update(0, 0, 0.1)
  s:near(smooth:update(0, 1, 0.1), -10 * (1 - math.exp(-1)), 1e-12)
  -- A mass with friction: x'' = u - x'.
  local loop, x, v = pid { kp = 20, ki = 5, kd = 8, min = -10, max = 10 }, 0, 0
  for _ = 1, 2000 do
    v = v + (loop:update(1, x, 0.01) - v + 0.5) * 0.01
    x = x + v * 0.01
  end
  s:near(x, 1, 1e-3, "in spite of a constant force")
end)

scenario("the memory of a PID controller is plain data in the given table", function(s)
  local memory = {}
  local one = pid({ ki = 1 }, memory)
  one:update(1, 0, 0.5)
  s:near(memory.integral, 0.5, 1e-12)
  s:near(pid({ ki = 1 }, memory):update(1, 0, 0.5), 1, 1e-12)
end)

scenario("wrong options and arguments of a PID controller are refused", function(s)
  equal(s, said(function() pid { kpp = 1 } end), "pid has no 'kpp': it has kp, ki, kd, min, max, angle, derivative_time")
  equal(s, said(function() pid() end), "pid expected a table, got nothing")
  equal(s, said(function() pid { kp = "1" } end), "pid: kp expected a finite number, got string")
  equal(s, said(function() pid { min = 1, max = 0 } end), "pid: min and max expected numbers, min not above max")
  equal(s, said(function() pid({}, 3) end), "pid: memory expected a table, got 3")
  equal(s, said(function() pid { kp = 1 }:update(1, nil, 0.1) end), "pid: measured expected a finite number, got nothing")
  equal(s, said(function() pid { kp = 1 }:update({}, 1, 0.1) end), "pid: setpoint expected a finite number, got table")
  equal(s, said(function() pid { kp = 1 }:update(1, 1, 0) end), "pid: dt expected a number above 0, got 0")
end)

scenario("a low pass lets 63 % of a step through in its time constant, for any period", function(s)
  for _, dt in ipairs { 0.5, 0.05, 0.001 } do
    local filter = filters.low_pass { time = 0.5 }
    s:near(filter:update(2, dt), 2, 1e-12, "it begins with its first value")
    local value
    for _ = 1, math.floor(0.5 / dt + 0.5) do value = filter:update(3, dt) end
    s:near(value, 3 - math.exp(-1), 1e-9)
  end
end)

scenario("averages and medians are of the last values", function(s)
  local average, median = filters.moving_average { count = 3 }, filters.median { count = 3 }
  local averages, medians = {}, {}
  for i, value in ipairs { 1, 3, 100, 2, 4 } do averages[i], medians[i] = average:update(value), median:update(value) end
  for i, expected in ipairs { 1, 2, 104 / 3, 35, 106 / 3 } do s:near(averages[i], expected, 1e-12) end
  for i, expected in ipairs { 1, 2, 3, 3, 4 } do s:near(medians[i], expected, 1e-12) end
  average:reset()
  s:near(average:update(7), 7, 1e-12)
  s:near(filters.median { count = 1 }:update(-3), -3, 1e-12)
end)

scenario("a rate limiter has a rate for each direction", function(s)
  local filter = filters.rate_limiter { rise = 1, fall = 4 }
  s:near(filter:update(5, 0.1), 5, 1e-12)
  s:near(filter:update(9, 0.1), 5.1, 1e-12)
  s:near(filter:update(0, 0.1), 4.7, 1e-12)
  s:near(filter:update(4.6, 0.1), 4.6, 1e-12)
  local same = filters.rate_limiter { rise = 2 }
  same:update(0, 1)
  s:near(same:update(-9, 1), -2, 1e-12)
end)

scenario("a hysteresis changes beyond its thresholds only, a bounce changes nothing", function(s)
  local filter = filters.hysteresis { low = 1, high = 2 }
  for _, case in ipairs { { 1.5, false }, { 2, false }, { 2.1, true }, { 1, true }, { 0.9, false }, { 2, false } } do
    s:check(filter:update(case[1]) == case[2], "at " .. case[1])
  end
  local debounce = filters.debounce { time = 0.025 }
  local input = { false, true, false, true, true, true, true, false, true, false, false, false }
  local expected = { false, false, false, false, false, true, true, true, true, true, true, false }
  for i, value in ipairs(input) do s:check(debounce:update(value, 0.01) == expected[i], "at step " .. i) end
  s:check(debounce:update(true, 0.01) == false, "it has changed just now")
  local slow = filters.debounce { time = 2 }
  for i, value in ipairs { true, true, false, false, true, false } do s:check(slow:update(value, 0.9), "at step " .. i) end
end)

scenario("the memory of a filter outlives the filter", function(s)
  local function goes_on(name, options, first, second, expected)
    local memory = {}
    filters[name](options, memory):update(first, 0.1)
    local value = filters[name](options, memory):update(second, 0.1)
    if type(expected) == "number" then s:near(value, expected, 1e-12, name) else s:check(value == expected, name) end
  end
  goes_on("low_pass", { time = 0.1 }, 2, 3, 3 - math.exp(-1))
  goes_on("moving_average", { count = 2 }, 4, 6, 5)
  goes_on("median", { count = 2 }, 4, 7, 5.5)
  goes_on("rate_limiter", { rise = 1 }, 4, 6, 4.1)
  goes_on("hysteresis", { low = 1, high = 2 }, 3, 1.5, true)
  goes_on("debounce", { time = 0.2 }, true, false, true)
  s:check(filters.debounce({ time = 0.2 }, { value = true }):update(false, 0.15), "it may begin with a value")
end)

scenario("wrong options and arguments of a filter are refused", function(s)
  local good = {
    low_pass = { time = 1 }, moving_average = { count = 1 }, median = { count = 1 }, rate_limiter = { rise = 1 },
    hysteresis = { low = 1, high = 2 }, debounce = { time = 1 },
  }
  local has = {
    low_pass = "time", moving_average = "count", median = "count", rate_limiter = "rise, fall", hysteresis = "low, high",
    debounce = "time",
  }
  for name, options in pairs(good) do
    local make = filters[name]
    equal(s, said(function() make { tau = 1 } end), ("%s has no 'tau': it has %s"):format(name, has[name]))
    equal(s, said(function() make(options, 1) end), name .. ": memory expected a table, got 1")
    local expected = name == "debounce" and "boolean" or "finite number"
    equal(s, said(function() make(options):update({}, 1) end), ("%s: value expected a %s, got table"):format(name, expected))
  end
  for _, name in ipairs { "low_pass", "rate_limiter", "debounce" } do
    local value = name ~= "debounce" and 1
    equal(s, said(function() filters[name](good[name]):update(value) end), name .. ": dt expected a number above 0, got nothing")
  end
  equal(s, said(function() filters.low_pass { time = 0 } end), "low_pass: time expected a number above 0, got 0")
  equal(s, said(function() filters.debounce { time = 0 } end), "debounce: time expected a number above 0, got 0")
  equal(s, said(function() filters.rate_limiter { rise = 0 } end), "rate_limiter: rise expected a number above 0, got 0")
  equal(s, said(function() filters.rate_limiter { rise = 1, fall = 0 } end), "rate_limiter: fall expected a number above 0, got 0")
  equal(s, said(function() filters.hysteresis { low = 1 } end), "hysteresis: high expected a finite number, got nothing")
  equal(s, said(function() filters.hysteresis { low = 2, high = 1 } end), "hysteresis: low is 2, above high, 1")
  for _, name in ipairs { "median", "moving_average" } do
    for _, count in ipairs { 0, 2.5, 1001 } do
      equal(s, said(function() filters[name] { count = count } end),
        ("%s: count expected a whole number from 1 to 1000, got %s"):format(name, count))
    end
    filters[name] { count = 1000 }
  end
end)

--- A machine of two states that notes what is called.
local function two_states(memory, notes)
  local function note(text) return function() notes[#notes + 1] = text end end
  return state_machine({
    initial = "wait",
    states = {
      wait = function(seconds) return seconds >= 0.2 and "go" or nil end,
      go = {
        enter = note "enter go",
        execute = function(seconds)
          notes[#notes + 1] = ("go for %.2f"):format(seconds)
          return seconds >= 0.1 and "wait" or nil
        end,
        exit = note "exit go",
      },
    },
  }, memory)
end

scenario("a state machine enters, executes and leaves its states", function(s)
  local memory, notes = {}, {}
  local machine = two_states(memory, notes)
  s:check(machine:current() == nil)
  local seen = {}
  for i = 0, 5 do seen[#seen + 1] = machine:update(1 + i * 0.1001) end
  equal(s, table.concat(seen, " "), "wait wait go wait wait go")
  equal(s, table.concat(notes, ", "), "enter go, go for 0.10, exit go, enter go")
  equal(s, memory.current, "go")
  equal(s, memory.previous, "wait")
  equal(s, memory.changes, 4)
  s:near(memory.since, 1.5005, 1e-9)
end)

scenario("a state machine goes on where its memory stands, and begins again where that state is gone", function(s)
  local memory, notes = {}, {}
  two_states(memory, notes):go("go", 5)
  equal(s, two_states(memory, notes):update(5.05), "go")
  equal(s, table.concat(notes, ", "), "enter go, go for 0.05")
  local other = state_machine({ initial = "rest", states = { rest = {} } }, memory)
  equal(s, other:update(6), "rest")
  equal(s, memory.previous, "go")
end)

scenario("a state machine that is sent elsewhere leaves its state first", function(s)
  local memory, notes = {}, {}
  local machine = two_states(memory, notes)
  machine:go("go", 5)
  machine:go("wait", 5.5)
  equal(s, table.concat(notes, ", "), "enter go, exit go")
  s:equal(memory, { current = "wait", previous = "go", since = 5.5, changes = 2 })
  s:equal(machine:current(), "wait")
end)

scenario("a state machine says which states there are", function(s)
  equal(s, said(function() state_machine { initial = "a", states = { b = {} } } end),
    "state_machine: initial is 'a', which is not a state: there are b")
  equal(s, said(function() state_machine { first = "a" } end), "state_machine has no 'first': it has initial, states")
  equal(s, said(function() state_machine { initial = "a" } end), "state_machine: states expected a table, got nothing")
  equal(s, said(function() state_machine { initial = 1, states = { {} } } end),
    "state_machine: the name of a state expected a string, got 1")
  equal(s, said(function() state_machine({ initial = "a", states = { a = {} } }, 1) end),
    "state_machine: memory expected a table, got 1")
  equal(s, said(function() state_machine { initial = "a", states = { a = { run = 1 } } } end),
    "state_machine: state 'a' has no 'run': it has enter, execute, exit")
  equal(s, said(function() state_machine { initial = "a", states = { a = { enter = 1 } } } end),
    "state_machine: enter of 'a' expected a function, got 1")
  local machine = state_machine { initial = "a", states = { a = function() return "c" end, b = {} } }
  equal(s, said(function() machine:update(0) end), "state_machine: 'a' went to 'c', which is not a state: there are a, b")
  equal(s, said(function() machine:go("d", 0) end), "state_machine: there is no state 'd': there are a, b")
  equal(s, said(function() machine:update() end), "state_machine: now expected a finite number, got nothing")
  equal(s, said(function() machine:go "a" end), "state_machine: now expected a finite number, got nothing")
end)
