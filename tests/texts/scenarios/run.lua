-- One run of a scenario: time, outcomes, and the message of each way to end.

--- Time passes only in s:run and while waiting.
s:load 'systems/stop_at_wall.lua'
s:check(s:now() == 0) s:run(1.5) s:near(s:now(), 1.5, 1e-9)
s:run(0.005) s:near(s:now(), 1.5, 1e-9) s:run(0.005) s:near(s:now(), 1.51, 1e-9)
s:wait_until('so already', { within = 0 }, function() return true end)
s:near(s:now(), 1.51, 1e-9)
s:maintain('a second', { hold = 1, within = 0 }, function() return true end)
s:near(s:now(), 2.51, 1e-9)

--- Conditions are evaluated after every tick.
s:load 'systems/stop_at_wall.lua'
local looks = 0
s:always('counts', function() looks = looks + 1; return true end)
s:check(looks == 0) s:run(1) s:check(looks == 100, tostring(looks))

--- A condition without a later tick is evaluated once, at the end.
s:load 'systems/stop_at_wall.lua'
s:run(1) s:always('no', function() return false end)  -- failed: always 'no' did not hold at its first sample, at 1.00 s

s:load 'systems/stop_at_wall.lua'
s:never('yes', function() return true end)  -- failed: never 'yes' happened at 0.00 s

s:load 'systems/stop_at_wall.lua'
s:always('yes', function() return s:now() == 0 end)

--- A scenario can't declare another scenario.
do scenario('inner', function() end) end  -- error: scenario: a scenario can't declare another scenario: declare it at the top level of the file

--- A condition reads the ports of the version that runs.
local it = s:behavior('it', { script = 'robot_controller' })
for version, type in ipairs { 'TimedDouble', 'TimedLong', 'TimedFloat' } do
  s:reload('it', { text = ("local out = output('out', '%s') function on_execute() out:write(%d) end"):format(type, version) })
  s:run(0.1)
  if version == 1 then s:always('small', function() return it.out.value < 3 end) end
  -- failed: always 'small' held until 0.20 s and failed at 0.21 s
end
-- prints: [   0.000] info behaviors/robot_controller.lua: version 2 runs in it
-- prints: [   0.000] warn it.in was removed; it was not connected
-- prints: [   0.000] warn it.out is TimedDouble now, not TimedVelocity2D; it was not connected
-- prints: [   0.100] info behaviors/robot_controller.lua: version 3 runs in it
-- prints: [   0.100] warn it.out is TimedLong now, not TimedDouble; it was not connected
-- prints: [   0.200] info behaviors/robot_controller.lua: version 4 runs in it
-- prints: [   0.200] warn it.out is TimedFloat now, not TimedLong; it was not connected

--- A violated always ends the scenario at once, and pcall can't catch it.
s:load 'systems/stop_at_wall.lua'
s:always('rests', function() return s:now() < 0.5 end)  -- failed: always 'rests' held until 0.49 s and failed at 0.50 s
pcall(function() coroutine.wrap(function() pcall(s.run, s, 1) end)() end)
while true do pcall(error) end

--- A scenario that takes longer than its timeout fails.
scenario('it', { timeout = 2 }, function(s)
  s:load 'systems/stop_at_wall.lua'
  s:run(2)
  s:wait_until('more', function() return false end)
-- failed: timeout: the scenario takes longer than 2.00 s of simulated time; wait_until 'more' had not happened since 2.00 s
end)

--- An endless loop is an error at its line.
while true do end  -- error: ran for more than 2 s: is there an endless loop?

s:load 'systems/stop_at_wall.lua'
s:always('it', function()
 while true do end end)  -- error: always 'it': ran for more than 2 s: is there an endless loop?
pcall(s.run, s, 1)

--- The time of worlds and conditions does not count for the scenario's own budget.
s:load 'systems/stop_at_wall.lua'
s:always('slow', function() for i = 1, 3000000 do end return true end)
s:run(1)

--- Errors of a scenario give its line.
error('so')  -- failed: so

local w = s:load 'systems/stop_at_wall.lua'
return w.mouze  -- failed: there is no component 'mouze' (did you mean 'mouse'?)

s:load 'systems/stop_at_wall.lua'
local it = s.rum  -- error: s has no 'rum' (did you mean 'run'?)

s:run(1)  -- error: s.run: there is no world yet: s:load a system, or use s:robot, s:behavior ...

s:load 'systems/stop_at_wall.lua'
s.run(1)  -- error: write s:run(...) with a colon

s:load 'systems/stop_at_wall.lua'
s:run(-1)  -- error: run: expected seconds from 0 on, got -1

