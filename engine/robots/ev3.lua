--- LEGO EV3 Educator Vehicle: two large motors with encoders, a medium motor that turns an ultrasonic sensor, a gyro, a
--- colour sensor that looks at the floor, two touch sensors, a loudspeaker, a screen.

--- A touch sensor at the front: right is y < 0. Its tip stands out by its travel and is pushed in by what the robot meets.
local function touch(y, port)
  return { kind = "touch", port = port, at = { 0.084, y, -0.02 }, travel = 0.004 }
end

return robot_model {
  doc = "LEGO EV3 Educator Vehicle: wheels with encoders, ultrasonic, gyro, colour and touch sensors, speech and a screen",
  mass = 0.65,                                                                     -- kg
  body = { shape = "box", size = { 0.16, 0.08, 0.09 }, at = { 0.0, 0.0, 0.06 } },  -- m
  drive = {
    radius = 0.028,         -- m
    track = 0.108,          -- m
    port = { "outB", "outC" },
    pulses_per_turn = 360,  -- the encoders tell degrees
    skid = 0.06,            -- m
    coasts_until_commanded = true,
    -- 1050 degrees a second at the motors is 0.51 m/s.
    limits = { speed = 0.5, yaw_rate = 9, acceleration = 2.0, yaw_acceleration = 20 },
    hardware_limits = { speed = 0.3, yaw_rate = 3, acceleration = 1.0, yaw_acceleration = 10 },
  },

  sensors = {
    right = touch(-0.025, "in3"),
    left  = touch(0.025, "in1"),
    -- In front, on the medium motor; low enough to see a mouse and the border of an arena.
    ultrasonic = {
      kind = "range",
      at = { 0.07, 0.0, -0.01 },
      on = "medium_motor",
      minimum = 0.03, range = 2.5,         -- m
      cone = math.rad(20), rays = 9,
      noise = 0.002,                       -- m: within 0.01 m
    },
    gyro = {
      kind = "gyro",
      max_rate = math.rad(440),            -- a second
      drift = math.rad(0.02),              -- a second
      noise = math.rad(0.5),               -- within 3 degrees
    },
    color         = { kind = "color", at = { 0.06, 0.0, -0.045 } },
    light_reflect = { kind = "reflect", at = { 0.06, 0.0, -0.045 }, noise = 0.3 },
    light_ambient = { kind = "ambient", at = { 0.06, 0.0, -0.045 }, level = 10, noise = 0.3 },  -- a lit room, under the robot
    -- The brick's keys.
    key_up    = { kind = "button", port = "up" },
    key_down  = { kind = "button", port = "down" },
    key_left  = { kind = "button", port = "left" },
    key_right = { kind = "button", port = "right" },
    key_enter = { kind = "button", port = "enter" },
    key_back  = { kind = "button", port = "back" },
  },

  actuators = {
    -- The ultrasonic sensor's cable allows no full turn.
    medium_motor = {
      kind = "servo",
      port = "outA",
      at = { 0.07, 0.0, -0.01 },
      minimum = -math.pi, maximum = math.pi,
      max_rate = math.rad(1560),           -- a second
      speed = 1.6,                         -- rad/s, until `medium_motor_speed` says otherwise
    },
    speaker = { kind = "speaker" },
    screen  = { kind = "screen" },
    leds    = { kind = "leds", count = 4 },
  },

  hardware = { driver = "ev3" },

  ports = {
    velocity2D = { type = "TimedVelocity2D", to = "drive", doc = "target velocity; until the first one the wheels roll freely" },
    angle      = { type = "TimedDouble", to = "medium_motor", doc = "angle of the medium motor, which turns the ultrasonic sensor [rad]" },
    lcd        = { type = "CameraImage", to = "screen", doc = "picture for the screen" },
    sound      = { type = "TimedString", to = "speaker", queue = 16, doc = "beep, tone,HZ,MS or text to speak" },
    leds       = { type = "TimedBooleanSeq", to = "leds", doc = "the brick's lights: left red, left green, right red, right green" },
    pos_update = { type = "TimedPose2D", to = "odometry", doc = "sets the odometry's pose" },

    current_vel   = { type = "TimedVelocity2D", from = "velocity", doc = "velocity measured at the wheels, also when a hand rolls them" },
    stalled       = { type = "TimedBoolean", from = "stalled", doc = "whether a wheel's motor gives all its power and does not get its speed; told when it changes, in simulation never" },
    odometry      = { type = "TimedPose2D", from = "odometry", doc = "odometry pose" },
    ultrasonic    = { type = "RangeData", from = "ultrasonic", doc = "distance ahead of the ultrasonic sensor; 2.5 m with nothing in sight" },
    gyro          = { type = "TimedDouble", from = "gyro", doc = "angle turned since the start [rad], counter-clockwise positive" },
    gyro_rate     = { type = "TimedDouble", from = "gyro", quantity = "rate", doc = "rate of turning [rad/s], counter-clockwise positive" },
    color         = { type = "TimedString", from = "color", doc = "colour of the floor: none, black, blue, green, yellow, red, white, brown" },
    light_reflect = { type = "TimedDouble", from = "light_reflect", doc = "light that the floor reflects: 0 (black, or nothing) to 100 (white)" },
    light_ambient = { type = "TimedDouble", from = "light_ambient", doc = "light of the room: 0 (dark) to 100" },
    touch         = { type = "TimedBooleanSeq", from = { "right", "left" }, doc = "touch sensors: right, left" },
  },
}
