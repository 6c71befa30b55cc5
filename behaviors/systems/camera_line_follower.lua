--- A mouse goes round a line that its camera sees on the floor before it.
arena { floor { image = "line.png", size = { 1.6, 1.2 } } }

robot     "mouse"    { model = "raspimouse", pose = { x = 0, y = -0.35, heading = 0 } }
component "eye"      { type = "Camera", on = "mouse", at = { 0.05, 0.0, 0.1 }, config = { width = 160, height = 120, pitch = 0.8 } }
component "detector" { type = "LineDetector" }
behavior  "follower" { script = "camera_line_follower" }

connect("eye.out", "detector.image")
connect("detector.offset", "follower.offset")
connect("detector.angle", "follower.angle")
connect("follower.target", "mouse.target_velocity_in")
