-- Components that go to ERROR: they fail the scenario, unless it allows that.

--- A component that goes to ERROR fails the scenario.
-- file: behaviors/late.lua
param('at', 0.5)
function on_execute()
  if now() >= config.at - 1e-9 then error('no good') end
end

-- file: behaviors/dead.lua
function on_activated() error('never lived') end

-- file: behaviors/systems/two.lua
behavior 'fine' { script = 'none' }
behavior 'late' { script = 'late' }
robot 'mouse' { model = 'raspimouse' }

-- file: behaviors/systems/dead.lua
behavior 'it' { script = 'dead' }
behavior 'fine' { script = 'none' }

s:load 'systems/two.lua'
s:always('it is well', function() return s.late.status == 'ACTIVE' end)
s:run(10)  -- prints: [   0.500] error late: behaviors/late.lua:3: no good
-- failed: behaviors/late.lua:3: late went to ERROR: no good

--- A scenario continues after an allowed ERROR.
-- file: behaviors/late.lua
param('at', 0.5)
function on_execute()
  if now() >= config.at - 1e-9 then error('no good') end
end

-- file: behaviors/dead.lua
function on_activated() error('never lived') end

-- file: behaviors/systems/two.lua
behavior 'fine' { script = 'none' }
behavior 'late' { script = 'late' }
robot 'mouse' { model = 'raspimouse' }

-- file: behaviors/systems/dead.lua
behavior 'it' { script = 'dead' }
behavior 'fine' { script = 'none' }

s:load 'systems/two.lua' s:allow_error 'late'
s:run(1) s:check(s.late.status == 'ERROR', s.late.status)
s.late:reset() s.late.config.at = 2 s.late:activate() s:run(2) s:check(s.late.status == 'ERROR')
-- prints: [   0.500] error late: behaviors/late.lua:3: no good
-- prints: [   2.000] error late: behaviors/late.lua:3: no good

s:load 'systems/two.lua' s:allow_error(s.late)
s:run(1) s:check(s.late.status == 'ERROR', s.late.status)
s.late:reset() s.late.config.at = 2 s.late:activate() s:run(2) s:check(s.late.status == 'ERROR')
-- prints: [   0.500] error late: behaviors/late.lua:3: no good
-- prints: [   2.000] error late: behaviors/late.lua:3: no good

--- An ERROR is allowed for one component of one world.
-- file: behaviors/late.lua
param('at', 0.5)
function on_execute()
  if now() >= config.at - 1e-9 then error('no good') end
end

-- file: behaviors/dead.lua
function on_activated() error('never lived') end

-- file: behaviors/systems/two.lua
behavior 'fine' { script = 'none' }
behavior 'late' { script = 'late' }
robot 'mouse' { model = 'raspimouse' }

-- file: behaviors/systems/dead.lua
behavior 'it' { script = 'dead' }
behavior 'fine' { script = 'none' }

s:load 'systems/two.lua' s:allow_error 'fine' s:run(1)  -- prints: [   0.500] error late: behaviors/late.lua:3: no good
-- failed: behaviors/late.lua:3: late went to ERROR: no good

s:load 'systems/two.lua' s:allow_error 'late' s:load 'systems/two.lua' s:run(1)
-- prints: [   0.500] error late: behaviors/late.lua:3: no good
-- prints: [   0.500] error late: behaviors/late.lua:3: no good
-- failed: behaviors/late.lua:3: late went to ERROR: no good

s:load 'systems/two.lua' s:allow_error 'lata'  -- error: allow_error: there is no component 'lata' (did you mean 'late'?)

--- A behaviour that can't be activated fails the scenario at its start.
-- file: behaviors/late.lua
param('at', 0.5)
function on_execute()
  if now() >= config.at - 1e-9 then error('no good') end
end

-- file: behaviors/dead.lua
function on_activated() error('never lived') end

-- file: behaviors/systems/two.lua
behavior 'fine' { script = 'none' }
behavior 'late' { script = 'late' }
robot 'mouse' { model = 'raspimouse' }

-- file: behaviors/systems/dead.lua
behavior 'it' { script = 'dead' }
behavior 'fine' { script = 'none' }