s:check(1 == 2, 'no')  -- failed: check failed: no

s:check(1 == 2, 'n\0o')  -- failed: check failed: n?o

s:near(1, 2, 0.5, 'n\0o')  -- failed: near failed: 1 is off 2 by 1, more than the tolerance of 0.5: n?o

s:near(1, 2, 0.5)  -- failed: near failed: 1 is off 2 by 1, more than the tolerance of 0.5

s:near(0/0, 2, 0.5, 'speed')  -- failed: near failed: the actual value is not a number: speed

s:near(1, 0/0, 0.5)  -- failed: near failed: the expected value is not a number

s:near(1/0, 1/0, 0)

s:near(1/0, -1/0, 0)  -- failed: near failed: inf is off -inf by inf, more than the tolerance of 0

--- Options of an expectation are checked.
s:load 'systems/stop_at_wall.lua'
s:maintain('m', { within = 1 }, function() return true end)
-- error: maintain: 'm': option 'hold' is missing: expected a number from 0 on in s: how long the condition must stay true

s:load 'systems/stop_at_wall.lua'
s:eventually('e', { witin = 1 }, function() return true end)
-- error: eventually: 'e': unknown option 'witin' (did you mean 'within'?)

s:load 'systems/stop_at_wall.lua'
s:eventually('e', { within = 'x' }, function() return true end)
-- error: eventually: 'e': option 'within' expected a number from 0 on, got string

s:load 'systems/stop_at_wall.lua'
s:always('a', { within = 1 }, function() return true end)
-- error: always: 'a': unknown option 'within': expected no options

s:load 'systems/stop_at_wall.lua'
s:always('a', true)  -- error: always: 'a': expected options (a table) or a function, got boolean

s:load 'systems/stop_at_wall.lua'
s:always(function() return true end)  -- error: always: expected a name (what should hold), got function

--- A system that can't be built is an error, unless the scenario expects it.
s:load 'no_such'
-- error: load: there is no system file 'no_such'; looked for no_such.lua, behaviors/systems/no_such.lua, behaviors/no_such.lua, behaviors/systems/no_such.lua, behaviors/no_such.lua

-- The name of the model is wrong.
s:robot 'mouse' { model = 'raspimous' }
--                ^ error: robot 'mouse': there is no robot model 'raspimous' (did you mean 'raspimouse'?); looked for raspimous.lua, behaviors/raspimous.lua, engine/robots/raspimous.lua, behaviors/raspimous.lua
s:run(1)

s:robot 'mouse' { model = 'raspimouse' }
s:connect('mouse.nothing', 'mouse.target_velocity_in')
-- error: mouse has no out-port 'nothing'; it has current_pose_out, current_velocity_out, ir_sensor_metre_out, ir_sensor_out, switch3bit_out
s:run(1)

s:check(not pcall(s.load, s, 'no_such'))

