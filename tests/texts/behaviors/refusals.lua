-- What is refused when a behaviour loads: the line, and the nearest known name.

--- A file that declares nothing is refused.
--  -- error: behavior.lua: the file declares nothing: no port, parameter, command, task or callback

-- nothing yet  -- error: behavior.lua: the file declares nothing: no port, parameter, command, task or callback

local x = 1  -- error: behavior.lua: the file declares nothing: no port, parameter, command, task or callback

about { version = '1' }  -- error: behavior.lua: the file declares nothing: no port, parameter, command, task or callback

function on_execute() end

command('a', function() end)

--- The message about an unknown callback gives the nearest callback.
function on_exceute() end
--       ^ error: unknown callback 'on_exceute' (did you mean 'on_execute'?)

on_activate = function() end  -- error at column 1: unknown callback 'on_activate' (did you mean 'on_activated'?)

function on_start() end
--       ^ error: unknown callback 'on_start' (there are on_activated, on_execute, on_deactivated, on_aborting, on_error, on_reset, on_reload)

--- The message about a missing library says what to use instead.
sleep(1)  -- error at column 1: unknown global 'sleep': `wait(seconds)` waits, in a task: task("name", function() ... end)

local t = os.clock()
--        ^ error: unknown global 'os': the time is now(); there are no files and no processes

io.write('x')  -- error at column 1: unknown global 'io': `log` writes lines, and `nezumi run --record` records ports

self.count = 1
-- error at column 1: unknown global 'self': a behaviour has no object: parameters are in `config`, data in `state` and locals

local m = {} function m:count() self.n = 1 end function on_execute() m:count() end

debug.traceback()  -- error at column 1: unknown global 'debug': `print` and the console show values

load('x')  -- error at column 1: unknown global 'load': code comes from files, by `require`

loadfile('x')  -- error at column 1: unknown global 'loadfile': code comes from files, by `require`

loadstring('x')  -- error at column 1: unknown global 'loadstring': code comes from files, by `require`

dofile('x')  -- error at column 1: unknown global 'dofile': code comes from files, by `require`

package('x')  -- error at column 1: unknown global 'package': code comes from files, by `require`

collectgarbage()  -- error at column 1: unknown global 'collectgarbage': memory is released automatically

unpack({})  -- error at column 1: unknown global 'unpack': it is table.unpack in Lua 5.4

--- The message about an unknown field of a library gives the nearest field, or the replacement in Lua 5.4.
function on_execute() if now() > 9e9 then print(math.flor(1.5)) end end
--                                                   ^ error: unknown field 'math.flor' (did you mean 'math.floor'?)

function on_execute() if now() > 9e9 then print(math.qqqqq) end end
--                                                   ^ error: unknown field 'math.qqqqq'

function on_execute() if now() > 9e9 then print(math['flor']) end end
--                                                   ^ error: unknown field 'math.flor' (did you mean 'math.floor'?)

function on_execute() if now() > 9e9 then print(math.atan2(1)) end end
--                                                   ^ error: unknown field 'math.atan2': it is math.atan(y, x) in Lua 5.4

function on_execute() if now() > 9e9 then print(math.pow(1)) end end
--                                                   ^ error: unknown field 'math.pow': it is x ^ y in Lua 5.4

function on_execute() if now() > 9e9 then print(math.log10(1)) end end
--                                                   ^ error: unknown field 'math.log10': it is math.log(x, 10) in Lua 5.4

function on_execute() if now() > 9e9 then print(string.gfind(1)) end end
--                                                     ^ error: unknown field 'string.gfind': it is string.gmatch in Lua 5.4

function on_execute() if now() > 9e9 then print(string.dump(1)) end end
--                                                     ^ error: unknown field 'string.dump': code comes from files, by `require`

function on_execute() if now() > 9e9 then print(table.getn(1)) end end
--                                                    ^ error: unknown field 'table.getn': it is #t in Lua 5.4

function on_execute() if now() > 9e9 then print(table.foreachi(1)) end end
--                                                    ^ error: unknown field 'table.foreachi': it is `for i, value in ipairs(t) do` in Lua 5.4

print(bit32.band(1, 2))
--    ^ error: unknown global 'bit32': Lua 5.4 has operators for bits: & | ~ << >>

print(None)
--    ^ error: unknown global 'None': it is nil in Lua

--- Existing fields, and local variables with the name of a library, are accepted.
local math = { flor = print } function on_execute() math.flor(1) end  -- prints: info: 1

local function f(table) return table.getn end function on_execute() f {} end

local t = {} function t:f() return self.math.flor end function on_execute() end

function on_execute() local list = table.pack(math.pi, math.huge, utf8.charpattern, string.format, table.pack, coroutine.wrap, math['floor'], math['fl' .. 'or']) end