s:load 'systems/dead.lua'
s:run(1)  -- prints: [   0.000] error it: behaviors/dead.lua:1: never lived
-- failed: behaviors/dead.lua:1: it went to ERROR: never lived

s:load 'systems/dead.lua'
s:maintain('something', { hold = 1, within = 1 }, function() return false end)
-- prints: [   0.000] error it: behaviors/dead.lua:1: never lived
-- failed: behaviors/dead.lua:1: it went to ERROR: never lived

s:load 'systems/dead.lua'
s:eventually('something', { within = 1 }, function() return false end)
-- prints: [   0.000] error it: behaviors/dead.lua:1: never lived
-- failed: behaviors/dead.lua:1: it went to ERROR: never lived

s:load 'systems/dead.lua'  -- prints: [   0.000] error it: behaviors/dead.lua:1: never lived
-- failed: behaviors/dead.lua:1: it went to ERROR: never lived

s:load 'systems/dead.lua' s:allow_error 'it' s:run(1)  -- prints: [   0.000] error it: behaviors/dead.lua:1: never lived

--- A version that is rolled back does not count as ERROR.
-- file: behaviors/late.lua
param('at', 0.5)
function on_execute()
  if now() >= config.at - 1e-9 then error('no good') end
end

-- file: behaviors/dead.lua
function on_activated() error('never lived') end

-- file: behaviors/systems/two.lua
behavior 'fine' { script = 'none' }
behavior 'late' { script = 'late' }
robot 'mouse' { model = 'raspimouse' }

-- file: behaviors/systems/dead.lua
behavior 'it' { script = 'dead' }
behavior 'fine' { script = 'none' }

s:load 'systems/two.lua'
s:reload('fine', { text = "param('x', 1) function on_execute() error('no') end" })
s:run(0.3) s:check(s.fine.status == 'ACTIVE') s:check(s.fine.version == 1)
-- prints: [   0.000] info behaviors/none.lua: version 2 runs in fine
-- prints: [   0.010] error fine: version 2 failed in its execution 1 (of the first 10): behaviors/none.lua:1: no; back to version 1 in fine

--- A comparison in a condition reads the same values, and gives the same errors, as any other function.
-- file: behaviors/it.lua
param('count', 3)
param('label', 'a')
local out = output('out', 'TimedVelocity2D', 'a velocity')
function on_execute() out:write { vx = 0.125 } end

-- file: behaviors/systems/it.lua
behavior 'it' { script = 'it' }
robot 'mouse' { model = 'raspimouse' }

local world = s:load 'systems/it.lua'
local it, mouse, plain = world.it, world.mouse, { at = { x = 2 } }
s:run(0.1)
s:always('whole', function() return math.type(it.config.count) == 'integer' and it.config.count == 3 end)
s:always('texts', function() return world.it.config.label == 'a' and it.status == 'ACTIVE' end)
s:always('numbers', function() return it.out.value.vx == 0.125 and world.mouse.truth.pose.heading < 1 end)
s:always('no', function() return mouse.collided == false and it.error == nil and plain.at.x == 2 end)
s:always('inner', function() local near = world.mouse return near.truth.pose.position.x < 1 end)
s:run(0.1)

local world = s:load 'systems/it.lua'
s:always('it', function() return world.mouse.truth.pose.x < 1 end)  -- failed: always 'it': 'mouse.truth.pose' has no field 'x' (its fields are heading, position)
s:run(0.1)

local world = s:load 'systems/it.lua'
s:always('it', function() return world.nobody.truth.pose.heading < 1 end)  -- failed: always 'it': there is no component 'nobody'
s:run(0.1)

local world = s:load 'systems/it.lua'
s:always('it', function() return world.it.config.nothing.more < 1 end)  -- failed: always 'it': it: unknown parameter 'nothing'
s:run(0.1)

local world = s:load 'systems/it.lua'
s:always('it', function() return world.it.out.vx < 1 end)  -- failed: always 'it': it.out has no 'vx'; the value's own fields are it.out.value.NAME
s:run(0.1)

local plain = {}
s:load 'systems/it.lua'
s:always('it', function() return plain.at.x < 1 end)  -- failed: always 'it': attempt to index a nil value (field 'at')
s:run(0.1)
