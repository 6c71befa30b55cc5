--- Drives the hat rover: sets the registers of its motor hat, measures the free way by the times of an echo, and stands
--- while the battery is low.

local target      = input("target_velocity_in", "TimedVelocity2D", "the commanded velocity, after all limits")
local velocity    = output("current_velocity_out", "TimedVelocity2D", "as commanded: the rover has no encoders")
local distance    = output("distance", "TimedDouble", "free way ahead [m]")
local may_drive   = output("may_drive", "TimedBoolean", "false while the battery is low")
local hat_in      = input("hat_in", "TimedOctetSeq", "registers of the PCA9685", { queue = 20 })
local hat_out     = output("hat_out", "TimedOctetSeq", "to the PCA9685")
local battery_in  = input("battery_in", "TimedOctetSeq", "registers of the INA219", { queue = 20 })
local sonar_in    = input("sonar_in", "TimedString", "edges of the echo", { queue = 20 })
local sonar_out   = output("sonar_out", "TimedString", "the trigger")

param("full_speed", 0.6, { min = 0.1, max = 3, unit = "m/s", doc = "of a wheel with full voltage: measure it" })
param("track", 0.13, { min = 0.01, max = 1, unit = "m", doc = "between the wheels" })
param("low_voltage", 6.4, { min = 0, unit = "V", doc = "the rover stands below it" })
param("warning_voltage", 6.8, { min = 0, unit = "V", doc = "a message warns below it" })

-- Registers of the PCA9685 (NXP's data sheet, table 4).
local MODE1, PRE_SCALE, FIRST_MOTOR = 0x00, 0xFE, 0x26
local SLEEP, AUTO_INCREMENT = 0x10, 0x20
local PWM_1600_HZ = 3

local OFF, ON = string.pack("<I2I2", 0, 0x1000), string.pack("<I2I2", 0x1000, 0)

-- The registers of a channel: it is on from 0 to `duty` of each period.
local function channel(duty)
  local count = math.floor(duty * 4096 + 0.5)
  if count <= 0 then return OFF end
  if count >= 4096 then return ON end
  return string.pack("<I2I2", 0, count)
end

-- The channels of a motor: its power, and its two directions.
local function motor(speed)
  local power = channel(math.abs(speed) / config.full_speed)
  return power, speed > 0 and ON or OFF, speed < 0 and ON or OFF
end

-- Channels 8 to 13 drive both motors of the hat: they are set together.
local function set_motors(left, right)
  local left_power, left_ahead, left_back = motor(left)
  local right_power, right_ahead, right_back = motor(right)
  hat_out:write(string.char(FIRST_MOTOR) .. left_power .. left_back .. left_ahead .. right_ahead .. right_back .. right_power)
end

-- The chip sleeps after its power came: then it gets its frequency, and wakes.
local function wake_hat()
  hat_out:write(string.char(MODE1, SLEEP))
  hat_out:write(string.char(PRE_SCALE, PWM_1600_HZ))
  hat_out:write(string.char(MODE1, AUTO_INCREMENT))
end

state.warned = state.warned or false

-- Register 2 of the INA219: the voltage in its upper 13 bits, 4 mV each.
local function take_battery(bytes)
  local _, value = string.unpack(">BI2", bytes)
  local volts = (value >> 3) * 0.004
  probe("battery", volts)
  may_drive:write(volts >= config.low_voltage)
  local is_low = volts < config.warning_voltage
  if is_low and not state.warned then log.warn(("the battery has only %.1f V"):format(volts)) end
  state.warned = is_low
end

local METRES_PER_SECOND = 343 / 2 -- sound at 20 degrees, there and back
local FARTHEST = 2 -- m
local rose_at

local function take_echo(message)
  local level, tm = message:match("^24=(%d) (%S+)$")
  if level == "1" then rose_at = tonumber(tm) end
  if level == "0" and rose_at then
    distance:write(math.min((tonumber(tm) - rose_at) * METRES_PER_SECOND, FARTHEST))
    rose_at = nil
  end
end

local triggered_at, is_high = -math.huge, false

-- A pulse on the trigger begins a measurement; echoes of the one before must be over.
local function trigger()
  if is_high then
    is_high = false
    sonar_out:write("23=0")
  elseif now() - triggered_at >= 0.06 then
    triggered_at, is_high = now(), true
    sonar_out:write("23=1")
  end
end

function on_execute()
  while battery_in.is_new do take_battery(battery_in:read()) end
  while sonar_in.is_new do take_echo(sonar_in:read()) end
  while hat_in.is_new do
    if hat_in:read():byte(2) & SLEEP ~= 0 then wake_hat() end
  end
  local wanted = target:read()
  velocity:write(wanted)
  set_motors(wanted.vx - wanted.va * config.track / 2, wanted.vx + wanted.va * config.track / 2)
  trigger()
end
