--- Follows a coloured thing that its camera sees: turns to it, and keeps its distance by how large it looks.

local centre = input("centre", "TimedDoubleSeq", "where the thing is in the picture: { left, up }, each -1 to 1")
local area   = input("area", "TimedDouble", "its share of the picture")
local target = output("target", "TimedVelocity2D", "target velocity")

param("size", 0.08, { min = 0.0001, max = 1.0, doc = "share of the picture at the distance to keep; less is farther" })
param("speed", 0.2, { min = 0.0, max = 1.0, step = 0.01, widget = "slider", unit = "m/s", doc = "the largest" })
param("gain", 0.8, { min = 0.0, unit = "m/s", doc = "speed for each distance to keep that the thing is too far" })
param("turn", 1.5, { min = 0.0, unit = "rad/s", doc = "rate of turning to a thing at the picture's edge" })
param("lost_after", 0.3, { min = 0.0, unit = "s", doc = "stop when nothing was seen for so long" })

-- Whether the last command may have been to move.
local moving = false

local function drive(vx, va)
  target:write { vx = vx, va = va }
  moving = vx ~= 0 or va ~= 0
end

function on_execute()
  if centre.is_new then
    -- At twice the distance a thing has a quarter of the area.
    local far = math.sqrt(config.size / area:read()) - 1
    drive(math.max(-config.speed, math.min(config.gain * far, config.speed)), config.turn * centre:read()[1])
  elseif moving and centre.age > config.lost_after then
    drive(0, 0)
  end
end
