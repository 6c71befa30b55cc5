--- Two mice drive towards each other, each by a controller of its own, and stop when they see the other.
for index, name in ipairs { "left", "right" } do
  local facing = index == 1 and 1 or -1
  local mouse, controller = name .. "_mouse", name .. "_controller"
  robot(mouse, { model = "raspimouse", pose = { x = -0.5 * facing, y = 0, heading = index == 1 and 0 or math.pi } })
  behavior(controller, { script = "robot_controller", config = { speed_x = 0.1 } })
  connect(mouse .. ".ir_sensor_out", controller .. ".in")
  connect(controller .. ".out", mouse .. ".target_velocity_in")
end
