--- Stands for the rover's microcontroller in simulation: it does what hw/rover/rover.ino does.

local line_in  = input("line_in", "TimedString", "from the driver", { queue = 100 })
local line_out = output("line_out", "TimedString", "to the driver")
local counts   = input("wheel_pulses", "TimedLongSeq", "the simulated encoders")
local front    = input("front", "TimedDouble", "the simulated range finder [m]")
local motors   = output("target_velocity_in", "TimedVelocity2D", "the simulated wheels")

param("volts", 7.4, { min = 0, unit = "V", doc = "of the battery" })

local TIME_OUT = 0.3 -- s without a line, after which the motors stop: the cable may be unplugged

local vx, va, heard_at = 0, 0, 0

local function take_line(line)
  local speed, rate = line:match("^v (%-?%d[%d.]*) (%-?%d[%d.]*)$")
  if speed then
    vx, va, heard_at = tonumber(speed), tonumber(rate), now()
  end
end

function on_execute()
  while line_in.is_new do take_line(line_in:read()) end
  if now() - heard_at > TIME_OUT then
    vx, va = 0, 0
  end
  motors:write { vx = vx, va = va }
  local left, right = table.unpack(counts:read())
  line_out:write(("e %d %d"):format(left or 0, right or 0))
  line_out:write(("r %.3f"):format(front:read()))
  line_out:write(("b %.2f"):format(config.volts))
end
