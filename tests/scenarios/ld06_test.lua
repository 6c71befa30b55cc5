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
