--- Stands for the hat rover's devices in simulation: the registers of its motor hat and of its battery monitor, and the
--- echo of its range finder.

local hat_in      = input("hat_in", "TimedOctetSeq", "from the driver", { queue = 100 })
local hat_out     = output("hat_out", "TimedOctetSeq", "registers of the PCA9685")
local battery_out = output("battery_out", "TimedOctetSeq", "registers of the INA219")
local sonar_in    = input("sonar_in", "TimedString", "the trigger", { queue = 20 })
local sonar_out   = output("sonar_out", "TimedString", "the echo")
local front       = input("front", "TimedDouble", "the simulated range finder [m]")
local motors      = output("target_velocity_in", "TimedVelocity2D", "the simulated wheels")

param("volts", 7.4, { min = 0, unit = "V", doc = "of the battery" })
param("full_speed", 0.6, { min = 0.1, unit = "m/s", doc = "of a wheel with full voltage" })
param("track", 0.13, { min = 0.01, unit = "m", doc = "between the wheels" })

local MODE1, ALL_OFF_HIGH, SLEEP = 0x00, 0xFD, 0x10

local registers = {}

local function lose_power()
  for i = 0, 255 do registers[i] = 0 end
  registers[MODE1] = SLEEP | 0x01
end
lose_power()

command("lose_power", lose_power, "the hat was without power for a moment")

local function take_message(bytes)
  local at = bytes:byte(1)
  for i = 2, #bytes do
    registers[at] = bytes:byte(i)
    at = at + 1
  end
  if bytes:byte(1) == ALL_OFF_HIGH and bytes:byte(2) & 0x10 ~= 0 then
    for channel = 0, 15 do registers[0x06 + 4 * channel + 3] = 0x10 end
  end
end

-- The part of the time for which a channel is on.
local function duty(channel)
  local at = 0x06 + 4 * channel
  if registers[MODE1] & SLEEP ~= 0 or registers[at + 3] & 0x10 ~= 0 then return 0 end
  if registers[at + 1] & 0x10 ~= 0 then return 1 end
  return (registers[at + 2] | (registers[at + 3] & 0x0F) << 8) / 4096
end

local function speed(power, ahead, back) return config.full_speed * duty(power) * (duty(ahead) - duty(back)) end

local is_high = false

-- The range finder answers when its trigger falls: a pulse as long as the sound's way there and back.
local function take_trigger(level)
  if is_high and level == "0" then
    local begin = now() + 0.0005
    sonar_out:write(("24=1 %.6f"):format(begin))
    sonar_out:write(("24=0 %.6f"):format(begin + front:read() / 171.5))
  end
  is_high = level == "1"
end

local read_at = -math.huge

function on_execute()
  while hat_in.is_new do take_message(hat_in:read()) end
  while sonar_in.is_new do
    local level = sonar_in:read():match("23=(%d)")
    if level then take_trigger(level) end
  end
  local left, right = speed(8, 10, 9), speed(13, 11, 12)
  motors:write { vx = (left + right) / 2, va = (right - left) / config.track }
  if now() - read_at >= 0.1 then
    read_at = now()
    hat_out:write(string.char(MODE1, registers[MODE1]))
    battery_out:write("\x02" .. string.pack(">I2", math.floor(config.volts / 0.004 + 0.5) << 3))
  end
end
