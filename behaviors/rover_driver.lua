--- Drives the rover: sends its speeds to the microcontroller as lines, and reads what it answers.

local target    = input("target_velocity_in", "TimedVelocity2D", "the commanded velocity, after all limits")
local pulses    = output("wheel_pulses", "TimedLongSeq", "encoder counts of the left and right wheel")
local distance  = output("distance", "TimedDouble", "free way ahead [m]")
local may_drive = output("may_drive", "TimedBoolean", "false while the battery is low")
local line_in   = input("line_in", "TimedString", "from the microcontroller", { queue = 100 })
local line_out  = output("line_out", "TimedString", "to the microcontroller")

param("low_voltage", 6.4, { min = 0, unit = "V", doc = "the rover stands below it" })
param("warning_voltage", 6.8, { min = 0, unit = "V", doc = "a message warns below it" })

state.warned = state.warned or false

local function take_battery(volts)
  probe("battery", volts)
  may_drive:write(volts >= config.low_voltage)
  local is_low = volts < config.warning_voltage
  if is_low and not state.warned then log.warn(("the battery has only %.1f V"):format(volts)) end
  state.warned = is_low
end

-- "e 120 118": encoder counts. "r 0.53": the range finder. "b 7.4": the battery. Anything else is a torn line.
local function take_line(line)
  line = line:gsub("\r$", "")
  local left, right = line:match("^e (%-?%d+) (%-?%d+)$")
  if left then return pulses:write { tonumber(left), tonumber(right) } end
  local kind, value = line:match("^([rb]) (%d+%.%d+)$")
  if kind == "r" then distance:write(tonumber(value)) end
  if kind == "b" then take_battery(tonumber(value)) end
end

function on_execute()
  while line_in.is_new do take_line(line_in:read()) end
  local velocity = target:read()
  line_out:write(("v %.3f %.3f"):format(velocity.vx, velocity.va))
end
