--- A LiDAR on a serial line: the frame of its data sheet, whole, torn, and in a turn.

local FRAME = "\x54\x2C\x68\x08\xAB\x7E\xE0\x00\xE4\xDC\x00\xE2\xD9\x00\xE5\xD5\x00\xE3\xD3\x00\xE4\xD0\x00\xE9\xCD\x00\xE4"
  .. "\xCA\x00\xE2\xC7\x00\xE9\xC5\x00\xE5\xC2\x00\xE5\xC0\x00\xE5\xBE\x82\x3A\x1A\x50"

local function load(s)
  s:component "lidar" { type = "Serial", config = { path = "/dev/ttyUSB0", baud = 230400, measures_only = true } }
  local scanner = s:behavior "scanner" { script = "ld06" }
  s:connect("lidar.out", "scanner.bytes")
  s:run(0.02)
  return scanner
end

-- A frame of the same format, of 12 points at one distance.
local function frame(first, last, millimetres)
  local text = "\x54\x2C" .. string.pack("<I2I2", 3600, first) .. string.pack("<I2B", millimetres, 200):rep(12)
    .. string.pack("<I2I2", last, 0)
  local crc = 0
  for i = 1, #text do
    crc = crc ~ text:byte(i)
    for _ = 1, 8 do crc = crc & 0x80 ~= 0 and (crc << 1 ~ 0x4D) & 0xFF or crc << 1 & 0xFF end
  end
  return text .. string.char(crc)
end

local function nearest(scan)
  local least, where = math.huge, nil
  for i, distance in ipairs(scan.ranges) do
    if distance < least then least, where = distance, i end
  end
  return least, where
end

scenario("a turn of the LiDAR becomes a scan", { timeout = 5 }, function(s)
  local scanner = load(s)
  s:inject("lidar.wire_in", "\x00\x54" .. FRAME) -- begins in the middle of a frame
  s:inject("lidar.wire_in", frame(33500, 34500, 1000):sub(1, 20))
  s:run(0.05)
  s:equal(scanner.scan.tm, 0)
  s:inject("lidar.wire_in", frame(33500, 34500, 1000):sub(21))
  s:inject("lidar.wire_in", frame(0, 1000, 1000))
  s:run(0.05)
  local scan = scanner.scan.value
  s:equal(#scan.ranges, 360)
  local distance, ray = nearest(scan)
  s:near(distance, 0.192, 0.0001) -- C0 00: the last point, at 334.7 degrees clockwise
  s:check(ray > 200 and ray < 220, ray)
end)

scenario("a LiDAR's frame with a wrong check counts for nothing", { timeout = 5 }, function(s)
  local scanner = load(s)
  s:inject("lidar.wire_in", FRAME:sub(1, 10) .. "\xFF" .. FRAME:sub(12))
  s:inject("lidar.wire_in", frame(34500, 35500, 2000))
  s:inject("lidar.wire_in", frame(100, 1000, 2000))
  s:run(0.05)
  s:near(nearest(scanner.scan.value), 2, 0.0001)
end)

--- What two turns of the LiDAR give, of which the second one only ends the first.
local function turn_of(s, ...)
  for _, each in ipairs { ... } do s:inject("lidar.wire_in", each) end
  s:inject("lidar.wire_in", frame(0, 1100, 5000))
  s:run(0.05)
  return s.scanner.scan.value
end

scenario("each point of a LiDAR belongs to the ray in its direction, clockwise from ahead", { timeout = 5 }, function(s)
  local scanner = load(s)
  s:equal({ scanner.config.rays, scanner.config.mounted_at }, { 360, 0.0 })
  local scan = turn_of(s, frame(50, 1150, 1000), frame(34850, 35950, 2000))
  for i = 1, 360 do
    local expected = i >= 169 and i <= 180 and 1 or i >= 181 and i <= 192 and 2 or math.huge
    s:equal(scan.ranges[i], expected, "ray " .. i)
  end
  local config, step = scan.config, 2 * math.pi / 360
  for name, value in pairs { minAngle = -math.pi, maxAngle = math.pi - step, angularRes = step, minRange = 0.02, maxRange = 12 } do
    s:near(config[name], value, 1e-9, name)
  end
end)

scenario("a frame of a LiDAR may end one turn and begin the next", { timeout = 5 }, function(s)
  load(s)
  s:inject("lidar.wire_in", frame(35550, 650, 1000))
  s:run(0.05)
  local scan = s.scanner.scan.value
  for i = 170, 190 do s:equal(scan.ranges[i], i >= 181 and i <= 185 and 1 or math.huge, "ray " .. i) end
  scan = turn_of(s)
  for i = 170, 190 do s:equal(scan.ranges[i], i >= 174 and i <= 180 and 1 or math.huge, "ray " .. i) end
end)

scenario("the nearest point in a ray counts, and none that is nearer than the LiDAR can see", { timeout = 5 }, function(s)
  load(s)
  local scan = turn_of(s, frame(5050, 5050, 900), frame(6050, 6050, 700), frame(6050, 6050, 800), frame(7050, 7050, 19),
    frame(8050, 8050, 20))
  s:equal({ scan.ranges[130], scan.ranges[120], scan.ranges[110], scan.ranges[100] }, { 0.9, 0.7, math.huge, 0.02 })
end)

scenario("a LiDAR may be mounted askew, and give other rays from the next turn on", { timeout = 5 }, function(s)
  local scanner = load(s)
  scanner.config.mounted_at, scanner.config.rays = math.pi / 2, 36
  s:run(0.02)
  s:equal(#turn_of(s, frame(4500, 4500, 1000)).ranges, 360, "this turn has begun before")
  local scan = turn_of(s, frame(4500, 4500, 1000))
  s:equal(#scan.ranges, 36)
  s:equal(nearest(scan), 1)
  s:equal(select(2, nearest(scan)), 23)
  s:near(scan.config.maxAngle, math.pi - 2 * math.pi / 36, 1e-9)
  scanner.config.rays = 720
  s:run(0.02)
  turn_of(s, frame(4500, 4500, 1000))
  s:equal(#turn_of(s, frame(4500, 4500, 1000)).ranges, 720)
end)

scenario("a LiDAR's frame may arrive in any pieces", { timeout = 5, sweep = { size = { 1, 7, 46 } } }, function(s, p)
  load(s)
  local bytes = "\x54\x54\x00" .. frame(5050, 5050, 900) .. "\x54" .. frame(6050, 6050, 700)
  for i = 1, #bytes, p.size do
    s:inject("lidar.wire_in", bytes:sub(i, i + p.size - 1))
    s:run(0.02)
  end
  local scan = turn_of(s)
  s:equal({ scan.ranges[130], scan.ranges[120] }, { 0.9, 0.7 })
end)
