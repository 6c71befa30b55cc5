-- The library of the sandbox: what differs from Lua, and what is the same.

--- string.format works as in Lua, but shows no addresses.
return ('%5.2f|%-5d|%05d|%x|%g|%s|%q|%c|%i|%a|%%|%.3s'):format(3.14159, 42, 42, 255, 0.1, nil, 'a\n', 65, 7, 1, 'abcdef')
-- returns:  3.14|42   |00042|ff|0.1|nil|"a\\n"|A|7|0x1p+0|%|abc

return ('%d'):format('10'), ('%s'):format(1.0), ('%s %s'):format(true, 2)  -- returns: 10 1.0 true 2

return ('%d'):format(1.5)  -- error: bad argument #1 to 'format' (number has no integer representation)

return ('%y'):format(1)  -- error: invalid conversion '%y' to 'format'

return ('%s'):format()  -- error: bad argument #1 to 'format' (no value)

return ('%'):format()  -- error: bad argument #1 to 'format' (no value)

return #('%s'):format(('x'):rep(1000))  -- returns: 1000

--- The tables of the library can't be changed.
string.rep = nil  -- error: can't set 'string.rep': 'string' is read-only

return ('ab'):rep(2), string.rep('ab', 2), math.pi, rawget(math, 'pi'), table.extra, #table, getmetatable(''), getmetatable(math), rawlen(table)
-- returns: abab abab 3.1415926535898 3.1415926535898 nil 0 false false 0

rawset(string, 'rep', nil)  -- error: rawset: the table is read-only

math.pi = 3  -- error: can't set 'math.pi': 'math' is read-only

table.extra = 1  -- error: can't set 'table.extra': 'table' is read-only

rawset(string, 'rep', 1)  -- error: rawset: the table is read-only

setmetatable(math, {})  -- error: cannot change a protected metatable

setmetatable(math, nil)  -- error: cannot change a protected metatable

getmetatable('').__index = nil  -- error: attempt to index a boolean value

getmetatable('').__index.rep = nil  -- error: attempt to index a boolean value

getmetatable(math).__index.pi = 3  -- error: attempt to index a boolean value

getmetatable(string).__newindex = nil  -- error: attempt to index a boolean value

table.insert(math, 1)  -- error: can't set 'math[1]': 'math' is read-only

table.sort(setmetatable(math, nil))  -- error: cannot change a protected metatable

table.move({ 1 }, 1, 1, 1, math)  -- error: can't set 'math[1]': 'math' is read-only

setmetatable('', {})  -- error: bad argument #1 to 'setmetatable' (table expected, got string)

local f, s = pairs(math) s.pi = 3  -- error: can't set 'math.pi': 'math' is read-only

local f, s = pairs(math) rawset(s, 'pi', 3)  -- error: rawset: the table is read-only

for k in pairs(math) do math[k] = nil end  -- error: can't set 'math.abs': 'math' is read-only

('x').y = 1  -- error: attempt to index a string value (constant 'x')

coroutine.wrap = nil  -- error: can't set 'coroutine.wrap': 'coroutine' is read-only

utf8.x = 1  -- error: can't set 'utf8.x': 'utf8' is read-only

--- Only a function can be called with __call.
return setmetatable({}, { __call = function(_, x) return x + 1 end })(1)  -- returns: 2

local k = {} setmetatable(k, { __call = k })  -- error: setmetatable: '__call' expected a function, got table

setmetatable({}, { __call = 'x' })  -- error: setmetatable: '__call' expected a function, got string

--- Finalizers and weak tables are refused.
setmetatable({}, { __gc = function() end })
-- error: setmetatable: '__gc' is refused: a finalizer that never ends could not be stopped

setmetatable({}, { __gc = false })  -- error: setmetatable: '__gc' is refused: a finalizer that never ends could not be stopped

setmetatable({}, { __mode = 'k' })
-- error: setmetatable: '__mode' is refused: the contents of a weak table would differ from run to run

