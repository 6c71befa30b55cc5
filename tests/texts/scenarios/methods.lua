-- Methods of scenarios: what they refuse.

--- Wrong arguments of faults and reloads are refused.
s:load 'systems/stop_at_wall.lua'
s:disturb('mouse', { vxx = 0.1 })  -- error: disturb: unknown field 'vxx' (did you mean 'vx'?)

s:load 'systems/stop_at_wall.lua'
s:disturb('mouse', { turn = 0.1 })  -- error: disturb: unknown field 'turn': expected vx, vy, va, seconds

s:load 'systems/stop_at_wall.lua'
s:disturb('mouse', { va = 1, seconds = 0.1 }) s:run(0.2)

s:load 'systems/stop_at_wall.lua'
s:behavior('idle', { script = 'none' }) s:restore('idle')
-- error: restore: idle is not a robot: expected a robot, or a port as in "idle.NAME"

s:load 'systems/stop_at_wall.lua'
s:restore('mose')  -- error: restore: there is no component 'mose' (did you mean 'mouse'?)

s:load 'systems/stop_at_wall.lua'
s:reload('controller', 'x')  -- error: reload: options expected a table, got string

s:load 'systems/stop_at_wall.lua'
s:reload('controller', { [true] = 'x' })  -- error: reload: unknown option '[true]': expected file, text

s:load 'systems/stop_at_wall.lua'
s:reload('controller', { file = 'a', text = 'b' })  -- error: reload: expected { file = "NAME" } or { text = "..." }

s:load 'systems/stop_at_wall.lua'
s:reload('controller', { text = '', 5 })  -- error: reload: unknown option '[1]': expected file, text

s:load 'systems/stop_at_wall.lua'
s:reload('controller', { text = 5 })  -- error: reload: option 'text' expected a string, got number

s:load 'systems/stop_at_wall.lua'
s:reload('controller', { txt = 'x' })  -- error: reload: unknown option 'txt' (did you mean 'text'?)

s:load 'systems/stop_at_wall.lua'
s:reload('controller', {})  -- error: reload: expected { file = "NAME" } or { text = "..." }

--- A method that is called without its colon is an error.
s:load 'systems/stop_at_wall.lua'
s.measure('a', 1)  -- error: write s:measure(...) with a colon

s:load 'systems/stop_at_wall.lua'
s.check(true)  -- error: write s:check(...) with a colon

--- A scenario can't set fields of s, and can't declare while it runs.
s:load 'systems/stop_at_wall.lua'
s.foo = 3  -- error: members of s can't be set: keep values in a local variable

s:load 'systems/stop_at_wall.lua'
range('a')  -- error: range: expected range(lo, hi) or range(lo, hi, step) with numbers

s:load 'systems/stop_at_wall.lua'
range(1, 2, 3, 4)  -- error: range: expected at most 3 arguments, got 4: range(lo, hi, step)

s:load 'systems/stop_at_wall.lua'
do scenario('b', function() end) end  -- error: scenario: a scenario can't declare another scenario: declare it at the top level of the file

s:load 'systems/stop_at_wall.lua'
pcall(range, 'a') error('mine')  -- failed: mine

--- A wrong call that the scenario catches with pcall is not an error.
s:load 'systems/stop_at_wall.lua'
s:check(not pcall(s.run, s, 'x'))

s:load 'systems/stop_at_wall.lua'
pcall(s.run, s, 'x') error('mine')  -- failed: mine

s:load 'systems/stop_at_wall.lua'
s:always('a', function() s:run('x', 2) return true end) s:run(1)
-- error: always 'a': run: a condition can only read values: only the scenario itself can advance time or add expectations

s:load 'systems/stop_at_wall.lua'
s:always('a', function(world) return world end)
-- error: always: 'a': the function is called without arguments; its parameter 'world' is never given: leave it out

--- A condition can't set parameters.
local w = s:load 'systems/stop_at_wall.lua'
s:always('it', function() w.controller.config.speed_x = 0.3 return true end)
-- error: always 'it': a condition can only read values: only the scenario itself can set parameters
s:run(0.1)

