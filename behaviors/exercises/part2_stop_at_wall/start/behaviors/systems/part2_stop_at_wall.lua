--- A mouse drives to a wall.
arena { box { at = { 0.8, 0.0, 0.15 }, size = { 0.1, 1.0, 0.3 } } }

robot    "mouse"      { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
behavior "controller" { script = "controller", config = { speed_x = 0.1 } }

connect("mouse.ir_sensor_out", "controller.in")
connect("controller.out", "mouse.target_velocity_in")
