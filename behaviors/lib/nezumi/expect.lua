--- What modules say of an argument that is wrong: one line, at the line that called the module's function.
--- Every check is to be called by that function itself: `error` counts the calls in between.

local expect = {}

local function got(value)
  if value == nil then return "nothing" end
  return type(value) == "number" and tostring(value) or type(value)
end

local function is_finite(value) return type(value) == "number" and value - value == 0 end

--- `what` is the argument as its user knows it: "angles.wrap: angle".
---@param what string
---@return number
function expect.number(what, value)
  if not is_finite(value) then error(("%s expected a finite number, got %s"):format(what, got(value)), 3) end
  return value
end

---@param what string
---@return number
function expect.positive(what, value)
  if not is_finite(value) or value <= 0 then
    error(("%s expected a number above 0, got %s"):format(what, got(value)), 3)
  end
  return value
end

---@param what string
---@return number
function expect.not_negative(what, value)
  if not is_finite(value) or value < 0 then
    error(("%s expected a number from 0 on, got %s"):format(what, got(value)), 3)
  end
  return value
end

---@param what string
---@param least integer
---@param most integer
---@return integer
function expect.whole(what, value, least, most)
  local number = type(value) == "number" and math.tointeger(value)
  if not number or number < least or number > most then
    error(("%s expected a whole number from %d to %d, got %s"):format(what, least, most, got(value)), 3)
  end
  return number
end

--- A value of this Lua type: "table", "boolean", "function", "string".
---@param what string
---@param kind string
function expect.kind(what, value, kind)
  if type(value) ~= kind then error(("%s expected a %s, got %s"):format(what, kind, got(value)), 3) end
  return value
end

--- A table with no other fields than these.
---@param what string
---@param fields string[]
---@return table
function expect.fields(what, value, fields)
  if type(value) ~= "table" then error(("%s expected a table, got %s"):format(what, got(value)), 3) end
  for name in pairs(value) do
    local known = false
    for _, field in ipairs(fields) do known = known or name == field end
    if not known then
      error(("%s has no '%s': it has %s"):format(what, tostring(name), table.concat(fields, ", ")), 3)
    end
  end
  return value
end

return expect
