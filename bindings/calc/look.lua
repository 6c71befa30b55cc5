--- What the spreadsheet's link asks of a system: which ports there are, what they carry, and to feed them.
--- Runs in the link's own console session; an answer is JSON, printed in pieces.

local longest_text, longest_piece = 1000, 1500 -- bytes
-- What is sent when it changes, not again and again: a text would be spoken ten times a second, a pose never left.
local once = { TimedString = true, TimedStringSeq = true, TimedPose2D = true }

local function quoted(text)
  if #text > longest_text then text = text:sub(1, longest_text) .. "..." end
  return '"' .. text:gsub('[%c"\\]', function(c) return ("\\u%04x"):format(c:byte()) end) .. '"'
end

local function json(value)
  local kind = math.type(value) or type(value)
  if kind == "integer" or kind == "boolean" then return tostring(value) end
  if kind == "float" then return math.abs(value) < math.huge and ("%.17g"):format(value) or "null" end
  if kind == "string" then return quoted(value) end
  if kind ~= "table" then return "null" end
  local parts = {}
  if next(value) == nil or value[1] ~= nil then
    for i, element in ipairs(value) do parts[i] = json(element) end
    return "[" .. table.concat(parts, ",") .. "]"
  end
  for key, element in pairs(value) do parts[#parts + 1] = quoted(key) .. ":" .. json(element) end
  return "{" .. table.concat(parts, ",") .. "}"
end

-- `print` shortens long texts. A piece does not end within a character.
local function answer(value)
  local text, at = json(value), 1
  while at <= #text do
    local last = math.min(at + longest_piece - 1, #text)
    while last < #text and text:byte(last + 1) & 0xC0 == 0x80 do last = last - 1 end
    print(text:sub(at, last))
    at = last + 1
  end
end

local function try(action, ...)
  local ok, message = pcall(action, ...)
  if ok then return message end
  return nil, (tostring(message):gsub("^console:%d+: ", ""))
end

local function find_port(path)
  local component, name = path:match("^([^.]+)%.(.+)$")
  return world[component].ports[name]
end

local function look(port)
  return {
    type = port.type, direction = port.direction, value = port.value, came = port.count > 0, tm = port.tm,
    stale = port.stale, override = port.override, peers = port.peers,
  }
end

local paths = {}
local fed, fed_at = {}, {} -- by path

-- What stands still gets nothing twice, and no queue fills.
local function feed(port, value)
  local path, text = port.path, json(value)
  local is_once = once[port.type] == true
  if text == fed[path] and (is_once or fed_at[path] == now()) then return is_once end
  fed[path] = nil
  port:inject(value)
  fed[path], fed_at[path] = text, now()
  return is_once
end

--- All ports: path, type, direction, description, value.
function calc_ports()
  local all = {}
  for name, component in pairs(world) do
    for _, port in pairs(component.ports) do
      local seen = look(port)
      seen.path, seen.doc = port.path, port.doc
      all[#all + 1] = seen
    end
  end
  answer(all)
end

--- An error about the first of these names that is neither a port nor a component.
function calc_check(names)
  for _, name in ipairs(names) do
    local _, unknown = try(name:find(".", 1, true) and find_port or function() return world[name].ports end, name)
    if unknown then error("--port: " .. unknown, 0) end
  end
end

--- Whose ports the next refreshes are about.
function calc_bind(new_paths) paths = new_paths end

--- Feeds `values[i]` to the port i, then looks at all. A port that is not there, or does not take its value, has an
--- error.
function calc_refresh(values)
  local seen = {}
  for i, path in ipairs(paths) do
    local port, unknown = try(find_port, path)
    if port then
      local value = values[i]
      local sent, refused
      if value ~= nil then
        sent, refused = try(feed, port, value)
      else
        fed[path] = nil
      end
      seen[i] = try(look, port) or { error = path .. " is gone" }
      seen[i].once, seen[i].error = sent, seen[i].error or refused
    else
      seen[i] = { error = unknown }
    end
  end
  answer { now = now(), ports = seen }
end
