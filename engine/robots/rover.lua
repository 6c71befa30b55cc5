--- A rover that a person built: a microcontroller on USB drives its motors, and counts the pulses of their encoders.

return robot_model {
  doc = "A rover of one's own: its driver is a behaviour, its microcontroller runs hw/rover/rover.ino",
  mass = 1.1, -- kg
  body = { size = { 0.2, 0.14, 0.07 } },
  drive = {
    radius = 0.033, -- m
    track = 0.15, -- m
    pulses_per_turn = 1440,
    limits = { speed = 0.4, yaw_rate = 3, acceleration = 0.8, yaw_acceleration = 6 },
    hardware_limits = { speed = 0.3 },
  },
  sensors = { front = { kind = "range", at = { 0.1, 0, 0.02 }, range = 2, minimum = 0.02 } },
  ports = { distance = { type = "TimedDouble", from = "front", rate = 20, doc = "free way ahead [m]" } },
  hardware = {
    script = "rover_driver",
    devices = { line = serial { path = "/dev/ttyACM0", baud = 115200, ends = "\n", safe = "v 0 0\n" } },
    device_model = "rover_firmware",
  },
}
