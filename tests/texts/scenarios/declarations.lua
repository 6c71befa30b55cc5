-- Declarations of scenarios: what is refused before a scenario runs.

--- The name of a scenario is used once.
scenario('a', function() end)
scenario('a', function() end)  -- error: scenario 'a': the name is already used by the scenario at it_test.lua:1

scenario('a', { sweep = { x = { 1, 2 }, y = { 'b' } } }, function() end)
scenario('a [x=1, y=b]', function() end)
-- error: scenario 'a [x=1, y=b]': the name is already used by a run of the scenario at it_test.lua:1

scenario('a [x=1, y=b]', function() end)
scenario('a', { sweep = { x = { 1, 2 }, y = { 'b' } } }, function() end)
-- error: scenario 'a': its run 'a [x=1, y=b]' has the same name as the scenario at it_test.lua:1

scenario('a', { sweep = { x = range(0, 3) } }, function() end)
scenario('a [x=2.0]', function() end)  -- error: scenario 'a [x=2.0]': the name is already used by a run of the scenario at it_test.lua:1

--- The names of thousands of scenarios are compared in time.
for i = 1, 10000 do scenario('a' .. i, { sweep = i % 2 == 0 and { x = { 1 } } or nil }, function() end) end
scenario('a7', function() end)  -- error: scenario 'a7': the name is already used by the scenario at it_test.lua:1

--- The name of a scenario may be like the name of a run.
scenario('a', { sweep = { x = { 1, 2 }, y = { 'b' } } }, function() end)
scenario('a [x=3, y=b]', function() end)
scenario('a [x=1]', function() end)
scenario('a x=1', function() end)
scenario('a []', function() end)

scenario('a', { sweep = { x = range(0, 3) } }, function() end)
scenario('a [x=2]', function() end)

--- Options of a scenario are checked.
scenario('a', { timout = 3 }, function() end)
--              ^ error: scenario 'a': unknown option 'timout' (did you mean 'timeout'?)

scenario('a',
{ timeout = 0 }, function() end)
--^ error: scenario 'a': option 'timeout' expected a positive number, got 0

scenario('a', {})  -- error: scenario 'a': expected a function after the options, got nothing

scenario(function() end)  -- error: scenario: expected a name, got function

scenario('a', { samples = 3 }, function() end)
--              ^ error: scenario 'a': option 'samples': there is no sweep to draw from

scenaro('a', function() end)  -- error at column 1: unknown global 'scenaro' (did you mean 'scenario'?)

scenario('it', function(s, p, extra) end)
-- error: scenario 'it': the function gets the scenario and its values; its parameter 'extra' is never given: leave it out

--- The values of a sweep are checked.
scenario('a', { sweep = { x = {} } }, function() end)
--              ^ error: scenario 'a': option 'sweep': 'x' expected a list of values, got an empty one

scenario('a', { sweep = { x = 3 } }, function() end)
--              ^ error: scenario 'a': option 'sweep': 'x' expected a list of values or range(lo, hi), got number

scenario('a', { sweep = { x = range(2, 1) } }, function() end)  -- error: range: expected lo <= hi, and a step above 0

scenario('a', { samples = 3, sweep = { x = range(math.mininteger, math.maxinteger, 1) } }, function() end)
-- error: range: the step is too small, its values would be equal: leave it out

scenario('a', { samples = 3, sweep = { x = range(0, 1, 1e-20) } }, function() end)
-- error: range: the step is too small, its values would be equal: leave it out

scenario('a', { sweep = { x = { 1, 'b', 1 } } }, function() end)
--              ^ error: scenario 'a': option 'sweep': 'x' has the value 1 twice

scenario('a', { sweep = { x = { 1, '1' } } }, function() end)
--              ^ error: scenario 'a': option 'sweep': 'x' has two values that are both 1 in the names of their runs

scenario('a', { sweep = { x = { 1, 1 / 0 } } }, function() end)
--              ^ error: scenario 'a': option 'sweep': 'x' expected finite numbers, got inf

scenario('a', { sweep = { x = { { 1, { y = 0 / 0 } } } } }, function() end)
--              ^ error: scenario 'a': option 'sweep': 'x' expected finite numbers, got {1, {y=nan}}

--- Options about seeds are checked.
scenario('it', { seeds = 0 }, function() end)
--               ^ error: scenario 'it': option 'seeds' expected a whole number from 1 to 100000, got 0

scenario('it', { seed = -1 }, function() end)
--               ^ error: scenario 'it': option 'seed' expected a whole number from 0 to 9223372036854775807, got -1

scenario('it', { seed = 7, seeds = 3 }, function() end)
--                         ^ error: scenario 'it': option 'seeds': 'seed' gives all runs the same seed: leave out 'seed' or 'seeds'

scenario('it', { paired = 'controler', sweep = { controller = { 1, 2 } } }, function() end)
-- error: scenario 'it': option 'paired': the sweep has no list 'controler' (did you mean 'controller'?)

scenario('it', { paired = 'x', sweep = { x = range(0, 1) } }, function() end)
-- error: scenario 'it': option 'paired': the sweep has no list 'x'

scenario('a', { seeds = 2 }, function() end)
scenario('a #1', function() end)  -- error: two runs have the name 'a #1': rename a scenario

--- A method that a scenario does not have is found before it runs.
scenario('it', function(s)
  s:rum(1)
--  ^ error: s has no 'rum' (did you mean 'run'?)
end)
