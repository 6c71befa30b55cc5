-- Words of scenarios: mistakes are found in the text, before anything runs. `if nil` keeps correct texts from running.

--- The message about an unknown word gives its place and the nearest word.
scenario('a', function(s)
  s:rum(1) s:run(1)
--  ^ error: s has no 'rum' (did you mean 'run'?)
  if s then s:chek(1) end
--            ^ error: s has no 'chek' (did you mean 'check'?)
end)

scenario('a', { sweep = { f = { 1, 2 } } }, function(it, p) it:rum() end)
--                                                             ^ error: it has no 'rum' (did you mean 'run'?)

scenario('a', function(s) local function g() s:rum() end for i = 1, 2 do g() end end)
--                                             ^ error: s has no 'rum' (did you mean 'run'?)

scenario('a', function(s) s:run(1) end)
scenario('b', function(t) t:rum() end)
--                          ^ error: t has no 'rum' (did you mean 'run'?)

scenario('a', function(s) repeat local x = 1 until x s:rum() end)
--                                                     ^ error: s has no 'rum' (did you mean 'run'?)

--- A local variable with the name of the scenario hides it.
scenario('a', function(s) local a
s:rum() end)
--^ error: s has no 'rum' (did you mean 'run'?)

scenario('a', function(s) local a <const>, b; s:rum() end)
--                                              ^ error: s has no 'rum' (did you mean 'run'?)

scenario('a', function(s) do local s = 1 s:rum() end s:chek() end)
--                                                     ^ error: s has no 'chek' (did you mean 'check'?)

scenario('a', function(s) if s then local s = 1 s:rum() else s:chek() end end)
--                                                             ^ error: s has no 'chek' (did you mean 'check'?)

scenario('a', function(s) for s in print do s:rum() end s:chek() end)
--                                                        ^ error: s has no 'chek' (did you mean 'check'?)

local f = print
scenario('a', function(s) if nil then f(function(s) s:rum() end) local function s() end s:rum() end end)

local other = {}
scenario('a', function(s) if nil then local s = other s:rum() end end)

scenario('a', function(s) if nil then local a, s = 1, 2 s:rum() end end)

scenario('a', function(s) if nil then for _, s in pairs(s) do s:rum() end end end)

--- Functions that get the scenario as an argument are checked as well.
local function body(t) t:rum() end
--                       ^ error: t has no 'rum' (did you mean 'run'?)
scenario('a', {}, body)
scenario('b', body)

local body = function(t) t:rum() end
--                         ^ error: t has no 'rum' (did you mean 'run'?)
scenario('a', body)

local function f(x, t) t:rum() end
--                       ^ error: t has no 'rum' (did you mean 'run'?)
scenario('a', function(s) f({ 1, s }, s) f(s.mouse, 2) end)

local function g(t) t:rum() end local function f(it) g(it) end
--                    ^ error: t has no 'rum' (did you mean 'run'?)
scenario('a', function(s) f(s) end)

--- Functions that do not get the scenario are not checked.
local x, f = {}, function(t) t:rum() end
scenario('a', function(s) if nil then f(s.mouse) f(x, s) x.f(s) end end)

local f = function() return function() end end
scenario('a', f())

local s = {}
local function f() if nil then s:rum() end end
scenario('a', f)

--- A scenario is also checked under the name of another local variable.
scenario('a', function(s) local w = s w:rum() do local v <const> = w; v:chek() end end)
--                                      ^ error: w has no 'rum' (did you mean 'run'?)
--                                                                      ^ error: v has no 'chek' (did you mean 'check'?)

scenario('a', function(s) local s = s s:rum() end)
--                                      ^ error: s has no 'rum' (did you mean 'run'?)

local f = print
scenario('a', function(s) f { s = s } s:rum() end)
--                                      ^ error: s has no 'rum' (did you mean 'run'?)

scenario('a', function(s) if nil then local w = s.mouse w:rum() local v = s or w v:rum() end end)

local other = {}
scenario('a', function(s) if nil then s = other s:rum() end end)

--- A seed is an option, not a method.
scenario('a', function(s) s:seed(3) end)
--                          ^ error: s has no 'seed': the option seed = N of the scenario gives its runs one, and s.seed reads it

--- Text that only looks like a word of the scenario is accepted.
local x, y = {}, {}
-- s:rum()
scenario('a', function(s) if nil then print('s:rum()') x.s:rum() y:s() s.rum() s.mouse:rum() end end)