local w = s:load 'systems/stop_at_wall.lua'
s:run(0.1) s:wait_until('it', { within = 1 }, function() w.controller.config.speed_x = 0.3 return true end)
-- error: wait_until 'it': a condition can only read values: only the scenario itself can set parameters

local w = s:load 'systems/stop_at_wall.lua'
s:always('it', function() return w.controller.config.speed_x > 0 end)
s:run(0.1) w.controller.config.speed_x = 0.3 s:run(0.1)

--- A wrong measure is refused.
s:measure(3, 1)  -- error: measure: expected a name (what is measured), got number

s:measure('', 1)  -- error: measure: '': expected a name of one line

s:measure('passed', 1)  -- error: measure: 'passed': --measures has a column of this name: choose another

s:measure('a')  -- error: measure: 'a': expected a number, got nothing

s:measure('a', math.huge)  -- error: measure: 'a': expected a finite number, got inf

s:measure('a', 1, 5)  -- error: measure: 'a': expected a unit as in "s", got number

s:measure('a', 0.5) s:measure('a', 1)  -- error: measure: 'a': is already measured, as 0.5: a run keeps one number for each name

--- Tables are equal at any depth, and compared once each.
local function chain(n, leaf) local t = { leaf = leaf } for _ = 1, n do t = { x = t } end return t end
for _, n in ipairs { 24, 99, 100, 300, 50000 } do s:equal(chain(n, 1), chain(n, 1)) end
local function doubled() local t = { 1 } for _ = 1, 60 do t = { t, t } end return t end
s:equal(doubled(), doubled())

local function path(n, last) local node = last for i = 1, n do node = { parent = node } end return node end
s:equal(path(3, { x = 1 }), path(3, { x = 2 }))
-- failed: equal failed: { parent = { parent = { parent = {...} } } } is not the expected { parent = { parent = { parent = {...} } } } (they differ at parent.parent.parent.x)

local function chain(n) local t = {} for _ = 1, n do t = { t } end return t end
s:equal(chain(3), chain(4))  -- failed: equal failed: { { { {} } } } is not the expected { { { { {} } } } } (they differ at [1][1][1][1])

--- Tables that are nested too deep to compare count neither as equal nor as different.
local function chain(n) local t = {} for _ = 1, n do t = { t } end return t end
s:equal(chain(400000), chain(400000))  -- error: equal: the tables are nested too deeply to be compared

--- Tables that contain themselves are equal when they have the same shape.
local function loop(n) local first = {} local t = first for _ = 2, n do t = { t } end first[1] = t return first end
s:equal(loop(1), loop(1)) s:equal(loop(2), loop(3)) s:equal(loop(4000), loop(3999))
local want = { name = 'root' } want.child = { parent = want }
local got = { name = 'root' } got.child = { parent = got }
s:equal(got, want)

local want = { name = 'root' } want.child = { parent = want }
local got = { name = 'root' } got.child = { parent = { name = 'other', child = got.child } }
s:equal(got, want)
-- failed: equal failed: { child = { parent = { name = "other" } }, name = "root" } is not the expected { child = { parent = <cycle> }, name = "root" } (they differ at child.parent.name)

--- A key that only one of two tables has makes them different.
s:equal({ a = { 1 } }, { a = { 1, b = 2 } })  -- failed: equal failed: { a = { 1 } } is not the expected { a = { 1, b = 2 } } (they differ at a.b)

s:equal({ a = { 1, b = 2 } }, { a = { 1 } })  -- failed: equal failed: { a = { 1, b = 2 } } is not the expected { a = { 1 } } (they differ at a.b)

--- A tolerance below 0 is refused with its value.
s:near(1, 1, -0.1)  -- error: near: expected a tolerance from 0 on, got -0.1

s:near(1, 1, 0/0)  -- error: near: expected a tolerance from 0 on, got nan
