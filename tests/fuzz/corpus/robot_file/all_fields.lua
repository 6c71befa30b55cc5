return robot_model {
  doc = "all", mass = 1, body = { shape = "cylinder", radius = 0.1, height = 0.1, at = { 0, 0, 0.06 } },
  drive = { radius = 0.02, track = 0.1, skid = 0.05, pulses_per_turn = 360, coasts_until_commanded = true, limits = { speed = 1 }, needs = { "a" } },
  sensors = {
    a = { kind = "range", at = { 0.1, 0, 0 }, yaw = 0, range = 1, minimum = 0.03, cone = 0.3, rays = 5, noise = 0.1,
          response = function(d) return 1 / d end, max_value = 10, nothing = 0 },
    b = { kind = "range", table = { { 0.1, 3 }, { 0.2, 2 } }, min_value = 0 },
    c = { kind = "touch", travel = 0.004 }, d = { kind = "gyro", drift = 0.1, max_rate = 7, noise = 0.01 },
    e = { kind = "range", on = "neck" }, f = { kind = "button" },
  },
  actuators = { neck = { kind = "servo", minimum = -1, maximum = 1, max_rate = 3, at = { 0, 0, 0 } }, lamps = { kind = "leds", count = 3 } },
  ports = {
    v = { type = "TimedVelocity2D", to = "drive" }, o = { type = "TimedPose2D", from = "odometry", rate = 10 },
    r = { type = "TimedDoubleSeq", from = { "a", "b" }, quantity = "distance" }, t = { type = "TimedBooleanSeq", from = { "c", "f" } },
    n = { type = "TimedDouble", to = "neck" }, l = { type = "TimedBooleanSeq", to = "lamps", silence = "hold", queue = 2 },
  },
}
