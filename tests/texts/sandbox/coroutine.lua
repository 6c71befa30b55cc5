-- Coroutines in the sandbox.

--- Values are passed to coroutines and back.
local c = coroutine.create(function(a, b) local d = coroutine.yield(a + b) local e, f = coroutine.yield(d * 2) return e .. f end) local out = {} for _, x in ipairs { { 1, 2 }, { 10 }, { 'x', 'y' }, {} } do local ok, v = coroutine.resume(c, table.unpack(x)) out[#out + 1] = tostring(ok) .. ' ' .. tostring(v) end return table.concat(out, ', '), coroutine.status(c)
-- returns: true 3, true 20, true xy, false cannot resume dead coroutine dead

local c = coroutine.wrap(function(...) return select('#', ...), ... end) return c(nil, nil)  -- returns: 2 nil nil

local n = 0 for v in coroutine.wrap(function() for i = 1, 10 do coroutine.yield(i) end end) do n = n + v end return n
-- returns: 55

local c = coroutine.wrap(function() end) c() c()  -- error: cannot resume dead coroutine

return coroutine.resume(coroutine.create(error), 'x', 0)  -- returns: false x

return coroutine.resume(coroutine.create(error), { })  -- returns: false table

coroutine.resume(1)  -- error: bad argument #1 to 'resume' (coroutine expected, got number)

coroutine.create(1)  -- error: bad argument #1 to 'create' (function expected, got number)

coroutine.wrap()  -- error: bad argument #1 to 'wrap' (function expected, got no value)

coroutine.yield()  -- error: attempt to yield from outside a coroutine

return select('#', coroutine.resume(coroutine.create(function() return table.unpack({}, 1, 100000) end)))  -- returns: 100001

--- A coroutine can yield in the same places as in Lua.
function step() return coroutine.yield('out') end

local c = coroutine.wrap(function() return select(2, pcall(step)) end) return c(), c(2)  -- returns: out 2

return pcall(coroutine.yield)  -- returns: false attempt to yield from outside a coroutine

return coroutine.wrap(function() return pcall(table.sort, { 1, 2 }, step) end)()
-- returns: false attempt to yield across a C-call boundary

local c = coroutine.wrap(function() return select(2, xpcall(step, print)) end) return c(), c(2)  -- returns: out 2

local c = coroutine.wrap(function() return select(4, pcall(pcall, pcall, step)) end) return c(), c(2)  -- returns: out 2

local c = coroutine.wrap(function() return setmetatable({}, { __index = function() return step() end }).x end) return c(), c(2)
-- returns: out 2

local c = coroutine.wrap(function() return setmetatable({}, { __add = function() return step() end }) + 1 end) return c(), c(2)
-- returns: out 2

local c = coroutine.wrap(function() local n do local x <close> = setmetatable({}, { __close = function() n = step() end }) end return n end) return c(), c(2)
-- returns: out 2

local c = coroutine.wrap(function() for _, n in pairs(setmetatable({}, { __pairs = function() return next, { step() } end })) do return n end end) return c(), c(2)
-- returns: out 2

--- A coroutine has a status.
local c c = coroutine.create(function() coroutine.yield(coroutine.status(c)) end) local before = coroutine.status(c) local _, inside = coroutine.resume(c) local after = coroutine.status(c) coroutine.resume(c) return before, inside, after, coroutine.status(c)
-- returns: suspended running suspended dead

local c c = coroutine.create(function() return coroutine.wrap(function() return coroutine.status(c), coroutine.resume(c) end)() end) return coroutine.resume(c)
-- returns: true normal false cannot resume non-suspended coroutine

local c c = coroutine.wrap(function() return pcall(c) end) return c()  -- returns: false cannot resume non-suspended coroutine

local main, is_main = coroutine.running() local inner, is_inner = coroutine.wrap(coroutine.running)() return is_main, is_inner, main == inner, coroutine.isyieldable(), coroutine.wrap(coroutine.isyieldable)()
-- returns: true false false false true

--- A coroutine can be closed.
local log = '' local c = coroutine.create(function() local x <close> = setmetatable({}, { __close = function(_, e) log = log .. 'closed' .. tostring(e) end }) coroutine.yield() end) coroutine.resume(c) return coroutine.close(c), log, coroutine.status(c)
-- returns: true closednil dead

local c = coroutine.create(function() local x <close> = setmetatable({}, { __close = function() error('in close', 0) end }) coroutine.yield() end) coroutine.resume(c) return coroutine.close(c)
-- returns: false in close

local c = coroutine.create(function() error('x', 0) end) coroutine.resume(c) return coroutine.close(c)  -- returns: false x

return coroutine.close(coroutine.create(print))  -- returns: true

return coroutine.close(coroutine.running())  -- error: cannot close a running coroutine

local log = '' local c = coroutine.wrap(function() local x <close> = setmetatable({}, { __close = function(_, e) log = e end }) error('x', 0) end) return pcall(c), log
-- returns: false x

local c = coroutine.wrap(function() local x <close> = setmetatable({}, { __close = function() error('y', 0) end }) error('x', 0) end) return pcall(c)
-- returns: false y

--- A coroutine continues in later calls.
steps = coroutine.wrap(function() local n = 0 while true do n = n + 1 coroutine.yield(n) end end) return steps()  -- returns: 1

return steps()  -- returns: 2

return steps()  -- returns: 3

return steps()  -- returns: 4

return steps()  -- returns: 5

return steps()  -- returns: 6

return steps()  -- returns: 7

return steps()  -- returns: 8

return steps()  -- returns: 9

return steps()  -- returns: 10

return steps()  -- returns: 11

return steps()  -- returns: 12

return steps()  -- returns: 13

return steps()  -- returns: 14

return steps()  -- returns: 15

return steps()  -- returns: 16

return steps()  -- returns: 17

return steps()  -- returns: 18

return steps()  -- returns: 19

return steps()  -- returns: 20

return steps()  -- returns: 21

return steps()  -- returns: 22

return steps()  -- returns: 23

return steps()  -- returns: 24

return steps()  -- returns: 25

return steps()  -- returns: 26

return steps()  -- returns: 27

return steps()  -- returns: 28

return steps()  -- returns: 29

return steps()  -- returns: 30

return steps()  -- returns: 31

return steps()  -- returns: 32

return steps()  -- returns: 33

return steps()  -- returns: 34

return steps()  -- returns: 35

return steps()  -- returns: 36

return steps()  -- returns: 37

return steps()  -- returns: 38

return steps()  -- returns: 39

return steps()  -- returns: 40

return steps()  -- returns: 41

return steps()  -- returns: 42

return steps()  -- returns: 43

return steps()  -- returns: 44

return steps()  -- returns: 45

return steps()  -- returns: 46

return steps()  -- returns: 47

return steps()  -- returns: 48

return steps()  -- returns: 49

return steps()  -- returns: 50

return steps()  -- returns: 51

return steps()  -- returns: 52

return steps()  -- returns: 53

return steps()  -- returns: 54

return steps()  -- returns: 55

return steps()  -- returns: 56

return steps()  -- returns: 57

return steps()  -- returns: 58

return steps()  -- returns: 59

return steps()  -- returns: 60

return steps()  -- returns: 61

return steps()  -- returns: 62

return steps()  -- returns: 63

return steps()  -- returns: 64

return steps()  -- returns: 65

return steps()  -- returns: 66

return steps()  -- returns: 67

return steps()  -- returns: 68

return steps()  -- returns: 69

return steps()  -- returns: 70

return steps()  -- returns: 71

return steps()  -- returns: 72

return steps()  -- returns: 73

return steps()  -- returns: 74

return steps()  -- returns: 75

return steps()  -- returns: 76

return steps()  -- returns: 77

return steps()  -- returns: 78

return steps()  -- returns: 79

return steps()  -- returns: 80

return steps()  -- returns: 81

return steps()  -- returns: 82

return steps()  -- returns: 83

return steps()  -- returns: 84

return steps()  -- returns: 85

return steps()  -- returns: 86

return steps()  -- returns: 87

return steps()  -- returns: 88

return steps()  -- returns: 89

return steps()  -- returns: 90

return steps()  -- returns: 91

return steps()  -- returns: 92

return steps()  -- returns: 93

return steps()  -- returns: 94

return steps()  -- returns: 95

return steps()  -- returns: 96

return steps()  -- returns: 97

return steps()  -- returns: 98

return steps()  -- returns: 99

--- An error in a coroutine gives its line.
local c = coroutine.wrap(function()
  local x = nil + 1  -- error: attempt to perform arithmetic on a nil value
end)
c()

local c = coroutine.create(function()
  error('stop')
end)
assert(coroutine.resume(c))  -- error: box.lua:2: stop
