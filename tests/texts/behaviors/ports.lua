-- Port objects of behaviours: what is refused.

--- An in-port without messages reads the zero value of its type.
local n, t, v, i = input("n", "TimedLong"), input("t", "TimedString"), input("v", "TimedVelocity2D"), input("i", "CameraImage")
function on_execute()
assert(n:read() == 0 and t:read() == '' and v:read().va == 0 and i:read().pixels == '')
end

--- The message about a value that does not fit gives file, line, port and field.
local out = output("out", "TimedVelocity2D") local seq = output("seq", "TimedShortSeq") local short = output("short", "TimedShort") local pose = output("pose", "TimedPose2D")
function on_execute()
out:write { vx = '1' }  -- error: output 'out' (TimedVelocity2D): field 'vx' expected a number, got string
end

local out = output("out", "TimedVelocity2D") local seq = output("seq", "TimedShortSeq") local short = output("short", "TimedShort") local pose = output("pose", "TimedPose2D")
function on_execute()
out:write { vz = 1 }  -- error: output 'out' (TimedVelocity2D): unknown field 'vz' (did you mean 'vx'?)
end

local out = output("out", "TimedVelocity2D") local seq = output("seq", "TimedShortSeq") local short = output("short", "TimedShort") local pose = output("pose", "TimedPose2D")
function on_execute()
pose:write { position = { x = true } }  -- error: output 'pose' (TimedPose2D): field 'position.x' expected a number, got boolean
end

local out = output("out", "TimedVelocity2D") local seq = output("seq", "TimedShortSeq") local short = output("short", "TimedShort") local pose = output("pose", "TimedPose2D")
function on_execute()
seq:write { 1, 2, 'x' }  -- error: output 'seq' (TimedShortSeq): element 3 expected an integer, got string
end

local out = output("out", "TimedVelocity2D") local seq = output("seq", "TimedShortSeq") local short = output("short", "TimedShort") local pose = output("pose", "TimedPose2D")
function on_execute()
short:write(40000)  -- error: output 'short' (TimedShort): expected an integer from -32768 to 32767, got 40000
end

local out = output("out", "TimedVelocity2D") local seq = output("seq", "TimedShortSeq") local short = output("short", "TimedShort") local pose = output("pose", "TimedPose2D")
function on_execute()
short:write()  -- error: output 'short' (TimedShort): expected an integer, got nil
end

local out = output("out", "TimedVelocity2D") local seq = output("seq", "TimedShortSeq") local short = output("short", "TimedShort") local pose = output("pose", "TimedPose2D")
function on_execute()
out:write { vx = 0/0 }  -- error: output 'out' (TimedVelocity2D): field 'vx' expected a finite number, got nan
end

--- The message about an unknown property or method of a port gives the nearest name.
local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
return a.is_nwe  -- error: input 'a' has no 'is_nwe' (did you mean 'is_new'?)
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
a:raed()  -- error: input 'a' has no 'raed' (did you mean 'read'?)
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
a:write(1)  -- error: input 'a' has no 'write' (it has read, is_new, tm, age, connected, stale)
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
b:read()  -- error: output 'b' has no 'read' (it has write)
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
for _, v in ipairs(a) do end  -- error: input 'a' is the port, not its value: read it first, with `:read()`
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
a.value = 3  -- error: input 'a': its members can't be set
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
b.value = 3  -- error: output 'b': its members can't be set; write a value with `:write(value)`
end

--- A method that is called with a dot gives a hint.
local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
a.read()  -- error: input 'a': write `:read(...)` with a colon, not `.read(...)`
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
b.write(3)  -- error: output 'b': write `:write(...)` with a colon, not `.write(...)`
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
a.read(b)  -- error: input 'a': write `:read(...)` with a colon, not `.read(...)`
end

local a = input("a", "TimedLong") local b = output("b", "TimedLong")
function on_execute()
a.read({})  -- error: input 'a': write `:read(...)` with a colon, not `.read(...)`
end

--- A port object can't be changed.
local a = input("a", "TimedLong")
function on_execute()
assert(getmetatable(a) == false and type(a) == 'userdata' and not pcall(setmetatable, a, {}))
end

local a = input("a", "TimedLong")
function on_execute()
assert(not pcall(rawset, a, 'read', 1) and not pcall(rawget, a, 'read'))
end

local a = input("a", "TimedLong")
function on_execute()
assert(tostring(a) == "input 'a' (TimedLong)")
end

--- Ports can't be used while the file loads.
local a = input('a', 'TimedLong')
print(a:read())  -- error: input 'a': ports can't be read while the file loads

local a = input('a', 'TimedLong')
print(a.is_new)  -- error: input 'a': ports can't be read while the file loads

local a = output('a', 'TimedLong')
a:write(1)  -- error: output 'a': ports can't be written while the file loads

--- Options of ports are checked.
input('a', 'TimedLong', '', { quue = 3 })  -- error: input 'a': unknown option 'quue' (did you mean 'queue'?)

input('a', 'TimedLong', '', { safe = 3 })  -- error: input 'a': unknown option 'safe': expected queue

input('a', 'TimedLong', '', { queue = 0 })  -- error: input 'a': option 'queue' expected a whole number from 1 to 100000, got 0

input('a', 'TimedLong', '', { queue = 1.5 })
-- error: input 'a': option 'queue' expected a whole number from 1 to 100000, got 1.5

input('a', 'TimedLong', '', 3)  -- error: input 'a': options expected a table, got number

input('a', 'TimedLong', 3)  -- error: input 'a': its description expected a string, got number

output('a', 'TimedVelocity2D', '', { safe = { vx = 'x' } })
-- error: output 'a': option 'safe' (TimedVelocity2D): field 'vx' expected a number, got string

input('a', 'TimedLong', { queue = 3 })

input(nil, 'TimedLong')  -- error: input: its name expected a string, got nil

input('a')  -- error: input 'a': its type expected a string such as "TimedVelocity2D", got nil

input('a', 'TimedShrtSeq')
-- error: input 'a': unknown type 'TimedShrtSeq' (did you mean 'TimedShortSeq'?); `nezumi types` lists them all

--- A behaviour can't reach the shared metatable of its port tables.
local d = input('d', 'TimedShortSeq')
function on_execute()
assert(getmetatable(d:read()) == nil)
local mine = setmetatable(d:read(), { __index = function(_, i) return i < 4 and i or nil end })
local count = 0 for _ in ipairs(mine) do count = count + 1 end assert(count == 3)
assert(getmetatable(mine).__index and getmetatable(d:read()) == nil and d:read()[1] == nil)
end
