--- A mouse that can learn to stop at a wall: environments/stop_at_wall.lua. These weights were learned.
arena { box { at = { 0.8, 0.0, 0.15 }, size = { 0.1, 1.0, 0.3 } } }

robot    "mouse"  { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
behavior "driver" { script = "learned_driver", rate = 10, config = { weights = { -0.3652, -1.0879, -1.7074, -0.2984, 2.1904 } } }

connect("mouse.ir_sensor_metre_out", "driver.ranges")
connect("driver.target", "mouse.target_velocity_in")
