--- The mouse looks for a marker and keeps half a metre from it.
arena { marker { name = "target", id = 7, size = 0.1, at = { 1.0, 0.0, 0.06 }, facing = math.pi } }

robot     "mouse"    { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
component "eye"      { type = "Camera", on = "mouse", at = { 0.05, 0.0, 0.06 } }
component "detector" { type = "MarkerDetector", config = { tag_size = 0.1 } }
behavior  "follower" { script = "marker_follower" }

connect("eye.out", "detector.image")
connect("detector.pos", "follower.marker_pos")
connect("follower.target_vel", "mouse.target_velocity_in")