function on_execute()
math.flor = print  -- error: can't set 'math.flor': 'math' is read-only
end

--- The message about syntax of other languages gives the syntax of Lua.
if a != b then end  -- error: 'then' expected near '!': it is ~= in Lua

x += 1  -- error: syntax error near '+': Lua has no such assignment: write x = x + 1

x++  -- error: syntax error near '+': Lua has no such assignment: write x = x + 1

if x = 3 then end  -- error: 'then' expected near '=': == compares in Lua, and = assigns

while f(x) = 3 do end  -- error: 'do' expected near '=': == compares in Lua, and = assigns

if a && b then end  -- error: unexpected symbol near '&': it is `and` in Lua

if a || b then end  -- error: unexpected symbol near '|': it is `or` in Lua

if !a then end  -- error: unexpected symbol near '!': it is `not` in Lua

if a then f() elif b then end  -- error: syntax error near 'b': it is `elseif` in Lua

def f() end  -- error: syntax error near 'f': it is `function` in Lua

let x = 3  -- error: syntax error near 'x': it is `local` in Lua

// first  -- error: unexpected symbol near '//': a comment begins with -- in Lua

x = 1 # first  -- error: unexpected symbol near '#': a comment begins with -- in Lua

/* first */  -- error: unexpected symbol near '/': a comment begins with -- in Lua

x = a ? 1 : 2  -- error: unexpected symbol near '?': it is `condition and a or b` in Lua

import math  -- error: syntax error near 'math': `local name = require "name"` loads a module in Lua

class Wheel  -- error: syntax error near 'Wheel': Lua has no classes: a table has fields and functions

try f() catch g() end  -- error: syntax error near 'f': pcall(f) calls f and catches its errors in Lua

x = = 1  -- error: unexpected symbol near '='

--- The message says if a system file is used as a behaviour.
arena 'x'  -- error at column 1: unknown global 'arena': it is for system files, and this is a behaviour

robot 'x'  -- error at column 1: unknown global 'robot': it is for system files, and this is a behaviour

behavior 'x'  -- error at column 1: unknown global 'behavior': it is for system files, and this is a behaviour

component 'x'  -- error at column 1: unknown global 'component': it is for system files, and this is a behaviour

connect 'x'  -- error at column 1: unknown global 'connect': it is for system files, and this is a behaviour

--- A callback must be a global function that is defined once, while the file loads.
on_execute = 5  -- error: on_execute expected a function, got number

function on_execute() end
function on_execute() end  -- error: on_execute is defined twice (first in line 1)

local function on_execute() end
--             ^ error: 'on_execute' is local, so it would never be called: leave out `local`

local on_error = print
--    ^ error: 'on_error' is local, so it would never be called: leave out `local`

if true then function on_execute() end else function on_execute() end end

function on_execute()
on_error = print  -- error: on_error can only be defined while the file loads
end

function on_error() end
function on_execute()
on_error() assert(on_reset == nil and on_execute ~= nil)
end

--- Unknown globals are refused, also in code that never runs.
local target = output('out', 'TimedLong')
function on_execute()
  if now() > 1e9 then taget:write(1) end
--                    ^ error: unknown global 'taget' (did you mean 'target'?)
end

local function f() count = 1 end
--                 ^ error: unknown global 'count' (declare it first: local count)

param('x', 1) pritn('x')
--            ^ error: unknown global 'pritn' (did you mean 'print'?)

param('x', 1) local y = os
--                      ^ error: unknown global 'os': the time is now(); there are no files and no processes

param('x', 1) local y = io
--                      ^ error: unknown global 'io': `log` writes lines, and `nezumi run --record` records ports

param('x', 1) local y = debug
--                      ^ error: unknown global 'debug': `print` and the console show values

param('x', 1) local y = load
--                      ^ error: unknown global 'load': code comes from files, by `require`

param('x', 1) local y = loadstring
--                      ^ error: unknown global 'loadstring': code comes from files, by `require`

param('x', 1) local y = dofile
--                      ^ error: unknown global 'dofile': code comes from files, by `require`

param('x', 1) local y = loadfile
--                      ^ error: unknown global 'loadfile': code comes from files, by `require`

param('x', 1) local y = package
--                      ^ error: unknown global 'package': code comes from files, by `require`

param('x', 1) local y = collectgarbage
--                      ^ error: unknown global 'collectgarbage': memory is released automatically

param('x', 1) local y = _G
--                      ^ error: unknown global '_G'

--- Functions and tables of behaviours can't be assigned.
param('x', 1) state = 1
--            ^ error: 'state' can't be assigned: it is predefined (write 'local state' for a variable of that name)

param('x', 1) config = 1
--            ^ error: 'config' can't be assigned: it is predefined (write 'local config' for a variable of that name)

param('x', 1) input = 1
--            ^ error: 'input' can't be assigned: it is predefined (write 'local input' for a variable of that name)

