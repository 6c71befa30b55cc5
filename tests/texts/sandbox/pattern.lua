-- Patterns in the sandbox: they end in time.

--- The steps of patterns are counted for each call into Lua.
local s = ('a'):rep(1000) for i = 1, 3 do s:find('.-b') end return 'done'  -- returns: done

--- Searches in long texts end in time.
return #('x'):rep(1000000):gsub('x', 'yy')  -- returns: 2000000

return ('x'):rep(10000000):find('y')  -- returns: nil

return ('x'):rep(10000000):find('.', 1, true)  -- returns: nil

local n = 0 for _ in ('a b '):rep(100000):gmatch('%w+') do n = n + 1 end return n  -- returns: 200000

--- A function that gsub calls may use patterns itself.
return (('abc'):gsub('.', function(c) return ('xyz'):gsub('.', function(d) return c .. d end) end))
-- returns: axayazbxbybzcxcycz

return pcall(string.gsub, 'abc', '.', function() error('stop', 0) end)  -- returns: false stop

return coroutine.wrap(function() return pcall(string.gsub, 'abc', '.', coroutine.yield) end)()
-- returns: false attempt to yield across a C-call boundary
