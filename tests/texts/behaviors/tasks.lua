-- Tasks of behaviours: what is refused.

--- A wrong declaration of a task is refused.
task('t')  -- error: task 't': expected a function, got nothing

function on_execute()
task('t', function() end)  -- error: task can only be called while the file loads
end

function on_execute()
wait(1)  -- error: wait can only be called in a task: task("name", function() ... end)
end

task(1, function() end)  -- error: task expected a task's name, got number

task('2t', function() end)  -- error: task '2t': the name is not an identifier: use letters, digits and _, no digit first

task('wait', function() end)  -- error: task 'wait': the name is already used in every component: choose another, as 'my_wait'

task('t', function() end) task('t', function() end)  -- error: task 't' is declared twice (first in line 1)

task('t', function(x) end)  -- error: task 't': its parameter 'x' is never given: leave it out

task('t', function() end, { repeat_it = true })  -- error: task 't': unknown option 'repeat_it' (did you mean 'repeating'?)

task('t', function() end, { repeating = 1 })  -- error: task 't': option 'repeating' expected true or false, got number

start('t')  -- error: start can't be called while the file loads

wait(1)  -- error: wait can only be called in a task: task("name", function() ... end)

--- Waiting where it is not possible gives a message.
task('t', function()
  table.sort({ 2, 1 }, function() wait(1) end)
-- error: wait can't be called here: a function that Lua's library calls (as table.sort does) can't wait
end)

task('t', function()
  coroutine.wrap(function() table.sort({ 2, 1 }, function() coroutine.wrap(function() wait(1) end)() end) end)()
-- error: wait can't be called here: a function that Lua's library calls (as table.sort does) can't wait
end)

task('t', function()
  ('x'):gsub('x', function() wait_until(function() end) end)
-- error: wait_until can't be called here: a function that Lua's library calls (as table.sort does) can't wait
end)

task('t', function()
  wait_until(function() wait(1) end)
-- error: wait can't be called here: a function that Lua's library calls (as table.sort does) can't wait
end)

task('t', function()
  table.sort({ 2, 1 }, function() cancel('t') end)
-- error: cancel can't be called here: a function that Lua's library calls (as table.sort does) can't wait
end)

task('t', function()
  wait(-1)  -- error: wait expected finite seconds of at least 0, got -1
end)

task('t', function()
  wait(1/0)  -- error: wait expected finite seconds of at least 0, got inf
end)

task('t', function()
  wait()  -- error: wait expected seconds, got nothing
end)

task('t', function()
  wait('1')  -- error: wait expected seconds, got string
end)

task('t', function()
  wait(1, 2)  -- error: wait: expected at most 1 argument, got 2: wait(seconds)
end)

task('t', function()
  wait_until(3)  -- error: wait_until expected a function, got number
end)

task('t', function()
  wait_until(function(x) end)  -- error: wait_until: its parameter 'x' is never given: leave it out
end)

task('t', function()
  wait_until(function() end, { within = -1 })  -- error: wait_until: option 'within' expected a number from 0 on, got -1
end)

task('t', function()
  wait_until(function() end, { withn = 1 })  -- error: wait_until: unknown option 'withn' (did you mean 'within'?)
end)

task('t', function()
  coroutine.yield(1)  -- error: attempt to yield from outside a coroutine
end)

--- The error of a task may be any value.
task('t', function()
  error('plain', 0)  -- error: plain
end)

task('t', function()
  error({})  -- error: an error of type table
end)

task('t', function()
  error(setmetatable({}, { __tostring = function() return 'mine' end }))  -- error: mine
end)

task('t', function()
  error()  -- error: an error of value nil
end)

task('t', function()
  local t = {} while true do t[#t + 1] = ('x'):rep(100000) .. #t end
-- error: not enough memory: the script reached its limit of 64 MB
end)

task('t', function()
  local function f() return f() + 1 end f()  -- error: stack overflow: the recursion is too deep for the script's limit of 64 MB
end)

--- An error whose __tostring fails is reported once.
task('t', function()
  error(setmetatable({}, { __tostring = function()
    error('no text')  -- error: no text
  end }))
end)

--- An error keeps its own place if an earlier error of a closing variable was caught.
local function fail()
  error('later', 0)  -- error: later
end
task('t', function()
  local x <close> = setmetatable({}, { __close = function() error('closer') end })
  wait(10)
end)
function on_execute()
  pcall(cancel, 't')
  fail()
end
