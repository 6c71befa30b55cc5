--- Raspberry Pi Mouse (RT Corporation): two stepping motors, four infrared distance sensors, 4 LEDs, 3 switches, a buzzer.

--- One infrared sensor: its place from the chassis' centre [m] and which way it looks [degrees, left positive].
--- Its value is a 12-bit reading of light that comes back: more is nearer, 0 is nothing in sight. `port`: which number of
--- the real robot's light sensors it is.
local function infrared(port, x, y, degrees)
  return {
    kind = "range",
    port = port,
    at = { x, y, -0.02 },
    yaw = math.rad(degrees),
    range = 0.60, -- m
    table = "ir_table.csv",
    min_value = 0,
    max_value = 4095,
    noise = 0,
  }
end

-- Right first, as everywhere for this robot.
local infrareds = { "right_front", "right_side", "left_side", "left_front" }

return robot_model {
  doc = "Raspberry Pi Mouse: a small two-wheeled robot with four infrared distance sensors",
  mass = 0.72,                                                                     -- kg
  body = { shape = "box", size = { 0.10, 0.08, 0.06 }, at = { 0.0, 0.0, 0.04 } },  -- m
  drive = {
    radius = 0.024,         -- m
    track = 0.0925,         -- m
    pulses_per_turn = 400,
    skid = 0.04,            -- m
    limits = { speed = 0.5, yaw_rate = 6, acceleration = 2.0, yaw_acceleration = 12 },
    -- A stepping motor that loses steps stalls: be gentle until it is calibrated.
    hardware_limits = { speed = 0.2, yaw_rate = 2, acceleration = 0.52, yaw_acceleration = 4 },
    needs = infrareds,
  },

  sensors = {
    right_front = infrared("0", 0.035, -0.040, 0),
    right_side  = infrared("1", 0.045, -0.030, -45),
    left_side   = infrared("2", 0.045, 0.030, 45),
    left_front  = infrared("3", 0.035, 0.040, 0),
    switch0 = { kind = "button" },
    switch1 = { kind = "button" },
    switch2 = { kind = "button" },
  },

  actuators = {
    leds   = { kind = "leds", count = 4 },
    buzzer = { kind = "buzzer" },
  },

  hardware = { driver = "raspimouse" },

  ports = {
    target_velocity_in = { type = "TimedVelocity2D", to = "drive", doc = "target velocity" },
    pose_update        = { type = "TimedPose2D", to = "odometry", doc = "sets the odometry's pose" },
    buzzer_hz_in       = { type = "TimedShort", to = "buzzer", silence = "off", doc = "buzzer tone in Hz, 0 = silent" },
    led4bit_in         = { type = "TimedBooleanSeq", to = "leds", doc = "the 4 LEDs" },

    current_velocity_out = { type = "TimedVelocity2D", from = "velocity", doc = "velocity measured at the wheels, in the robot's frame" },
    current_pose_out     = { type = "TimedPose2D", from = "odometry", doc = "odometry pose" },
    ir_sensor_out        = {
      type = "TimedShortSeq", from = infrareds,
      doc = "distance sensors: right front, right side, left side, left front; a larger value is nearer",
    },
    ir_sensor_metre_out  = {
      type = "TimedDoubleSeq", from = infrareds, quantity = "distance",
      doc = "the 4 distances [m]; 0.60 with nothing in sight",
    },
    switch3bit_out       = { type = "TimedBooleanSeq", from = { "switch0", "switch1", "switch2" }, doc = "the 3 switches" },
  },
}
