-- Functions of behaviours refuse wrong numbers and types of arguments.

--- Every function of behaviours refuses too many arguments and arguments of a wrong type.
about({}, 2)  -- error: about: expected at most 1 argument, got 2: about { version =, vendor =, category = }

about 'me'  -- error: about expected a table, got string

cancel('a', 2)  -- error: cancel: expected at most 1 argument, got 2: cancel(name)

cancel(5)  -- error: cancel expected a task's name, got number

command('a', print, 'doc', 4)  -- error: command: expected at most 3 arguments, got 4: command(name, function, doc)

command('a', 5)  -- error: command 'a': expected a function, got number

input('a', 'TimedLong', 'doc', {}, 5)  -- error: input: expected at most 4 arguments, got 5: input(name, type, doc, options)

input('a', 'TimedLong', 5)  -- error: input 'a': its description expected a string, got number

now(1)  -- error: now: expected no arguments, got 1: now()

output('a', 'TimedLong', 'doc', {}, 5)  -- error: output: expected at most 4 arguments, got 5: output(name, type, doc, options)

output(5, 'TimedLong')  -- error: output: its name expected a string, got number

param('a', 1, {}, 4)  -- error: param: expected at most 3 arguments, got 4: param(name, default, options)

param('a', print)  -- error: parameter 'a': its default expected a boolean, a number, a string or an array of them, got function

probe('a', 1, 2)  -- error: probe: expected at most 2 arguments, got 3: probe(name, value)

probe(5, 1)  -- error: probe expected a name, got number

require('a', 2)  -- error: require: expected at most 1 argument, got 2: require(name)

require(5)  -- error: require expected a module's name, got number

start('a', 2)  -- error: start: expected at most 1 argument, got 2: start(name)

start(5)  -- error: start expected a task's name, got number

task('a', print, {}, 4)  -- error: task: expected at most 3 arguments, got 4: task(name, function, options)

task('a', 5)  -- error: task 'a': expected a function, got number

wait(1, 2)  -- error: wait: expected at most 1 argument, got 2: wait(seconds)

wait 'a'  -- error: wait expected seconds, got string

wait_until(print, {}, 3)  -- error: wait_until: expected at most 2 arguments, got 3: wait_until(condition, options)

wait_until(5)  -- error: wait_until expected a function, got number

local a = input('a', 'TimedLong')
function on_execute()
a:read(1)  -- error: input 'a':read: expected no arguments, got 1: input 'a':read()
end

local a = output('a', 'TimedLong')
function on_execute()
a:write(1, 2)  -- error: output 'a':write: expected at most 1 argument, got 2: output 'a':write(value)
end

local a = output('a', 'TimedLong')
function on_execute()
a:write 'x'  -- error: output 'a' (TimedLong): expected an integer, got string
end

--- A callback with a parameter that never gets a value is refused.
function on_execute(dt) end  -- error: on_execute: its parameter 'dt' is never given: `dt` is a global

param('x', 1)
on_activated = function(time) end  -- error: on_activated: its parameter 'time' is never given: `now()` is the time

function on_error(self, message) end  -- error: on_error: its parameter 'self' is never given: leave it out

function on_reload(old, new) end  -- error: on_reload: its parameter 'new' is never given: leave it out

function on_reload(old_version) end function on_execute() end

on_execute = print  -- prints: info:

command('go', function(a, b) end)
