--- A whole classroom: 20 mice and one controller file, each mouse with parameters of its own.
local COLUMNS, ROWS = 5, 4
local SPACING = 0.6 -- m

arena { size = { COLUMNS * SPACING, ROWS * SPACING } }

for number = 1, COLUMNS * ROWS do
  local column, row = (number - 1) % COLUMNS, (number - 1) // COLUMNS
  local mouse, controller = "mouse_" .. number, "controller_" .. number
  robot(mouse, {
    model = "raspimouse",
    pose = {
      x = (column - (COLUMNS - 1) / 2) * SPACING,
      y = (row - (ROWS - 1) / 2) * SPACING,
      heading = number * math.pi / 2,
    },
  })
  behavior(controller, {
    script = "robot_controller",
    config = { speed_x = (5 + column) / 100, speed_r = (row - 1) / 10, stop_d = 20 + 2 * number },
  })
  connect(mouse .. ".ir_sensor_out", controller .. ".in")
  connect(controller .. ".out", mouse .. ".target_velocity_in")
end
