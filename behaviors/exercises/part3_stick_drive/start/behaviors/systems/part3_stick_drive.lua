--- A joystick drives the mouse. To do: the EV3, too.
robot     "mouse"     { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
robot     "ev3"       { model = "ev3", pose = { x = 0, y = 0.4, heading = 0 } }
component "stick"     { type = "Joystick" }
behavior  "converter" { script = "converter" }

connect("stick.pos", "converter.in")
connect("converter.out", "mouse.target_velocity_in")
