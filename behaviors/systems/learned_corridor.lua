--- A mouse that can learn to follow a corridor: environments/corridor.lua. These weights were learned.
local width = argument("width", 0.3, { min = 0.2, max = 0.5, doc = "of the corridor [m]" })
local half = width / 2

-- 0.8 m to the east, 0.8 m to the north, 0.8 m to the east; closed at both ends.
arena {
  wall { from = { -0.2, -half }, to = { 0.8 + half, -half } },
  wall { from = { -0.2, half }, to = { 0.8 - half, half } },
  wall { from = { -0.2, -half }, to = { -0.2, half } },
  wall { from = { 0.8 + half, -half }, to = { 0.8 + half, 0.8 - half } },
  wall { from = { 0.8 - half, half }, to = { 0.8 - half, 0.8 + half } },
  wall { from = { 0.8 - half, 0.8 + half }, to = { 1.8, 0.8 + half } },
  wall { from = { 0.8 + half, 0.8 - half }, to = { 1.8, 0.8 - half } },
  wall { from = { 1.8, 0.8 - half }, to = { 1.8, 0.8 + half } },
}

robot    "mouse"  { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
behavior "driver" { script = "learned_driver", rate = 10, config = { weights = { -0.3123, 0.2574, 0.7250, -2.6812, 1.8650, -1.7887, 1.8385, -2.0306, -1.0666, 0.1955 } } }

connect("mouse.ir_sensor_metre_out", "driver.ranges")
connect("driver.target", "mouse.target_velocity_in")
