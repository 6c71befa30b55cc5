-- Parameters that a behaviour declares, reads and sets: what is refused.

--- Undeclared parameters are refused, also in code that never runs.
param('speed_x', 0.0)
function on_execute() if now() > 1e9 then print(config.sped_x) end end
--                                                     ^ error: config: unknown parameter 'sped_x' (did you mean 'speed_x'?)

param('speed_x', 0.0)
function on_execute() if now() > 1e9 then       config.sped_x = 1 end end
--                                                     ^ error: config: unknown parameter 'sped_x' (did you mean 'speed_x'?)

param('speed_x', 0.0)
function on_execute() if now() > 1e9 then print(config.speed_x) end end

param('speed_x', 0.0)
function on_execute() if now() > 1e9 then local config = {} print(config.sped_x) end end

for i = 1, 2 do param('p' .. i, i) end function on_execute() print(config.p2) end  -- prints: info: 2

--- The message about an unknown parameter gives the nearest name.
param('speed_x', 0.0)
function on_execute()
return config['sped' .. '_x']  -- error: unknown parameter 'sped_x' (did you mean 'speed_x'?)
end

param('speed_x', 0.0)
function on_execute()
config['sped' .. '_x'] = 1  -- error: unknown parameter 'sped_x' (did you mean 'speed_x'?)
end

param('speed_x', 0.0)
function on_execute()
return config[1]  -- error: unknown parameter '1'
end

param('speed_x', 0.0)
function on_execute()
config.speed_x = {}  -- error: parameter 'speed_x' (number): expected number, got array of numbers {}
end

param('speed_x', 0.0)
function on_execute()
config.speed_x = print  -- error: parameter 'speed_x': expected a boolean, a number, a string or an array of them, got function
end

param('speed_x', 0.0)
function on_execute()
config.speed_x = 0/0  -- error: parameter 'speed_x' (number): nan is not a finite number
end

--- An array parameter is read-only, and is replaced as a whole.
param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })
function on_execute()
config.gains[1] = 3  -- error: can't set 'config.gains[1]': 'config.gains' is read-only
end

param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })
function on_execute()
assert(not pcall(rawset, config.gains, 1, 3)) assert(not pcall(table.insert, config.gains, 3))
end

param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })
function on_execute()
local n = 0 for i, v in ipairs(config.gains) do n = n + v end for _, v in pairs(config.gains) do n = n + v end assert(n == 3 and #config.gains == 2 and select('#', table.unpack(config.gains)) == 2)
end

param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })
function on_execute()
config.gains = { 1, 2, 0 }
end

param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })
function on_execute()
config.gains = { 3.0 }  -- error: parameter 'gains' (array of numbers): element 1: 3.0 is above its maximum 2.0
end

param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })
function on_execute()
config.gains = {}  -- error: parameter 'gains' (array of numbers): 0 elements are fewer than its min_size 1
end

param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })
function on_execute()
config.gains = { 1, 1, 1, 1 }  -- error: parameter 'gains' (array of numbers): 4 elements are more than its max_size 3
end

param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })
function on_execute()
config.gains = { 1, 'a' }  -- error: parameter 'gains': element 2 expected a number, as the first one, got string
end

--- pairs(config) works, and config itself can't be changed.
param('b', 2) param('a', 1)
function on_execute()
local s = '' for k, v in pairs(config) do s = s .. k .. v end assert(s == 'a1b2', s)
end

param('b', 2) param('a', 1)
function on_execute()
assert(getmetatable(config) == false and not pcall(rawset, config, 'a', 5) and not pcall(setmetatable, config, {}))
end

param('b', 2) param('a', 1)
function on_execute()
local function find() for k, v in pairs(config) do return config end end assert(find().a == 1)
end

--- A wrong declaration of a parameter is refused.
param('x', nil)  -- error: parameter 'x': its default expected a boolean, a number, a string or an array of them, got nil

param('x')  -- error: parameter 'x': its default expected a boolean, a number, a string or an array of them, got nil

param('x', {1, 'a'})  -- error: parameter 'x': its default element 2 expected a number, as the first one, got string

param('x', { a = 1 })  -- error: parameter 'x': its default expected an array (elements 1, 2, ...), got a table with the key 'a'

param('x', print)  -- error: parameter 'x': its default expected a boolean, a number, a string or an array of them, got function

param('x', 0/0)  -- error: parameter 'x' (number): nan is not a finite number, in its default

param('x', 1, { min = 2, max = 1 })  -- error: parameter 'x' (integer): min 2.0 is above max 1.0

param('x', 5, { max = 1 })  -- error: parameter 'x' (integer): 5 is above its maximum 1, in its default

param('x', 5, { min = math.huge })  -- error: parameter 'x': option 'min' expected a finite number, got inf

param('x', 5, { maxx = 1 })  -- error: parameter 'x': unknown option 'maxx' (did you mean 'max'?)

param('x', 5, { max = '1' })  -- error: parameter 'x': option 'max' expected a number, got string

param('x', 'a', { max = 1 })  -- error: parameter 'x': option 'max' is for numbers, and the parameter is of type string

param('x', 1, { min_size = 1 })  -- error: parameter 'x': option 'min_size' is for arrays, and the parameter is of type integer

param('x', 5, { max = 1e12 })

param('x', 5, { step = 0 })  -- error: parameter 'x': option 'step' expected a positive number, got 0

param('x', 5, { widget = 'slidr' })
-- error: parameter 'x': option 'widget' expected one of slider, spin, radio, checkbox, ordered_list, text, got 'slidr' (did you mean 'slider'?)

param('x', 5, { widget = 'slider' })  -- error: parameter 'x' (integer): the widget 'slider' is for numbers with min and max

param('x', 5, 'a text')  -- error: parameter 'x': options expected a table, got string

param('x', 'a', { choices = { 'left', 'right' } })
-- error: parameter 'x' (string): "a" is not one of its choices "left", "right", in its default

param('x', 1, { choices = { 1, 'c' } })  -- error: parameter 'x' (integer): expected integer, got string "c", in its choices

param('x', 1, { choices = {} })  -- error: parameter 'x': option 'choices' is empty: there is nothing to choose

param('x', 1, { choices = 3 })  -- error: parameter 'x': option 'choices' expected an array, got number

param(1, 1)  -- error: param: its name expected a string, got number

param('x', 1)
param('x', 2)  -- error: parameter 'x' is declared twice (first in line 1)

--- Choices of a parameter apply to every value that is set.
param('mode', 'slow', { choices = { 'slow', 'fast' } })
function on_execute()
config.mode = 'fast'
end

param('mode', 'slow', { choices = { 'slow', 'fast' } })
function on_execute()
config.mode = 'fsat'  -- error: parameter 'mode' (string): "fsat" is not one of its choices "slow", "fast" (did you mean 'fast'?)
end