--- Robots can be added to a running world, an arena only before time passes.
local w = s:load 'systems/stop_at_wall.lua'
w.controller.config.speed_x = 0.3
s:arena { s:box { at = { 0.4, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }
s:run(0.2) s:near(w.controller.out.value.vx, 0.3, 0)
s:robot 'second' { model = 'raspimouse', pose = { y = 1 } }
s:connect('controller.out', 'second.target_velocity_in')
s:run(9)
s:check(w.mouse.truth.pose.position.x < 0.35) s:check(s.second.truth.pose.position.x > 0.01)

s:load 'systems/stop_at_wall.lua'
s:run(1)
s:arena { s:box { at = { 0.4, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }
-- error: arena: can't change after time has passed: call it before s:run and all methods that wait
s:run(1)

--- s:robot and s:behavior return the component.
local mouse = s:robot 'mouse' { model = 'raspimouse' }
local driver = s:behavior('driver', { script = 'robot_controller', config = { speed_x = 0.1 } })
s:connect('driver.out', 'mouse.target_velocity_in')
s:run(1)
s:check(mouse == s.mouse and driver == s.world.driver)
s:near(driver.out.value.vx, 0.1, 0)
s:check(mouse.truth.pose.position.x > 0.05)
s:reload(driver, { text = 'function on_execute() end' }) s:check(driver.version == 2)
-- prints: [   1.000] warn driver: parameter 'speed_x' and its value 0.1 were removed
-- prints: [   1.000] info behaviors/robot_controller.lua: version 2 runs in driver
-- prints: [   1.000] warn driver.in was removed; it was not connected
-- prints: [   1.000] warn driver.out was removed; it was connected to mouse.target_velocity_in

local mouse = s:robot 'mouse' { model = 'raspimouse', pose = { y = 1 } }
s:near(mouse.truth.pose.position.y, 1, 1e-9)

local second = s:robot 'second' { model = 'raspimouse', pose = { y = 1 } }
local world = s:load 'systems/stop_at_wall.lua'
local third = s:robot 'third' { model = 'raspimouse', pose = { y = -1 } }
s:check(second == world.second and third == world.third and second ~= third)
local other = s:load 'systems/stop_at_wall.lua'
s:check(second == world.second and not pcall(function() return other.second end))

--- s:connect accepts ports and their names.
s:robot 'mouse' { model = 'raspimouse' }
s:behavior('driver', { script = 'robot_controller', config = { speed_x = 0.1 } })
s:connect(s.driver.out, s.mouse.target_velocity_in)
s:run(1)
s:check(s.mouse.truth.pose.position.x > 0.05)

s:robot 'mouse' { model = 'raspimouse' }
s:behavior('driver', { script = 'robot_controller', config = { speed_x = 0.1 } })
s:connect(s.driver.out, s.mouse)  -- error: connect: expected "name.port", got userdata
s:run(1)

local first = s:load 'systems/stop_at_wall.lua'
s:load 'systems/stop_at_wall.lua'
s:connect(first.controller.out, first.mouse.target_velocity_in)
-- error: connect: controller.out belongs to another world: functions like s:behavior add only to the world that was loaded last

--- s:rate and s:physics are accepted until time passes.
s:robot 'mouse' { model = 'raspimouse' }
s:near(s.mouse.truth.pose.position.x, 0, 1) s:rate(50)
s:run(0.1) s:near(s.mouse.ir_sensor_out.count, 5, 1)

s:robot 'mouse' { model = 'raspimouse' }
s:run(0.1)
s:rate(50)  -- error: rate: can't change after time has passed: call it before s:run and all methods that wait
s:run(0.1)

s:robot 'mouse' { model = 'raspimouse' }
s:run(0.1)
s:physics { step = 0.01 }  -- error: physics: can't change after time has passed: call it before s:run and all methods that wait
s:run(0.1)

--- A robot that must be calibrated needs a calibration.
s:robot 'r' { model = 'raspimouse', calibrated = true }
-- error: robot 'r': calibrated = true, and there is no r.calibration.lua: make it by nezumi calibrate
s:run(0.1)

s:load 'systems/stop_at_wall.lua' s:run(0.1)
s:robot 'r' { model = 'raspimouse', pose = { y = 1 }, calibrated = true }
-- error: robot 'r': calibrated = true, and there is no behaviors/systems/r.calibration.lua: make it by nezumi calibrate
s:run(0.1)

--- The message of a check must be a text.
s:check(true, {})  -- error: check: expected a message (a string), got table

s:check(1 == 2, 3.5)  -- failed: check failed: 3.5

s:near(1, 1, 1, {})  -- error: near: expected a message (a string), got table

--- A component of a world that can't be built gives the reason.
local mouse = s:robot 'mouse' { model = 'raspimouse' }
s:connect('mouse.nothing', 'mouse.target_velocity_in')
-- error: mouse has no out-port 'nothing'; it has current_pose_out, current_velocity_out, ir_sensor_metre_out, ir_sensor_out, switch3bit_out
return mouse.truth

local begun = s:robot 'mouse'
s:load 'systems/stop_at_wall.lua'
begun { model = 'raspimouse' }  -- error: this table comes too late: its name was given to an earlier world

--- A condition can't let time pass.
s:load 'systems/stop_at_wall.lua'
s:always('a', function() s:run(0.1) return true end)
-- error: always 'a': run: a condition can only read values: only the scenario itself can advance time or add expectations
s:run(1)

s:load 'systems/stop_at_wall.lua'
s:always('a', function() s:always('b', function() return true end) return true end)
-- error: always 'a': always: a condition can only read values: only the scenario itself can advance time or add expectations
s:run(1)

s:load 'systems/stop_at_wall.lua'
s:always('a', function() s:check(s:now() < 0.05, 'late') return true end)  -- failed: check failed: late
s:run(1)

--- Time passes also in coroutines, protected calls and table.sort.
s:load 'systems/stop_at_wall.lua'
local step = coroutine.wrap(function() s:run(0.5) coroutine.yield() s:run(0.5) end)
step() step() pcall(s.run, s, 1)
table.sort({ 2, 1 }, function(a, b) s:run(0.5) return a < b end)
s:check(s:now() >= 2.5, tostring(s:now()))