ran = 'no'
for i = 1, 1000 do
  local m = {}
  local t = setmetatable({}, m)
  m.__gc = function() ran = 'yes' while true do end end
end

return ran  -- returns: no

local t = setmetatable({}, { __metatable = 'locked' }) return getmetatable(t), pcall(setmetatable, t, {})
-- returns: locked false cannot change a protected metatable

return setmetatable({}, nil) ~= nil, pcall(setmetatable, {}, 1)
-- returns: true false bad argument #2 to 'setmetatable' (nil or table expected, got number)

local mt = setmetatable({}, { __index = { __gc = 1 } }) return type(setmetatable({}, mt))  -- returns: table

--- The functions of table work as in Lua.
local t = { 1, 2, 3 } table.insert(t, 4) table.insert(t, 1, 0) return table.concat(t, ',')  -- returns: 0,1,2,3,4

local t = { 1, 2, 3 } return table.remove(t), table.remove(t, 1), #t, table.remove({}), table.remove({}, 0)
-- returns: 3 1 1 nil nil

local t = { 1, 2, 3 } return table.remove(t, 4), pcall(table.remove, t, 6)
-- returns: nil false bad argument #2 to 'table.remove' (position out of bounds)

return pcall(table.insert, { 1 }, 3, 1)  -- returns: false bad argument #2 to 'table.insert' (position out of bounds)

return pcall(table.insert, { 1 })  -- returns: false wrong number of arguments to 'insert'

return table.concat(table.move({ 1, 2, 3 }, 1, 3, 2), ','), table.concat(table.move({ 1, 2, 3 }, 2, 3, 1), ','), table.concat(table.move({ 1, 2, 3 }, 1, 3, 1, {}), ',')
-- returns: 1,1,2,3 2,3,3 1,2,3

return table.concat({ 1, 2.5, 'x' }, '-', 2, 3), table.concat({}), table.concat({ 1 }, ',', 2)  -- returns: 2.5-x

return table.concat({ 1, {}, 3 })  -- error: invalid value (at index 2) in table for 'concat'

return table.concat({ [math.maxinteger] = 'x' }, '', math.maxinteger, math.maxinteger)  -- returns: x

return table.unpack({ 1, 2, 3 }, 2), table.unpack({ 1, 2 }, 1, 3)  -- returns: 2 1 2 nil

return table.pack(1, nil, 3).n  -- returns: 3

return table.insert('x', 1)  -- error: bad argument #1 to 'insert' (table expected, got string)

