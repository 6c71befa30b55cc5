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