param('x', 1) dt = 1
--            ^ error: 'dt' can't be assigned: it is predefined (write 'local dt' for a variable of that name)

param('x', 1) log = 1
--            ^ error: 'log' can't be assigned: it is predefined (write 'local log' for a variable of that name)

param('x', 1) math = 1
--            ^ error: 'math' can't be assigned: it is predefined (write 'local math' for a variable of that name)

param('x', 1) print = 1
--            ^ error: 'print' can't be assigned: it is predefined (write 'local print' for a variable of that name)

param('x', 1) local _ENV = {}
--                  ^ error: '_ENV' can't be used: write the names of globals directly

--- The message about an unknown type gives the nearest type.
output('out', 'TimedVelocity')
-- error: output 'out': unknown type 'TimedVelocity' (did you mean 'TimedVelocity2D'?); `nezumi types` lists them all

output('out', 3)  -- error: output 'out': its type expected a string such as "TimedVelocity2D", got number

--- A name is declared once.
input('a', 'TimedLong')
input('a', 'TimedLong')  -- error: input 'a' is declared twice (first in line 1)

input('a', 'TimedLong')
output('a', 'TimedLong')  -- error: output 'a': the name is already used by input 'a' (first in line 1)

command('a', function() end)
command('a', function() end)  -- error: command 'a' is declared twice (first in line 1)

input('a', 'TimedLong')
command('a', function() end)  -- error: command 'a': the name is already used by input 'a' (first in line 1)

command('a', function() end)
input('a', 'TimedLong')  -- error: input 'a': the name is already used by command 'a' (first in line 1)

input('a', 'TimedLong') param('a', 1)

--- A name must be an identifier that is not reserved.
input('in', 'TimedLong')

param('end', 1)  -- error: parameter 'end': the name is not an identifier: it is a keyword of Lua

command('end', print)  -- error: command 'end': the name is not an identifier: it is a keyword of Lua

input('', 'TimedLong')  -- error: input '': the name is not an identifier: use letters, digits and _, no digit first

param('', 1)  -- error: parameter '': the name is not an identifier: use letters, digits and _, no digit first

input('1a', 'TimedLong')  -- error: input '1a': the name is not an identifier: use letters, digits and _, no digit first

param('1a', 1)  -- error: parameter '1a': the name is not an identifier: use letters, digits and _, no digit first

input('a-b', 'TimedLong')  -- error: input 'a-b': the name is not an identifier: use letters, digits and _, no digit first

param('a-b', 1)  -- error: parameter 'a-b': the name is not an identifier: use letters, digits and _, no digit first

input('a b', 'TimedLong')  -- error: input 'a b': the name is not an identifier: use letters, digits and _, no digit first

param('a b', 1)  -- error: parameter 'a b': the name is not an identifier: use letters, digits and _, no digit first

input('a.b', 'TimedLong')  -- error: input 'a.b': the name is not an identifier: use letters, digits and _, no digit first

param('a.b', 1)  -- error: parameter 'a.b': the name is not an identifier: use letters, digits and _, no digit first

input('ä', 'TimedLong')  -- error: input 'ä': the name is not an identifier: use letters, digits and _, no digit first

param('ä', 1)  -- error: parameter 'ä': the name is not an identifier: use letters, digits and _, no digit first

output('config', 'TimedLong')
-- error: output 'config': the name is already used in every component: choose another, as 'my_config'

param('config', 1)  -- error: parameter 'config': the name is already used in every component: choose another, as 'my_config'

command('config', print)  -- error: command 'config': the name is already used in every component: choose another, as 'my_config'

output('state', 'TimedLong')  -- error: output 'state': the name is already used in every component: choose another, as 'my_state'

param('state', 1)  -- error: parameter 'state': the name is already used in every component: choose another, as 'my_state'

command('state', print)  -- error: command 'state': the name is already used in every component: choose another, as 'my_state'

output('status', 'TimedLong')
-- error: output 'status': the name is already used in every component: choose another, as 'my_status'

param('status', 1)  -- error: parameter 'status': the name is already used in every component: choose another, as 'my_status'

command('status', print)  -- error: command 'status': the name is already used in every component: choose another, as 'my_status'

output('ports', 'TimedLong')  -- error: output 'ports': the name is already used in every component: choose another, as 'my_ports'

param('ports', 1)  -- error: parameter 'ports': the name is already used in every component: choose another, as 'my_ports'

command('ports', print)  -- error: command 'ports': the name is already used in every component: choose another, as 'my_ports'

output('activate', 'TimedLong')
-- error: output 'activate': the name is already used in every component: choose another, as 'my_activate'

param('activate', 1)  -- error: parameter 'activate': the name is already used in every component: choose another, as 'my_activate'

command('activate', print)
-- error: command 'activate': the name is already used in every component: choose another, as 'my_activate'