local log = {} local t = setmetatable({}, { __index = function(_, k) return k * 10 end, __newindex = function(_, k, v) log[#log + 1] = k .. '=' .. v end, __len = function() return 2 end }) table.insert(t, 1, 5) return table.concat(log, ' ')
-- returns: 3=20 2=10 1=5

--- table.sort is stable, and safe with every comparison.
local t = {} for i = 1, 100 do t[i] = { i % 3, i } end table.sort(t, function(a, b) return a[1] < b[1] end) for i = 2, 100 do if t[i - 1][1] == t[i][1] and t[i - 1][2] > t[i][2] then return 'not stable' end if t[i - 1][1] > t[i][1] then return 'not sorted' end end return 'stable'
-- returns: stable

local t = { 3, 1.5, -2, 2^53, 0 } table.sort(t) return table.concat(t, ' ')  -- returns: -2 0 1.5 3 9.007199254741e+15

local t = { math.maxinteger, math.maxinteger - 1, 2^62, math.mininteger } table.sort(t) return t[3] - t[4], t[1] == math.mininteger
-- returns: -1 true

local t = { 'b', 'a\0c', 'a', 'B', '' } table.sort(t) return table.concat(t, '|')  -- returns: |B|a|a\x00c|b

local t = { 3, 'x' } table.sort(t)  -- error: attempt to compare string with number

local t = { 2, nil, 1 } table.sort(t)  -- error: attempt to compare nil with number

local t = { 0/0, 1, 0/0, -1 } table.sort(t) return #t  -- returns: 4

local t = {} for i = 1, 1000 do t[i] = i end local calls = 0 table.sort(t, function(a, b) calls = calls + 1 return true end) local sum = 0 for _, v in ipairs(t) do sum = sum + v end return #t, sum, calls < 11000
-- returns: 1000 500500 true

local t = {} for i = 1, 1000 do t[i] = i end local calls = 0 table.sort(t, function(a, b) calls = calls + 1 return false end) local sum = 0 for _, v in ipairs(t) do sum = sum + v end return #t, sum, calls < 11000
-- returns: 1000 500500 true

local t = {} for i = 1, 1000 do t[i] = i end local calls = 0 table.sort(t, function(a, b) calls = calls + 1 return math.random() < 0.5 end) local sum = 0 for _, v in ipairs(t) do sum = sum + v end return #t, sum, calls < 11000
-- returns: 1000 500500 true

local t = {} for i = 1, 1000 do t[i] = i end local calls = 0 table.sort(t, function(a, b) calls = calls + 1 return a ~= b end) local sum = 0 for _, v in ipairs(t) do sum = sum + v end return #t, sum, calls < 11000
-- returns: 1000 500500 true

local t = { 3, 2, 1 } return pcall(table.sort, t, function() error('stop', 0) end), table.concat(t, ' ')  -- returns: false 3 2 1

local t = { 5, 4, 3, 2, 1 } table.sort(t, function(a, b) for i = 1, 10 do t[i] = nil end return a < b end) return table.concat(t, ' ')
-- returns: 1 2 3 4 5

local M = { __lt = function(a, b) return a.v < b.v end } local t = {} for i = 1, 5 do t[i] = setmetatable({ v = -i }, M) end table.sort(t) return t[1].v, t[5].v
-- returns: -5 -1

table.sort({ 1, 2 }, 5)  -- error: bad argument #2 to 'sort' (function expected, got number)

table.sort({ 1 }, 5) table.sort({}) return 'short ones are sorted'  -- returns: short ones are sorted

local t = {} for i = 1, 200000 do t[i] = (i * 7919) % 200003 end table.sort(t) for i = 2, #t do if t[i - 1] > t[i] then return 'not sorted' end end return 'sorted'
-- returns: sorted

--- Strings are converted to numbers as in Lua.
return '10' + 1, '3' * '4', -'2', '7' // 2, '2' ^ 2, '7' % 4, '1' / 2, 10 - '1'  -- returns: 11 12 -2 3 4.0 3 0.5 9

return 'x' + 1  -- error: attempt to add a 'string' with a 'number'

--- pcall and xpcall work as in Lua.
return pcall(function(...) return select('#', ...), ... end, 1, nil, 3)  -- returns: true 3 1 nil 3

return pcall(error)  -- returns: false nil

return pcall(error, 'x', 0)  -- returns: false x

return pcall()  -- error: bad argument #1 to 'pcall' (value expected)

return pcall(1)  -- returns: false attempt to call a number value

return xpcall(function(...) return ... end, print, 1, 2)  -- returns: true 1 2

return xpcall(error, function(m) return '<' .. m .. '>' end, 'x', 0)  -- returns: false <x>

return xpcall(error, function(m) return m, 2 end, 'x', 0)  -- returns: false x

return xpcall(error)  -- error: bad argument #2 to 'xpcall' (function expected, got no value)

return xpcall(error, function() error('again') end)  -- returns: false error in error handling

local c = coroutine.wrap(function() return pcall(function() return coroutine.yield(1) end) end) return c(), c(2)
-- returns: 1 true 2

local c = coroutine.wrap(function() return xpcall(function() coroutine.yield(1) error('x', 0) end, string.upper) end) return c(), c()
-- returns: 1 false X

--- print shows tables as readable text.
print({ 1, 2.5, 'x', b = { c = true } }, 'text', {})  -- prints: { 1, 2.5, "x", b = { c = true } }  text  {}

local t = { 1 } t.me = t print(t)  -- prints: { 1, me = <cycle> }

print({ { { { { { { 7 } } } } } } })  -- prints: { { { { { { {...} } } } } } }

print(setmetatable({ 1 }, { __name = 'Robot' }), setmetatable({}, { __tostring = function() return 'mine' end }))
-- prints: { 1 }  mine

print(tostring({}))  -- prints: table: 1

--- A table that cannot be shown gives a text with the reason.
print({ [{}] = 1 }) return 'goes on'
-- prints: <can't be shown: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys>
-- returns: goes on

print({ setmetatable({}, { __tostring = function() error('no', 0) end }) }) return 'goes on'  -- prints: <can't be shown: no>
-- returns: goes on

--- Counts that are too large are refused at once.
return string.rep('x', 1 << 60)  -- error: resulting string too large

return string.rep('x', 1 << 40, 'y')  -- error: resulting string too large

return string.rep('', 1 << 60)  -- error: resulting string too large

return string.rep('', 1 << 60, '')  -- error: resulting string too large

return string.rep('', 1000) == ''  -- returns: true

return string.rep('', 1 << 60, 'x')  -- error: resulting string too large

return string.rep('x', -1), ('x'):rep(math.mininteger), ('ab'):rep(3, ', '), ('x'):rep(1, 'yyy')  -- returns:   ab, ab, ab x

return table.move({}, 1, 1 << 60, 2)  -- error: bad argument #3 to 'move' (too many elements to move)

return table.move({}, math.mininteger, math.maxinteger, 2)  -- error: bad argument #3 to 'move' (too many elements to move)

return table.move({}, 1, 3, math.maxinteger)  -- error: bad argument #4 to 'move' (destination wrap around)

return table.concat({}, '', 1, 1 << 60)  -- error: bad argument #1 to 'concat' (too many elements to concatenate)

return table.unpack({}, 1, 1 << 60)  -- error: too many results to unpack

return table.unpack({}, math.mininteger, math.maxinteger)  -- error: too many results to unpack

return table.unpack({}, 1, 1e7)  -- error: too many results to unpack

return select('#', table.unpack({}, 1, 200000))  -- returns: 200000

lying = setmetatable({}, { __len = function() return 1 << 60 end })

table.insert(lying, 1, 2)  -- error: bad argument #2 to 'insert' (too many elements to move)

table.remove(lying, 1)  -- error: bad argument #2 to 'remove' (too many elements to move)

table.sort(lying)  -- error: bad argument #1 to 'sort' (array too big)

table.concat(lying)  -- error: bad argument #1 to 'concat' (too many elements to concatenate)

table.unpack(lying)  -- error: too many results to unpack

table.sort(setmetatable({}, { __len = function() return 1 << 24 end }))
-- error: not enough memory: the script reached its limit of 64 MB

table.insert(setmetatable({}, { __len = function() return 'x' end }), 1)  -- error: object length is not an integer

table.insert(setmetatable({}, { __len = function() return math.maxinteger end }), 1) return 'done'  -- returns: done

return #string.pack((' '):rep(10000))  -- returns: 0

return string.packsize((' '):rep(10000))  -- returns: 0

return string.pack((' '):rep(10001))  -- error: bad argument #1 to 'pack' (format too long)

return string.packsize((' '):rep(10001))  -- error: bad argument #1 to 'packsize' (format too long)

return string.unpack((' '):rep(10001), '')  -- error: bad argument #1 to 'unpack' (format too long)

return string.pack((' '):rep(20000))  -- error: bad argument #1 to 'pack' (format too long)

return string.unpack((' '):rep(20000), '')  -- error: bad argument #1 to 'unpack' (format too long)

return select('#', ('x'):rep(1e7):byte(1, -1))  -- error: stack overflow (string slice too long)
