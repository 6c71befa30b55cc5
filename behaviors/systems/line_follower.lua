--- An EV3 follows a line round a rounded rectangle.
arena { floor { image = "line.png", size = { 1.6, 1.2 } } }

robot    "ev3"      { model = "ev3", pose = { x = 0, y = -0.34, heading = 0 } }
behavior "follower" { script = "line_follower" }

connect("ev3.light_reflect", "follower.light")
connect("follower.target", "ev3.velocity2D")
