--- A rover without a microcontroller: a Raspberry Pi with a motor hat and a battery monitor on I2C, and an ultrasonic
--- range finder on two GPIO lines.

return robot_model {
  doc = "A rover with a motor hat (PCA9685), a battery monitor (INA219) and a range finder (HC-SR04): its driver is a behaviour",
  mass = 0.9, -- kg
  body = { size = { 0.18, 0.12, 0.06 } },
  drive = {
    radius = 0.0325, -- m
    track = 0.13, -- m
    pulses_per_turn = 1440,
    limits = { speed = 0.4, yaw_rate = 3, acceleration = 0.8, yaw_acceleration = 6 },
    hardware_limits = { speed = 0.3 },
  },
  sensors = { front = { kind = "range", at = { 0.09, 0, 0.02 }, range = 2, minimum = 0.02 } },
  ports = { distance = { type = "TimedDouble", from = "front", rate = 15, doc = "free way ahead [m]" } },
  hardware = {
    script = "hat_rover_driver",
    devices = {
      -- Register 00 says whether the chip sleeps, as after a loss of power. FD = 10 switches all of its outputs off.
      hat = i2c { address = 0x60, registers = { 0x00 }, lengths = { 1 }, every = 0.1, safe = "\xFD\x10" },
      battery = i2c { address = 0x40, registers = { 0x02 }, lengths = { 2 }, every = 0.2, safe = false },
      -- The trigger on line 23, the echo on line 24, by a divider to 3.3 V.
      sonar = gpio { outputs = { 23 }, inputs = { 24 }, safe = false },
    },
    device_model = "hat_rover_devices",
  },
}
