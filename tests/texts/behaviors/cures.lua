-- Mistakes at run time that are usual in a first script: the message says what to write instead.

--- A table that was never set is named as a possible cause.
function on_execute()
for _, value in ipairs(state.list) do print(value) end
-- error: bad argument #1 to 'ipairs' (table expected, got nil): was it set under this name? `x or {}` gives an empty table if x is nil
end

function on_execute()
for key in pairs(state.list) do print(key) end
-- error: bad argument #1 to 'pairs' (table expected, got nil): was it set under this name? `x or {}` gives an empty table if x is nil
end

--- A loop over a list needs ipairs.
function on_execute()
for value in { 1, 2 } do print(value) end
-- error: attempt to call a table value (for iterator 'for iterator'): write `for i, value in ipairs(list) do`
end

--- A list is not a number.
local near = input("near", "TimedShortSeq")
function on_execute()
if near:read() > 30 then print("near") end
-- error: attempt to compare number with table: a list is not a number: list[1] is its first element
end

--- A port is not its value.
local near = input("near", "TimedShortSeq")
function on_execute()
print(#near)  -- error: attempt to get length of a port value (upvalue 'near'): a port is not its value: read it first, with `:read()`
end

local level = input("level", "TimedDouble")
function on_execute()
print(level + 1)  -- error: attempt to perform arithmetic on a port value (upvalue 'level'): a port is not its value: read it first, with `:read()`
end

--- Texts are joined by two dots.
function on_execute()
print("count: " + 1)  -- error: attempt to add a 'string' with a 'number': .. joins strings in Lua
end
