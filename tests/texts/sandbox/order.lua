-- pairs and next in the sandbox: the order is always the same.

--- next continues from any key.
local t = { 10, 20, x = 1, y = 2, [-5] = 3 } return next(t), next(t, 1), next(t, 2), next(t, -5), next(t, 'x'), next(t, 'y'), next(t, 'w')
-- returns: 1 2 -5 x y nil x 1

return next({}), next({}, 1), next({}, 'x'), next({ a = 1 }), next({ b = 1, a = 2 })  -- returns: nil nil nil a a 2

local t = { b = 1, a = 2 } local n = 0 while next(t) do t[next(t)] = nil n = n + 1 end return n  -- returns: 2

return next(1)  -- error: bad argument #1 to 'next' (table expected, got number)

return next(string)  -- returns: byte function

local t = { [2] = 1, [2.5] = 1, [3] = 1 } local u = { [4] = 1 } local a = next(t) next(u) return a, next(t, a)
-- returns: 2 2.5 1

--- A key that can't be ordered is an error.
local t = { [{}] = 1 } for k in pairs(t) do end
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { a = 1, [print] = 1 } for k in pairs(t) do end
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { a = 1, [coroutine.create(print)] = 1 } for k in pairs(t) do end
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { [{}] = 1 } for k in next, t do end
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { a = 1, [print] = 1 } for k in next, t do end
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { a = 1, [coroutine.create(print)] = 1 } for k in next, t do end
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { [{}] = 1 } next(t)
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { a = 1, [print] = 1 } next(t)
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { a = 1, [coroutine.create(print)] = 1 } next(t)
-- error: a table with a table or function as a key can't be traversed: use numbers, strings or booleans as keys

local t = { [{}] = 1 } return t[1], #t, select('#', table.unpack(t))  -- returns: nil 0 0

--- pairs uses __pairs, and accepts only tables.
local t = setmetatable({}, { __pairs = function(t) return function(_, k) if not k then return 1, 'one' end end, t, nil end }) for k, v in pairs(t) do return k, v end
-- returns: 1 one

local c = coroutine.wrap(function() for k in pairs(setmetatable({}, { __pairs = function() coroutine.yield('inside') return next, {} end })) do end return 'done' end) return c(), c()
-- returns: inside done

pairs(nil)  -- error: bad argument #1 to 'pairs' (table expected, got nil)

pairs()  -- error: bad argument #1 to 'pairs' (table expected, got no value)

local t = setmetatable({ 1 }, { __index = { 1, 2, x = 1 } }) local n = 0 for k in pairs(t) do n = n + 1 end return n
-- returns: 1

local t = setmetatable({ 1 }, { __index = function(t, i) if i < 4 then return i end end }) local n = 0 for k in ipairs(t) do n = n + 1 end return n
-- returns: 3

