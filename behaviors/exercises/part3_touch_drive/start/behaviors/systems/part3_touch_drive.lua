--- The EV3's touch sensors drive the mouse.
robot    "ev3"    { model = "ev3", pose = { x = 0, y = 0.4, heading = 0 } }
robot    "mouse"  { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
behavior "driver" { script = "driver" }

connect("ev3.touch", "driver.touch")
connect("driver.target_velocity", "mouse.target_velocity_in")
