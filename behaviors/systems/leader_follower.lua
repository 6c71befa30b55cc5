--- The EV3 leads, the mouse follows: roll the EV3 by hand, and the mouse moves the same way.
robot "ev3"   { model = "ev3", pose = { x = 0, y = 0.4, heading = 0 } }
robot "mouse" { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }

connect("ev3.current_vel", "mouse.target_velocity_in")
