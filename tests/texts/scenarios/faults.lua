-- Faults in scenarios: pushes and buttons.

--- A hold works again after a fault of the same port.
local w = s:load 'systems/stop_at_wall.lua'
local p = 'mouse.ir_sensor_out'
local port = w.mouse.ports.ir_sensor_out
local function is(what) s:check(port.override == what, 'it is ' .. port.override .. ', not ' .. what) end
s:hold(p, { 1, 2, 3, 4 })
s:run(0.1) is 'held'
s:drop(p, 0.5)
s:run(0.5) is 'dropped'
s:run(0.1) is 'held'
s:check(port.value[1] == 1 and port.value[4] == 4)
s:drop(p, 0.2) s:run(0.3) is 'held'
s:drop(p, 0.5) s:run(0.1) s:restore(w.mouse) is 'held'
s:drop(p, 0.5) s:run(0.1) s:restore(p) is ''
s:run(1) is ''

local w = s:load 'systems/stop_at_wall.lua'
local p = 'mouse.ir_sensor_out'
local port = w.mouse.ports.ir_sensor_out
local function is(what) s:check(port.override == what, 'it is ' .. port.override .. ', not ' .. what) end
s:hold(p, { 1, 2, 3, 4 })
s:run(0.1) is 'held'
s:freeze(p, 0.5)
s:run(0.5) is 'frozen'
s:run(0.1) is 'held'
s:check(port.value[1] == 1 and port.value[4] == 4)
s:freeze(p, 0.2) s:run(0.3) is 'held'
s:freeze(p, 0.5) s:run(0.1) s:restore(w.mouse) is 'held'
s:freeze(p, 0.5) s:run(0.1) s:restore(p) is ''
s:run(1) is ''

--- What replaces a fault stays after the time of the fault.
local w = s:load 'systems/stop_at_wall.lua'
local p = 'mouse.ir_sensor_out'
local port = w.mouse.ports.ir_sensor_out
local function is(what) s:check(port.override == what, 'it is ' .. port.override .. ', not ' .. what) end
s:hold(p, { 1, 2, 3, 4 }) s:drop(p, 0.5)
s:hold(p, { 5, 6, 7, 8 })
s:run(1) is 'held' s:check(port.value[1] == 5)
s:freeze(p, 0.1) s:run(0.2) is 'held' s:check(port.value[1] == 5)
s:drop(p, 0.5) port:release() s:freeze(p, 0.1) s:run(1) is ''
s:drop(p, 0.2) s:freeze(p) s:run(1) is 'frozen'

--- A lasting fault works again after a short fault of the same port.
local w = s:load 'systems/stop_at_wall.lua'
local p = 'mouse.ir_sensor_out'
local port = w.mouse.ports.ir_sensor_out
local function is(what) s:check(port.override == what, 'it is ' .. port.override .. ', not ' .. what) end
s:freeze(p) s:run(0.1)
local value = port.value[2]
s:drop(p, 0.2) s:run(0.2) is 'dropped'
s:run(0.1) is 'frozen' s:check(port.value[2] == value)
s:drop(p) s:freeze(p, 0.1) s:run(0.1) is 'frozen' s:run(0.1) is 'dropped'
s:drop(p, 0.3) s:freeze(p, 0.1) s:run(0.2) is 'dropped'
s:run(0.2) is 'dropped' s:restore(p) is ''

--- release ends a hold, but no fault.
local w = s:load 'systems/stop_at_wall.lua'
local p = 'mouse.ir_sensor_out'
local port = w.mouse.ports.ir_sensor_out
local function is(what) s:check(port.override == what, 'it is ' .. port.override .. ', not ' .. what) end
s:hold(p, { 1, 2, 3, 4 }) s:drop(p, 0.5)
s:run(0.1) s:release(p) is 'dropped'
s:run(0.5) is ''
s:release(p)
s:hold(p, { 1, 2, 3, 4 }) s:release(p) is ''

local w = s:load 'systems/stop_at_wall.lua'
local p = 'mouse.ir_sensor_out'
local port = w.mouse.ports.ir_sensor_out
local function is(what) s:check(port.override == what, 'it is ' .. port.override .. ', not ' .. what) end
s:drop(p) s:release(p)  -- error: release: mouse.ir_sensor_out is dropped, not held: to end that, use s:restore

local w = s:load 'systems/stop_at_wall.lua'
local p = 'mouse.ir_sensor_out'
local port = w.mouse.ports.ir_sensor_out
local function is(what) s:check(port.override == what, 'it is ' .. port.override .. ', not ' .. what) end
s:freeze(p, 1) s:release(p)  -- error: release: mouse.ir_sensor_out is frozen, not held: to end that, use s:restore

--- A lasting push continues after a short one.
local w = s:load 'systems/stop_at_wall.lua'
w.controller:deactivate()
local m = s.mouse
s:disturb(m, { vx = 0.1 })
s:disturb(m, { va = 1, seconds = 0.3 })
s:run(0.3) s:near(m.truth.velocity.va, 1, 0.01)
s:run(0.2) s:near(m.truth.velocity.vx, 0.1, 0.01)
s:restore(m) s:run(0.5) s:near(m.truth.velocity.vx, 0, 0.01)

--- A button that is held stays pressed after a timed press.
local w = s:load 'systems/stop_at_wall.lua'
local function down() return w.mouse.switch3bit_out.value[1] end
s:press('mouse', 'switch0') s:press('mouse', 'switch0', 0.2)
s:run(0.1) local pressed = down()
s:run(1) s:check(down() == pressed)
s:restore('mouse') s:run(0.1) s:check(down() ~= pressed)
