--- A round robot of the size that swarm research uses: two wheels and 24 short proximity sensors around its rim.

local RADIUS, HEIGHT = 0.085, 0.06 -- m

--- Nearness at a distance [m]: 1 at the rim, 0 with nothing in sight.
local function nearness(d)
  if d < 0.00989 then return 1 end
  return 0.0100527 / (d + 0.000163144)
end

local sensors, names = {}, {}
for i = 1, 24 do
  local angle = math.rad(7.5 + 15 * (i - 1))
  local name = ("ray_%02d"):format(i)
  names[i] = name
  sensors[name] = {
    kind = "range",
    at = { RADIUS * math.cos(angle), RADIUS * math.sin(angle), HEIGHT - 0.07 },
    yaw = angle,
    range = 0.1, -- m
    response = nearness,
    nothing = 0,
  }
end

return robot_model {
  doc = "A round swarm robot with 24 proximity sensors",
  mass = 1.6, -- kg
  body = { shape = "cylinder", radius = RADIUS, height = 0.12, at = { 0, 0, 0.07 } },
  drive = {
    radius = 0.029, track = 0.14, -- m
    limits = { speed = 0.3, yaw_rate = 4, acceleration = 2, yaw_acceleration = 20 },
  },
  sensors = sensors,
  ports = {
    velocity = { type = "TimedVelocity2D", to = "drive", doc = "target velocity" },
    measured = { type = "TimedVelocity2D", from = "velocity", doc = "velocity measured at the wheels" },
    odometry = { type = "TimedPose2D", from = "odometry", doc = "odometry pose" },
    rays     = { type = "TimedDoubleSeq", from = names, doc = "24 proximity sensors, from the front to the left; a larger value is nearer" },
  },
}
