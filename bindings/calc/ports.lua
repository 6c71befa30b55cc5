--- The part of the spreadsheet's link that runs in the system: lists ports, reads them and writes to in-ports.
--- It runs in a console session of its own; an answer is JSON, printed in pieces.

local longest_text, longest_piece = 1000, 1500 -- bytes
-- Types that are sent only when they change: otherwise a text would be spoken, and a pose set, ten times a second.
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

-- `print` shortens long texts, so an answer is printed in pieces. A piece never ends within a UTF-8 character.
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

local told = {} -- by type: its fields

-- The fields only where they are new: a saved definition may change them.
local function describe(port)
  local fields = port.fields
  local known = table.concat(fields, "\n")
  if told[port.type] == known then fields = nil end
  told[port.type] = known
  return {
    type = port.type, fields = fields, direction = port.direction, value = port.value, came = port.count > 0, tm = port.tm,
    stale = port.stale, override = port.override, peers = port.peers,
  }
end

local paths = {}
local fed, fed_at = {}, {} -- by path

-- While time stands still, a value is sent only once, or queues would fill.
local function feed(port, value)
  local path, text = port.path, json(value)
  local is_once = once[port.type] == true
  if text == fed[path] and (is_once or fed_at[path] == now()) then return is_once end
  fed[path] = nil
  port:inject(value)
  fed[path], fed_at[path] = text, now()
  return is_once
end

-- What a port carried after `since`, at most one message each `every` seconds, of these the last `most`; nothing where
-- it begins now.
local function logged(path, want)
  if want.since == nil then return nil end
  local all = samples(path, want.since, want.every and 6000 or want.most)
  local rows, last = {}, want.since
  for _, row in ipairs(all.rows) do
    local is_due = not want.every or math.floor(row[1] / want.every + 1e-6) > math.floor(last / want.every + 1e-6)
    if is_due then
      for label, is_text in ipairs(all.are_texts) do
        if is_text then row[label + 1] = all.texts[math.tointeger(row[label + 1])] end
      end
      rows[#rows + 1], last = row, row[1]
    end
  end
  return { labels = all.labels, rows = table.move(rows, math.max(1, #rows - want.most + 1), #rows, 1, {}) }
end

--- All ports: path, type, direction, description, value.
function calc_ports()
  local all = {}
  for name, component in pairs(world) do
    for _, port in pairs(component.ports) do
      local seen = describe(port)
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

--- Sets the ports that the next refreshes read and write.
function calc_bind(new_paths) paths = new_paths end

--- Sends `values[i]` to port i, or each of `plays[i]`, then reads all ports, and of `logs[i]` what it carried. A port that
--- does not exist, or refuses its value, has an error.
function calc_refresh(values, plays, logs)
  local seen = {}
  for i, path in ipairs(paths) do
    local port, unknown = try(find_port, path)
    if port then
      local sent, refused
      for place, value in ipairs(plays[i] or { values[i] }) do
        if place > 1 then fed[path] = nil end -- each row is a message, also if it is the same as the one before
        sent, refused = try(feed, port, value)
      end
      if values[i] == nil and not plays[i] then fed[path] = nil end
      seen[i] = try(describe, port) or { error = path .. " is gone" }
      if logs[i] then seen[i].samples = try(logged, path, logs[i]) end
      seen[i].once, seen[i].error = sent, seen[i].error or refused
    else
      seen[i] = { error = unknown }
    end
  end
  answer { now = now(), ports = seen }
end