output('use', 'TimedLong')  -- error: output 'use': the name is already used in every component: choose another, as 'my_use'

param('use', 1)  -- error: parameter 'use': the name is already used in every component: choose another, as 'my_use'

command('use', print)  -- error: command 'use': the name is already used in every component: choose another, as 'my_use'

output('now', 'TimedLong')  -- error: output 'now': the name is already used in every component: choose another, as 'my_now'

param('now', 1)  -- error: parameter 'now': the name is already used in every component: choose another, as 'my_now'

command('now', print)  -- error: command 'now': the name is already used in every component: choose another, as 'my_now'

output('input', 'TimedLong')  -- error: output 'input': the name is already used in every component: choose another, as 'my_input'

param('input', 1)  -- error: parameter 'input': the name is already used in every component: choose another, as 'my_input'

command('input', print)  -- error: command 'input': the name is already used in every component: choose another, as 'my_input'

output('require', 'TimedLong')
-- error: output 'require': the name is already used in every component: choose another, as 'my_require'

param('require', 1)  -- error: parameter 'require': the name is already used in every component: choose another, as 'my_require'

command('require', print)
-- error: command 'require': the name is already used in every component: choose another, as 'my_require'

output('tasks', 'TimedLong')  -- error: output 'tasks': the name is already used in every component: choose another, as 'my_tasks'

param('tasks', 1)  -- error: parameter 'tasks': the name is already used in every component: choose another, as 'my_tasks'

command('tasks', print)  -- error: command 'tasks': the name is already used in every component: choose another, as 'my_tasks'

output('probes', 'TimedLong')
-- error: output 'probes': the name is already used in every component: choose another, as 'my_probes'

param('probes', 1)  -- error: parameter 'probes': the name is already used in every component: choose another, as 'my_probes'

command('probes', print)  -- error: command 'probes': the name is already used in every component: choose another, as 'my_probes'

output('task', 'TimedLong')  -- error: output 'task': the name is already used in every component: choose another, as 'my_task'

param('task', 1)  -- error: parameter 'task': the name is already used in every component: choose another, as 'my_task'

command('task', print)  -- error: command 'task': the name is already used in every component: choose another, as 'my_task'

output('wait', 'TimedLong')  -- error: output 'wait': the name is already used in every component: choose another, as 'my_wait'

param('wait', 1)  -- error: parameter 'wait': the name is already used in every component: choose another, as 'my_wait'

command('wait', print)  -- error: command 'wait': the name is already used in every component: choose another, as 'my_wait'

param('math', 1)  -- error: parameter 'math': the name is already used by Lua's library

input('aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa', 'TimedLong')
-- error: input 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa...': the name is too long

param('a\nb\0', 1)  -- error: parameter 'a\x0ab\x00': the name is not an identifier: use letters, digits and _, no digit first

--- Declarations are allowed only while the file loads.
function on_execute()
input('a', 'TimedLong')  -- error: input can only be called while the file loads
end

function on_execute()
output('a', 'TimedLong')  -- error: output can only be called while the file loads
end

function on_execute()
param('a', 1)  -- error: param can only be called while the file loads
end

function on_execute()
command('a', print)  -- error: command can only be called while the file loads
end

function on_execute()
about {}  -- error: about can only be called while the file loads
end

--- An error at the top level refuses the file, with its line.
param('x', 1)
error('no')  -- error: no

param('x', 1)
local t = nil
t.x = 1  -- error: attempt to index a nil value (local 't')

param('x', 1)
error()  -- error: an error of value nil

param('x', 1)
error({})  -- error: an error of type table

--- A command must not have the name of a member of components.
command('set', function() end)  -- error: command 'set': components have a member 'set' already: choose another name

command('truth', function() end)  -- error: command 'truth': components have a member 'truth' already: choose another name

command('rate', function() end)  -- error: command 'rate': components have a member 'rate' already: choose another name

command('teleport', function() end)
-- error: command 'teleport': components have a member 'teleport' already: choose another name

command('commands', function() end)
-- error: command 'commands': components have a member 'commands' already: choose another name

command('leds', function() end)  -- error: command 'leds': components have a member 'leds' already: choose another name

command('status', function() end)
-- error: command 'status': the name is already used in every component: choose another, as 'my_status'

--- A component has at most 1000 ports, 1000 parameters and 1000 commands.
for i = 1, 1000 do param('x' .. i, 0) end

for i = 1, 30000 do param('x' .. i, 0) end  -- error: parameter 'x1001': a component can have at most 1000 parameters

for i = 1, 30000 do input('x' .. i, 'TimedLong') end  -- error: input 'x1001': a component can have at most 1000 ports

for i = 1, 30000 do command('x' .. i, function() end) end  -- error: command 'x1001': a component can have at most 1000 commands