--- pairs and next visit 1 to n, other numbers, strings, false and true, in this order.
local each = pairs local t = { x = 1, a = 2, [true] = 3, [false] = 4, 10, 20, 30, [-1] = 5, [2.5] = 6, [100] = 7, [0] = 8, [1e300] = 9, [-math.huge] = 1, [math.huge] = 1, [math.mininteger] = 1, [math.maxinteger] = 1, [''] = 1, aa = 1, A = 1, ['a-b'] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 1 2 3 -inf -9223372036854775808 -1 0 2.5 100 9223372036854775807 1e+300 inf  A a a-b aa x false true

local each = function(t) return next, t, nil end local t = { x = 1, a = 2, [true] = 3, [false] = 4, 10, 20, 30, [-1] = 5, [2.5] = 6, [100] = 7, [0] = 8, [1e300] = 9, [-math.huge] = 1, [math.huge] = 1, [math.mininteger] = 1, [math.maxinteger] = 1, [''] = 1, aa = 1, A = 1, ['a-b'] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 1 2 3 -inf -9223372036854775808 -1 0 2.5 100 9223372036854775807 1e+300 inf  A a a-b aa x false true

local each = pairs local t = { 1, 2, nil, 4, 5 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 1 2 4 5

local each = function(t) return next, t, nil end local t = { 1, 2, nil, 4, 5 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 1 2 4 5

local each = pairs local t = { [2] = 1, [3] = 1, [2.5] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 2 2.5 3

local each = function(t) return next, t, nil end local t = { [2] = 1, [3] = 1, [2.5] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 2 2.5 3

local each = pairs local t = { [5] = 1, [6] = 1, [5.5] = 1, [-2] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: -2 5 5.5 6

local each = function(t) return next, t, nil end local t = { [5] = 1, [6] = 1, [5.5] = 1, [-2] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: -2 5 5.5 6

local each = pairs local t = { 1, 1, 1, [-2] = 1, [1.5] = 1, [7] = 1, [0] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 1 2 3 -2 0 1.5 7

local each = function(t) return next, t, nil end local t = { 1, 1, 1, [-2] = 1, [1.5] = 1, [7] = 1, [0] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 1 2 3 -2 0 1.5 7

local each = pairs local t = { [2^53] = 1, [2^53 + 1] = 1, [math.maxinteger] = 1, [2^63] = 1, [0.5] = 1, [-0.5] = 1, [0] = 1, [-1] = 1, [-1.5] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: -1.5 -1 -0.5 0 0.5 9007199254740992 9223372036854775807 9.2233720368548e+18

local each = function(t) return next, t, nil end local t = { [2^53] = 1, [2^53 + 1] = 1, [math.maxinteger] = 1, [2^63] = 1, [0.5] = 1, [-0.5] = 1, [0] = 1, [-1] = 1, [-1.5] = 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: -1.5 -1 -0.5 0 0.5 9007199254740992 9223372036854775807 9.2233720368548e+18

local each = pairs local t = {} local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')

local each = function(t) return next, t, nil end local t = {} local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')

local each = pairs local t = { 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 1

local each = function(t) return next, t, nil end local t = { 1 } local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')
-- returns: 1

--- The order does not depend on how a table was made.
local each = pairs local t = {} for i = 1, 300 do t['k' .. i] = i t[i * 3] = i t[-i] = i t[i + 0.5] = i end for i = 1, 300, 2 do t['k' .. i] = nil end local last for k in each(t) do if type(last) == type(k) then assert(last < k) end last = k end local n = 0 for k, v in each(t) do assert(t[k] == v) n = n + 1 end return n
-- returns: 1050

local each = function(t) return next, t, nil end local t = {} for i = 1, 300 do t['k' .. i] = i t[i * 3] = i t[-i] = i t[i + 0.5] = i end for i = 1, 300, 2 do t['k' .. i] = nil end local last for k in each(t) do if type(last) == type(k) then assert(last < k) end last = k end local n = 0 for k, v in each(t) do assert(t[k] == v) n = n + 1 end return n
-- returns: 1050

--- Fields may be cleared and assigned during a traversal.
local each = pairs local t = { 1, 2, 3, 4, a = 1, b = 2, [-3] = 1, [9] = 1, [2.5] = 1, [true] = 1 } local n = 0 for k in each(t) do t[k] = nil n = n + 1 end return n, rawlen(t), next(t)
-- returns: 10 0 nil

local each = function(t) return next, t, nil end local t = { 1, 2, 3, 4, a = 1, b = 2, [-3] = 1, [9] = 1, [2.5] = 1, [true] = 1 } local n = 0 for k in each(t) do t[k] = nil n = n + 1 end return n, rawlen(t), next(t)
-- returns: 10 0 nil

local each = pairs local t = { 1, 2, 3, 4, a = 1, b = 2, [-3] = 1, [9] = 1, [2.5] = 1, [true] = 1 } local n = 0 for k, v in each(t) do t[k] = v + 1 n = n + v end return n, t[1], t.a
-- returns: 17 2 2

local each = function(t) return next, t, nil end local t = { 1, 2, 3, 4, a = 1, b = 2, [-3] = 1, [9] = 1, [2.5] = 1, [true] = 1 } local n = 0 for k, v in each(t) do t[k] = v + 1 n = n + v end return n, t[1], t.a
-- returns: 17 2 2

local each = pairs local t = { 1, 2, 3, 4, a = 1, b = 2, [-3] = 1, [9] = 1, [2.5] = 1, [true] = 1 } local n = 0 for k in each(t) do n = n + 1 for j in pairs(t) do if j ~= k then t[j] = nil end end end return n
-- returns: 1

local each = function(t) return next, t, nil end local t = { 1, 2, 3, 4, a = 1, b = 2, [-3] = 1, [9] = 1, [2.5] = 1, [true] = 1 } local n = 0 for k in each(t) do n = n + 1 for j in pairs(t) do if j ~= k then t[j] = nil end end end return n
-- returns: 1

local each = pairs local t = { 1, 2, 3, 4, 5, 6 } local out = '' for k, v in each(t) do out = out .. v if v % 2 == 0 then t[k] = nil end end return out
-- returns: 123456

local each = function(t) return next, t, nil end local t = { 1, 2, 3, 4, 5, 6 } local out = '' for k, v in each(t) do out = out .. v if v % 2 == 0 then t[k] = nil end end return out
-- returns: 123456

local each = pairs local t = { 1, 2, 3, 4 } local out = '' for k in each(t) do out = out .. k t[2] = nil end return out
-- returns: 134

local each = function(t) return next, t, nil end local t = { 1, 2, 3, 4 } local out = '' for k in each(t) do out = out .. k t[2] = nil end return out
-- returns: 134

local each = pairs local t = { [5] = 1, [6] = 1, [5.5] = 1, [7] = 1 } local out = '' for k in each(t) do out = out .. k .. ' ' t[k] = nil end return out
-- returns: 5 5.5 6 7

local each = function(t) return next, t, nil end local t = { [5] = 1, [6] = 1, [5.5] = 1, [7] = 1 } local out = '' for k in each(t) do out = out .. k .. ' ' t[k] = nil end return out
-- returns: 5 5.5 6 7

--- A table may be traversed within its own traversal.
local each = pairs local t = { 1, 2, a = 1, b = 1, [-1] = 1, [3.5] = 1 } local n = 0 for k in each(t) do for j in each(t) do n = n + 1 end end return n
-- returns: 36

local each = function(t) return next, t, nil end local t = { 1, 2, a = 1, b = 1, [-1] = 1, [3.5] = 1 } local n = 0 for k in each(t) do for j in each(t) do n = n + 1 end end return n
-- returns: 36

local each = pairs local t = { 1, 2, a = 1, b = 1 } local n = 0 for k in each(t) do for j in each(t) do n = n + 1 break end end return n
-- returns: 4

local each = function(t) return next, t, nil end local t = { 1, 2, a = 1, b = 1 } local n = 0 for k in each(t) do for j in each(t) do n = n + 1 break end end return n
-- returns: 4

local each = pairs local t, u = { a = 1, b = 1, c = 1 }, { x = 1, y = 1 } local out = '' for k in each(t) do for j in each(u) do out = out .. k .. j .. ' ' end end return out
-- returns: ax ay bx by cx cy

local each = function(t) return next, t, nil end local t, u = { a = 1, b = 1, c = 1 }, { x = 1, y = 1 } local out = '' for k in each(t) do for j in each(u) do out = out .. k .. j .. ' ' end end return out
-- returns: ax ay bx by cx cy

local t = { 1, 2, a = 1 } local f, s = pairs(t) local n = 0 for k in f, s do n = n + 1 end for k in f, s do n = n + 1 end return n, s == t
-- returns: 6 true

--- A sparse table is traversed in time.
local each = pairs local t = {} for i = 1, 20000 do t[i * 2] = i t['k' .. i] = i end local n = 0 for k in each(t) do n = n + 1 end return n
-- returns: 40000

local each = function(t) return next, t, nil end local t = {} for i = 1, 20000 do t[i * 2] = i t['k' .. i] = i end local n = 0 for k in each(t) do n = n + 1 end return n
-- returns: 40000
