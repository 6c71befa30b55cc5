--- One joystick drives both robots at once: `drive "stick"` at the prompt.
robot     "mouse"     { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
robot     "ev3"       { model = "ev3", pose = { x = 0, y = 0.4, heading = 0 } }
component "stick"     { type = "Joystick" }
behavior  "converter" { script = "float_seq_to_velocity" }

connect("stick.pos", "converter.in")
connect("converter.out", "mouse.target_velocity_in")
connect("converter.out", "ev3.velocity2D")
