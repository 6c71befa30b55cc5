--- An EV3 drives 20 cm, turns, and waits to be touched: `driver.tasks` at the prompt shows at which step it is.
robot    "ev3"    { model = "ev3" }
behavior "driver" { script = "errand" }

connect("ev3.odometry", "driver.odometry")
connect("ev3.touch", "driver.touch")
connect("driver.target", "ev3.velocity2D")
