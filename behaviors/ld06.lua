--- Reads a LiDAR of the type LD06 (LDRobot) on a serial line, and publishes its turns as scans.
--- connect("lidar.out", "scanner.bytes"), with
--- component "lidar" { type = "Serial", config = { path = "/dev/ttyUSB0", baud = 230400, measures_only = true } }

local bytes = input("bytes", "TimedOctetSeq", "from the serial line", { queue = 100 })
local scan  = output("scan", "RangeData", "a turn, counter-clockwise from behind; inf: nothing there")

param("rays", 360, { min = 36, max = 720, doc = "rays of a turn" })
param("mounted_at", 0.0, { min = -math.pi, max = math.pi, unit = "rad", doc = "where its zero looks, counter-clockwise" })

-- A frame has 47 bytes: 54 2C, turning speed, first angle, 12 times distance [mm] and intensity, last angle, time, check.
local HEADER, POINTS, SIZE = "\x54\x2C", 12, 47
local NEAREST, FARTHEST = 0.02, 12 -- m

-- CRC-8 with the polynomial 4D.
local crc_of = {}
for byte = 0, 255 do
  local crc = byte
  for _ = 1, 8 do
    crc = crc & 0x80 ~= 0 and (crc << 1 ~ 0x4D) & 0xFF or crc << 1
  end
  crc_of[byte] = crc
end

local function is_whole(frame)
  local crc = 0
  for i = 1, SIZE - 1 do crc = crc_of[crc ~ frame:byte(i)] end
  return crc == frame:byte(SIZE)
end

local rest = ""
local rays, ranges, last_angle -- of this turn

local function begin_turn()
  rays, ranges = config.rays, {}
  for i = 1, rays do ranges[i] = math.huge end
end
begin_turn()

local function publish()
  local step = 2 * math.pi / rays
  scan:write {
    ranges = ranges,
    config = { minAngle = -math.pi, maxAngle = math.pi - step, angularRes = step, minRange = NEAREST, maxRange = FARTHEST },
  }
  begin_turn()
end

-- The sensor counts clockwise in hundredths of a degree.
local function take_point(hundredths, millimetres)
  local angle = config.mounted_at - math.rad(hundredths / 100)
  local turns = (angle + math.pi) / (2 * math.pi)
  local ray = math.floor(turns * rays) % rays + 1
  local distance = millimetres / 1000
  if distance >= NEAREST and distance < ranges[ray] then ranges[ray] = distance end
end

local function take_frame(frame)
  local first, last = string.unpack("<I2", frame, 5), string.unpack("<I2", frame, 43)
  local step = ((last - first) % 36000) / (POINTS - 1)
  for i = 0, POINTS - 1 do
    local angle = (first + i * step) % 36000
    if last_angle and angle < last_angle then publish() end
    last_angle = angle
    take_point(angle, (string.unpack("<I2", frame, 7 + 3 * i)))
  end
end

function on_execute()
  while bytes.is_new do rest = rest .. bytes:read() end
  while true do
    local at = rest:find(HEADER, 1, true)
    if not at then
      rest = rest:sub(-1) -- may be the first byte of a header
      return
    end
    rest = rest:sub(at)
    if #rest < SIZE then return end
    local frame = rest:sub(1, SIZE)
    if is_whole(frame) then
      take_frame(frame)
      rest = rest:sub(SIZE + 1)
    else
      rest = rest:sub(3)
    end
  end
end
