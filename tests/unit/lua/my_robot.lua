--- A robot as a user would write it: a box on two wheels with one eye.
return robot_model {
  mass = 1.0, -- kg
  body = { shape = "box", size = { 0.2, 0.15, 0.1 } },
  drive = { radius = 0.03, track = 0.13, limits = { speed = 1.0 } },
  sensors = {
    eye = { kind = "range", at = { 0.1, 0.0, 0.0 }, yaw = 0.0, response = function(d) return math.max(0, 100 - 200 * d) end },
  },
  ports = {
    go = { type = "TimedVelocity2D", to = "drive" },
    eyes = { type = "TimedShortSeq", from = { "eye" } },
  },
}
